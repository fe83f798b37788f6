// carom check, from files to findings.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "io/pairs_file.h"
#include "tests/cli/cli_test_util.h"

namespace carom::cli {
namespace {

using CheckTest = CliTest;

nlohmann::json checked(const std::string& path) {
  const CommandResult result = run_command({"check", path, "--json", "-"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  return result.json()["shapes"];
}

bool is_in(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

constexpr char kTetrahedron[] =
    "o thing\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

TEST_F(CheckTest, ObjThatIsFine) {
  std::ofstream(path("mesh.obj")) << kTetrahedron;
  const auto shapes = checked(path("mesh.obj"));
  ASSERT_EQ(shapes.size(), 1u);
  const auto& shape = shapes[0];
  EXPECT_EQ(shape["name"], "thing");
  EXPECT_EQ(shape["kind"], "mesh");
  EXPECT_EQ(shape["vertices"], 4);
  EXPECT_EQ(shape["triangles"], 4);
  for (const char* key : {"valid", "watertight", "convex"}) EXPECT_EQ(shape[key], true) << key;
  EXPECT_EQ(shape["inside_out"], false);
  EXPECT_FALSE(shape.contains("dent"));

  const CommandResult text = run_command({"check", path("mesh.obj")});
  EXPECT_EQ(text.code, 0);
  EXPECT_TRUE(is_in(text.out, "shape 0: mesh 'thing'\n")) << text.out;
  EXPECT_TRUE(is_in(text.out, "watertight  yes\n")) << text.out;
  EXPECT_TRUE(is_in(text.out, "convex      yes\n")) << text.out;
}

TEST_F(CheckTest, PolygonsAndWhatIsMissing) {
  // A cube of squares without its top.
  std::ofstream(path("open.OBJ")) << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                     "v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                                     "f 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  const auto shape = checked(path("open.OBJ"))[0];
  EXPECT_EQ(shape["triangles"], 10);
  EXPECT_EQ(shape["watertight"], false);
  EXPECT_EQ(shape["convex"], true);
  EXPECT_EQ(shape["open_edges"]["count"], 4);
  for (const auto& edge : shape["open_edges"]["first"]) {
    EXPECT_EQ(edge["at"][0][2], 1);
    EXPECT_EQ(edge["at"][1][2], 1);
    EXPECT_EQ(edge["triangles"], 1);
  }
  const CommandResult text = run_command({"check", path("open.OBJ")});
  EXPECT_TRUE(is_in(text.out, "watertight  no\n")) << text.out;
  EXPECT_TRUE(is_in(text.out, "edges of one triangle 4\n    edge ")) << text.out;
}

TEST_F(CheckTest, StlOfTrianglesThatShareNoVertex) {
  std::ofstream stl(path("mesh.stl"));
  stl << "solid s\n";
  const std::array<std::array<const char*, 3>, 4> faces = {{{"0 0 0", "0 1 0", "1 0 0"},
                                                            {"0 0 0", "1 0 0", "0 0 1"},
                                                            {"0 0 0", "0 0 1", "0 1 0"},
                                                            {"1 0 0", "0 1 0", "0 0 1"}}};
  for (const auto& face : faces) {
    stl << "facet normal 0 0 0\nouter loop\n";
    for (const char* corner : face) stl << "vertex " << corner << '\n';
    stl << "endloop\nendfacet\n";
  }
  stl << "endsolid s\n";
  stl.close();
  const auto shape = checked(path("mesh.stl"))[0];
  EXPECT_EQ(shape["vertices"], 4);
  EXPECT_EQ(shape["watertight"], true);
  EXPECT_EQ(shape["convex"], true);
}

// One triangle twice in the scene: as it is, and mirrored and moved.
TEST_F(CheckTest, GltfInstances) {
  const std::string buffer = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
  std::ofstream(path("scene.gltf"))
      << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],)"
      << R"("nodes":[{"mesh":0},{"mesh":0,"scale":[-2,1,1],"translation":[0,0,5]}],)"
      << R"("meshes":[{"name":"t","primitives":[{"attributes":{"POSITION":0}}]}],)"
      << R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",)"
      << R"("min":[0,0,0],"max":[1,1,0]}],"bufferViews":[{"buffer":0,"byteLength":36}],)"
      << R"("buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)" << buffer
      << R"("}]})";
  const auto shapes = checked(path("scene.gltf"));
  ASSERT_EQ(shapes.size(), 2u);
  EXPECT_EQ(shapes[0]["triangles"], 1);
  EXPECT_EQ(shapes[0]["open_edges"]["first"][0]["at"][0][2], 0);
  EXPECT_EQ(shapes[1]["open_edges"]["first"][0]["at"][0][2], 5);
}

TEST_F(CheckTest, DentedMeshNamesTheEdge) {
  // A box whose top is 0.25 lower in the middle.
  std::ofstream(path("pit.obj")) << "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 -0.25\n"
                                    "v 0 0 -1\nv 2 0 -1\nv 2 2 -1\nv 0 2 -1\n"
                                    "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n"
                                    "f 9 8 7 6\nf 6 7 2 1\nf 7 8 3 2\nf 8 9 4 3\nf 9 6 1 4\n";
  const auto shape = checked(path("pit.obj"))[0];
  EXPECT_EQ(shape["watertight"], true);
  EXPECT_EQ(shape["convex"], false);
  ASSERT_TRUE(shape["dent"].contains("edge"));
  EXPECT_NEAR(double{shape["dent"]["height"]}, 0.5 / std::sqrt(1.0625), 1e-5);
  const CommandResult text = run_command({"check", path("pit.obj")});
  EXPECT_TRUE(is_in(text.out, "is bent inwards; vertex ")) << text.out;
}

// The shapes of an archive: a hull with more points than corners, a hull that is not finite, a mesh
// with an invalid triangle, a compound, a sphere, a sphere of negative radius, an invalid dop.
io::PairsFile archive() {
  io::PairsFile file;
  io::SceneShapes& shapes = file.shapes;
  shapes.kind = {5, 5, 6, 7, 0, 0, 4};
  shapes.params.resize(7);
  shapes.params[4][0] = 1;
  shapes.params[5][0] = -1;
  shapes.params[6][0] = 5;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  shapes.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0.25f, 0.25f, 0}, {nan, 0, 0}};
  shapes.vertex_range = {{0, 5}, {0, 6}, {0, 5}, {0, 0}, {0, 0}, {0, 0}, {0, 3}};
  shapes.triangles = {{0, 1, 2}, {1, 1, 2}, {0, 2, 3}};
  shapes.triangle_range.resize(7);
  shapes.triangle_range[2] = {0, 3};
  shapes.child_range.resize(7);
  shapes.child_range[3] = {0, 2};
  shapes.child_shape = {0, 4};
  shapes.child_position.resize(2);
  shapes.child_orientation = {{0, 0, 0, 1}, {0, 0, 0, 1}};
  return file;
}

TEST_F(CheckTest, RoundShapesOfEverySize) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  io::PairsFile file;
  file.shapes.kind = {9, 9, 9, 10, 10, 11, 11, 11};
  file.shapes.params = {{1, 2},  {1, -2},   {nan, 1},   {1, 0},
                        {-1, 2}, {1, 2, 3}, {1, 2, -3}, {1, nan, 1}};
  ASSERT_TRUE(io::write_pairs(path("pairs.npz"), file));
  const auto shapes = checked(path("pairs.npz"));
  const char* const kinds[] = {"cylinder", "cylinder",  "cylinder",  "cone",
                               "cone",     "ellipsoid", "ellipsoid", "ellipsoid"};
  const bool valid[] = {true, false, false, true, false, true, false, false};
  ASSERT_EQ(shapes.size(), std::size(kinds));
  for (size_t i = 0; i < shapes.size(); ++i) {
    EXPECT_EQ(shapes[i]["kind"], kinds[i]);
    EXPECT_EQ(shapes[i]["valid"], valid[i]) << i;
    EXPECT_EQ(shapes[i].contains("problem"), !valid[i]);
  }
}

TEST_F(CheckTest, ArchiveOfAllKinds) {
  ASSERT_TRUE(io::write_pairs(path("pairs.npz"), archive()));
  const auto shapes = checked(path("pairs.npz"));
  ASSERT_EQ(shapes.size(), 7u);
  EXPECT_EQ(shapes[0]["form"], "polygon");
  EXPECT_EQ(shapes[0]["corners"], 3);
  EXPECT_EQ(shapes[0]["faces"], 2);
  EXPECT_EQ(shapes[0]["duplicates"], 1);
  EXPECT_EQ(shapes[0]["inside"], 1);
  EXPECT_EQ(shapes[1]["valid"], false);
  EXPECT_FALSE(shapes[1].contains("form"));
  EXPECT_EQ(shapes[2]["repeated_index"]["count"], 1);
  EXPECT_EQ(shapes[2]["repeated_index"]["first"][0]["triangle"], 1);
  EXPECT_EQ(shapes[2]["without_area"]["count"], 1);
  EXPECT_EQ(shapes[2]["duplicate_vertices"]["first"][0]["same_as"], 0);
  EXPECT_EQ(shapes[2]["unused_vertices"], 1);
  EXPECT_EQ(shapes[3]["children"], 2);
  EXPECT_EQ(shapes[4]["valid"], true);
  EXPECT_EQ(shapes[5]["valid"], false);
  EXPECT_TRUE(is_in(shapes[6]["problem"], "a dop of k = 5"));

  const CommandResult text = run_command({"check", path("pairs.npz")});
  EXPECT_EQ(text.code, 0);
  EXPECT_TRUE(is_in(text.out, "triangle 1 (1, 1, 2) at (1, 0, 0) (1, 0, 0) (0, 1, 0)\n"))
      << text.out;
}

TEST_F(CheckTest, FilesThatCannotBeRead) {
  expect_error({"check", path("absent.obj")}, {"absent.obj"});
  expect_error({"check", path("absent.npz")}, {"absent.npz"});
  for (const char* name : {"bad.obj", "bad.stl", "bad.gltf", "bad.glb", "bad.npz", "bad.txt"}) {
    std::ofstream(path(name)) << "no mesh at all";
    expect_error({"check", path(name)}, {name});
  }
  std::ofstream(path("points.obj")) << "v 0 0 0\nv 1 0 0\n";
  expect_error({"check", path("points.obj")}, {"points.obj"});
  io::PairsFile file = archive();
  ASSERT_TRUE(io::write_pairs(path("pairs.npz"), file));
  const CommandResult result = run_command({"check", path("pairs.npz"), "--json", path("o.json")});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(read_json(path("o.json"))["shapes"].size(), 7u);
}

}  // namespace
}  // namespace carom::cli

// Scales of files in the commands: answers are those of shapes of scaled points.
#include <algorithm>
#include <cmath>

#include "carom/shapes/mesh_geometry.h"
#include "cli/scenes/shapes.h"
#include "io/pairs_file.h"
#include "io/scene.h"
#include "tests/cli/pairs/pair_results.h"

namespace carom::cli {
namespace {

using Scale = std::array<float, 3>;

constexpr uint32_t kBallShape = 0, kBoxShape = 1, kMeshShape = 2, kScaledShape = 3,
                   kShapeOfPoints = 4;

// A ball, a box, a mesh, the same vertices and triangles with a scale, and a mesh of scaled points.
io::SceneShapes shapes_with(const Scale& scale) {
  constexpr uint32_t kSide = 5, kVertices = kSide * kSide,
                     kTriangles = 2 * (kSide - 1) * (kSide - 1);
  const bool mirrors = scale[0] * scale[1] * scale[2] < 0;
  io::SceneShapes shapes;
  shapes.kind = {0, 3, 6, 6, 6};
  shapes.params = {{0.5f}, {0.5f, 0.25f, 0.25f}, {1, 0}, {1, 0}, {1, 0}};
  shapes.vertex_range = {{0, 0}, {0, 0}, {0, kVertices}, {0, kVertices}, {kVertices, kVertices}};
  shapes.triangle_range = {
      {0, 0}, {0, 0}, {0, kTriangles}, {0, kTriangles}, {kTriangles, kTriangles}};
  shapes.scale = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, scale, {1, 1, 1}};
  for (const bool is_scaled : {false, true}) {
    for (uint32_t i = 0; i < kVertices; ++i) {
      const float x = float(i % kSide) - 2, y = float(i / kSide) - 2;
      const std::array<float, 3> v = {x, y, 0.3f * std::sin(2 * x + 3 * y)};
      shapes.vertices.push_back(is_scaled ? Scale{v[0] * scale[0], v[1] * scale[1], v[2] * scale[2]}
                                          : v);
    }
    for (uint32_t i = 0; i + kSide < kVertices; ++i) {
      if (i % kSide == kSide - 1) continue;
      for (const auto& [a, b, c] :
           {std::array{i, i + 1, i + kSide + 1}, std::array{i, i + kSide + 1, i + kSide}}) {
        shapes.triangles.push_back(is_scaled && mirrors ? std::array{a, c, b}
                                                        : std::array{a, b, c});
      }
    }
  }
  return shapes;
}

class ScaledPairsTest : public CliTest {
 protected:
  static io::PairsFile pairs_on(uint32_t ground, const Scale& scale) {
    io::PairsFile file;
    file.shapes = shapes_with(scale);
    for (int k = 0; k < 120; ++k) {
      const auto turn = static_cast<float>(k);
      ++file.pairs;
      file.a.shape.push_back(ground);
      file.b.shape.push_back(k % 2 ? kBoxShape : kBallShape);
      file.a.position32.push_back({0, 0, 0});
      file.b.position32.push_back({2 * scale[0] * std::sin(turn), scale[1] * std::cos(1.3f * turn),
                                   0.25f + 0.5f * std::sin(2.1f * turn)});
      file.a.orientation.push_back({0, 0, 0, 1});
      file.b.orientation.push_back({0.25f, std::sin(turn), 0.5f, 1});
    }
    return file;
  }

  PairResultsFile found(const io::PairsFile& file, const std::string& detail) {
    EXPECT_TRUE(io::write_pairs(path("in.npz"), file));
    const CommandResult result =
        run_command({"pairs", path("in.npz"), "-o", path("out.npz"), "--detail", detail});
    EXPECT_EQ(result.code, 0) << result.err;
    return read_pair_results(path("out.npz"), file.pairs);
  }
};

TEST_F(ScaledPairsTest, AnswersAreThoseOfScaledPoints) {
  for (const Scale& scale : {Scale{2, 2, 2}, Scale{0.5f, 1.5f, 1}, Scale{-1, 0.7f, 2}}) {
    for (const char* detail : {"overlap", "contact", "manifold", "distance"}) {
      const PairResultsFile with_scale = found(pairs_on(kScaledShape, scale), detail);
      const PairResultsFile of_points = found(pairs_on(kShapeOfPoints, scale), detail);
      EXPECT_EQ(with_scale.overlap, of_points.overlap) << detail;
      EXPECT_EQ(with_scale.separation, of_points.separation) << detail;
      EXPECT_EQ(with_scale.normal, of_points.normal) << detail;
      EXPECT_EQ(with_scale.point_a, of_points.point_a) << detail;
      EXPECT_EQ(with_scale.manifold_count, of_points.manifold_count) << detail;
      EXPECT_EQ(with_scale.sub_a, of_points.sub_a) << detail;
      EXPECT_EQ(std::count(with_scale.status.begin(), with_scale.status.end(), 0), 120) << detail;
    }
  }
}

TEST_F(ScaledPairsTest, ShapesThatDifferInTheirScaleShareAGeometry) {
  const auto shapes = convert_shapes(shapes_with({2, -1, 1}), "");
  ASSERT_TRUE(shapes);
  const auto& mesh = *std::get<Mesh>((*shapes)[kMeshShape]).geometry;
  const auto& with_scale = *std::get<Mesh>((*shapes)[kScaledShape]).geometry;
  EXPECT_FALSE(mesh.is_scaled());
  EXPECT_TRUE(with_scale.is_scaled());
  EXPECT_EQ(mesh.vertices().data(), with_scale.vertices().data());
}

// A sphere becomes an ellipsoid, which turns.
TEST_F(ScaledPairsTest, VerifyFindsTheSame) {
  const Scale scale = {-1, 0.7f, 2};
  io::SceneInfo info;
  info.shapes = shapes_with(scale);
  info.shapes.scale[kBallShape] = {1, 0.5f, 2};
  info.has_orientation = true;
  info.bodies = 25;
  io::SceneFrame frame;
  const io::PairsFile pairs = pairs_on(kScaledShape, scale);
  for (size_t i = 0; i < info.bodies; ++i) {
    info.body_shape.push_back(i == 0 ? kScaledShape : pairs.b.shape[i]);
    info.body_motion.push_back(i == 0 ? 0 : 2);
    const auto& side = i == 0 ? pairs.a : pairs.b;
    frame.position32.insert(frame.position32.end(), side.position32[i].begin(),
                            side.position32[i].end());
    frame.orientation.insert(frame.orientation.end(), side.orientation[i].begin(),
                             side.orientation[i].end());
  }
  auto writer = io::SceneWriter::create(path("scene.npz"), info);
  ASSERT_TRUE(writer) << writer.error().message;
  ASSERT_TRUE(writer->write_frame(frame));
  ASSERT_TRUE(writer->finish());
  EXPECT_TRUE(io::write_pairs(path("in.npz"), pairs));
  for (const char* file : {"scene.npz", "in.npz"}) {
    const CommandResult result = run_command({"verify", path(file)});
    EXPECT_EQ(result.code, 0) << file << result.out << result.err;
  }
  EXPECT_EQ(run_command({"run", path("scene.npz"), "--detail", "manifold"}).code, 0);
}

TEST_F(ScaledPairsTest, ScalesThatMakeNoShapeAreNamed) {
  io::PairsFile file = pairs_on(kMeshShape, {1, 1, 1});
  file.shapes.kind[kBoxShape] = 9;  // a cylinder
  file.shapes.scale[kBoxShape] = {1, 2, 1};
  ASSERT_TRUE(io::write_pairs(path("bad.npz"), file));
  const std::string what =
      "not valid with its scale: a cylinder by the scale (1, 2, 1) is no shape";
  expect_error({"pairs", path("bad.npz"), "-o", path("out.npz")},
               {"bad.npz: shape_kind: shape 1 is " + what});
  const CommandResult checked = run_command({"check", path("bad.npz")});
  EXPECT_EQ(checked.code, 0);
  EXPECT_NE(checked.out.find("no: it is " + what), std::string::npos) << checked.out;
}

TEST_F(ScaledPairsTest, ScalesThatShearAChildAreNamed) {
  io::PairsFile file;
  file.shapes.kind = {9, 7};  // a cylinder in a compound
  file.shapes.params = {{1, 2}, {}};
  file.shapes.child_range = {{0, 0}, {0, 1}};
  file.shapes.child_shape = {0};
  file.shapes.child_position = {{0, 0, 1}};
  file.shapes.child_orientation = {{0.3f, 0, 0, 1}};
  file.shapes.scale = {{1, 1, 1}, {1, 1, 2}};
  file.pairs = 1;
  file.a.shape = file.b.shape = {1};
  file.a.position32 = file.b.position32 = {{0, 0, 0}};
  ASSERT_TRUE(io::write_pairs(path("bad.npz"), file));
  const std::string what =
      "not valid with its scale: child 0 of the compound: a cylinder would be sheared";
  expect_error({"pairs", path("bad.npz"), "-o", path("out.npz")},
               {"bad.npz: shape_kind: shape 1 is " + what});
  const CommandResult checked = run_command({"check", path("bad.npz")});
  EXPECT_NE(checked.out.find("no: it is " + what), std::string::npos) << checked.out;
}

}  // namespace
}  // namespace carom::cli

// carom run --page: the data in the page. Only people can judge how it draws them.
#include <cmath>
#include <cstring>
#include <limits>
#include <set>

#include "carom/hulls/build_hull.h"
#include "carom/shapes/mesh_geometry.h"
#include "examples/scene_recorder.h"
#include "io/recording.h"
#include "io/scene.h"
#include "tests/cli/cli_test_util.h"

namespace carom::cli {
namespace {

using nlohmann::json;

class ScenePageTest : public CliTest {
 protected:
  // Runs a scene with these options, and returns the data of its page.
  json page_of(const std::string& scene, std::vector<std::string> options = {}) {
    options.insert(options.begin(), {"run", scene, "--page", path("page.html"), "--json", "-"});
    const CommandResult result = run_command(options);
    EXPECT_EQ(result.code, 0) << result.err;
    report_ = result.json();
    return data_in(text_of_page());
  }

  std::string text_of_page() const {
    std::ifstream file(path("page.html"));
    return {std::istreambuf_iterator<char>(file), {}};
  }

  const json& report() const { return report_; }

 private:
  static json data_in(const std::string& text) {
    const std::string before = "<script>const data = ", after = ";</script>";
    const size_t begin = text.find(before) + before.size();
    return json::parse(text.substr(begin, text.find(after, begin) - begin), nullptr, false);
  }

  json report_;
};

TEST_F(ScenePageTest, HoldsTheContactsOfTheLastFrame) {
  write_builtin("all kinds, float32", path("scene.npz"));
  for (const std::string detail : {"contact", "manifold"}) {
    const json data = page_of(path("scene.npz"), {"--detail", detail});
    const json& contact = data["contact"];
    EXPECT_EQ(data["scene"], path("scene.npz"));
    EXPECT_EQ(data["detail"], detail);
    EXPECT_EQ(data["frame"].get<int>() + 1, report()["frames"].get<int>());
    const size_t contacts = report()["contacts_per_frame"].back();
    EXPECT_GT(contacts, 10u);
    for (const char* column : {"a", "b", "separation", "points"}) {
      EXPECT_EQ(contact[column].size(), contacts) << column;
    }
    for (const char* column : {"normal", "arm_a", "arm_b"}) {
      EXPECT_EQ(contact[column].size(), 3 * contacts) << column;
    }
    size_t points = 0;
    for (const json& count : contact["points"]) points += count.get<size_t>();
    EXPECT_EQ(points > contacts, detail == "manifold");
    EXPECT_EQ(contact["point"].size(), 3 * points);
    EXPECT_EQ(contact["point_separation"].size(), points);
  }
}

TEST_F(ScenePageTest, HoldsEveryValidBodyAndEveryShapeOnce) {
  write_builtin("all kinds, float64", path("scene.npz"));
  const json data = page_of(path("scene.npz"));
  EXPECT_EQ(data["left_out"], report()["quarantined_per_frame"].back());
  const size_t bodies = report()["bodies"].get<size_t>() - data["left_out"].get<size_t>();
  EXPECT_EQ(data["body"]["index"].size(), bodies);
  EXPECT_EQ(data["body"]["motion"].size(), bodies);
  EXPECT_EQ(data["body"]["position"].size(), 3 * bodies);
  EXPECT_EQ(data["body"]["orientation"].size(), 4 * bodies);
  std::set<std::string> kinds;
  for (const size_t shape : data["body"]["shape"]) kinds.insert(data["shapes"][shape]["kind"]);
  EXPECT_EQ(kinds, (std::set<std::string>{"sphere", "capsule", "aabb", "box", "dop", "hull", "mesh",
                                          "compound", "halfspace", "triangle", "cylinder", "cone",
                                          "ellipsoid", "rounded_box", "rounded_hull"}));
  EXPECT_EQ(page_of("brownian:n=50,frames=2,shape=box")["shapes"].size(), 1u);
}

// Outlines name existing corners, and children precede their parents.
TEST_F(ScenePageTest, ShapesAreWhole) {
  write_builtin("all kinds, float32", path("scene.npz"));
  const json shapes = page_of(path("scene.npz"))["shapes"];
  for (size_t i = 0; i < shapes.size(); ++i) {
    for (const json& face : shapes[i].value("faces", json::array())) {
      EXPECT_GE(face.size(), 3u);
      for (const json& corner : face) {
        EXPECT_LT(3 * corner.get<size_t>(), shapes[i]["points"].size());
      }
    }
    for (const json& child : shapes[i].value("children", json::array())) {
      EXPECT_LT(child["shape"].get<size_t>(), i);
    }
  }
}

// Contacts of two meshes keep the normals of their faces, so the point on a triangle may lie beside
// it. A depth within its bound fixes the point on a rim less closely than one on a corner.
TEST_F(ScenePageTest, ContactsLieOnTheSurfaces) {
  const std::string scene = "brownian:n=300,frames=2,density=0.5,speed=0.5,shape=";
  for (const std::string shape : {"cube", "sphere", "box", "capsule", "hull", "mesh", "compound",
                                  "cylinder", "cone", "ellipsoid"}) {
    const json data = page_of(scene + shape, {"--detail", "manifold"});
    const json &on = data["surface"]["on"], &across = data["surface"]["across"];
    const size_t contacts = data["contact"]["a"].size();
    const size_t points = data["contact"]["point_separation"].size();
    EXPECT_GT(contacts, 20u) << shape;
    EXPECT_EQ(on["points"].get<size_t>(), 2 * contacts + points);
    EXPECT_EQ(across["points"].get<size_t>(), points);
    EXPECT_EQ(data["surface"]["left_out"], 0);
    EXPECT_LT(on["median"].get<double>(), 1e-7) << shape;
    const bool has_flat_rims = shape == "cylinder" || shape == "cone";
    if (shape != "mesh") {
      EXPECT_LT(on["greatest"].get<double>(), has_flat_rims ? 2e-4 : 1e-6) << shape;
    }
    if (shape != "mesh" && shape != "compound") {
      EXPECT_LT(across["greatest"].get<double>(), has_flat_rims ? 2e-4 : 2e-6) << shape;
    }
    EXPECT_LT(on["furthest_contact"].get<size_t>(), contacts);
  }
}

// Faces move outwards, and flat ones close the gaps. Euler's formula counts them.
TEST_F(ScenePageTest, HoldsRoundedShapes) {
  io::SceneInfo info;
  info.bodies = 5;
  info.shapes.kind = {3, 9, 10, 11, 3};
  info.shapes.params = {{1, 2, 3}, {1, 2}, {1, 2}, {1, 2, 3}, {1, 1, 1}};
  info.shapes.rounding = {0.5f, 0.25f, 0.25f, 0.25f, 0};
  info.body_shape = {0, 1, 2, 3, 4};
  auto writer = io::SceneWriter::create(path("scene.npz"), info);
  ASSERT_TRUE(writer) << writer.error().message;
  io::SceneFrame frame;
  frame.position32 = {0, 0, 0, 0, 0, 9, 9, 0, 0, 0, 9, 0, 9, 9, 0};
  ASSERT_TRUE(writer->write_frame(frame));
  ASSERT_TRUE(writer->finish());
  const json shapes = page_of(path("scene.npz"))["shapes"];
  ASSERT_EQ(shapes.size(), 5u);
  EXPECT_EQ(shapes[0]["kind"], "rounded_box");
  EXPECT_EQ(shapes[0]["points"].size(), 3u * 24);
  EXPECT_EQ(shapes[0]["faces"].size(), 6u + 12 + 8);
  EXPECT_EQ(shapes[0]["rounding"], 0.5);
  EXPECT_EQ(shapes[1]["kind"], "cylinder");
  EXPECT_EQ(shapes[1]["rounding"], 0.25);
  EXPECT_EQ(shapes[4]["kind"], "box");
  EXPECT_FALSE(shapes[4].contains("rounding"));
  for (size_t i = 0; i < 4; ++i) {
    size_t corners = 0;
    for (const json& face : shapes[i]["faces"]) corners += face.size();
    EXPECT_EQ(shapes[i]["points"].size() / 3 + shapes[i]["faces"].size(), corners / 2 + 2);
  }
  float greatest = 0;
  for (const json& x : shapes[0]["points"]) greatest = std::max(greatest, x.get<float>());
  EXPECT_EQ(greatest, 3.5f);
}

// A ball on level ground with a hole at one corner.
TEST_F(ScenePageTest, HoldsHeightFields) {
  io::SceneInfo info;
  info.bodies = 2;
  info.shapes.kind = {0, 12};
  info.shapes.params = {{1}, {3, 3, 1, 1}};
  info.shapes.height_range = {{0, 0}, {0, 9}};
  info.shapes.heights.assign(9, 0.5f);
  info.shapes.heights[0] = std::numeric_limits<float>::quiet_NaN();
  info.body_shape = {0, 1};
  auto writer = io::SceneWriter::create(path("scene.npz"), info);
  ASSERT_TRUE(writer) << writer.error().message;
  io::SceneFrame frame;
  frame.position32 = {0.25f, 0.5f, 1.25f, 0, 0, 0};
  ASSERT_TRUE(writer->write_frame(frame));
  ASSERT_TRUE(writer->finish());
  const json data = page_of(path("scene.npz"));
  const json& field = data["shapes"][data["body"]["shape"][1].get<size_t>()];
  EXPECT_EQ(field["kind"], "height_field");
  EXPECT_EQ(field["points"].size(), 3u * 9);
  EXPECT_EQ(field["faces"].size(), 2u * 3);
  EXPECT_EQ(data["surface"]["on"]["points"], 2);
  EXPECT_LT(data["surface"]["on"]["greatest"].get<double>(), 1e-6);
}

// A ball on a hull of points along a spiral.
TEST_F(ScenePageTest, HullsTooLargeForTheOracleAreNotMeasured) {
  io::SceneInfo info;
  info.bodies = 2;
  info.shapes.kind = {0, 5};
  info.shapes.params = {{1}, {}};
  constexpr uint32_t kPoints = 400;
  for (uint32_t i = 0; i < kPoints; ++i) {
    const float z = 1 - (2 * static_cast<float>(i) + 1) / kPoints,
                around = 2.4f * static_cast<float>(i);
    const float r = std::sqrt(1 - z * z);
    info.shapes.vertices.push_back({r * std::cos(around), r * std::sin(around), z});
  }
  info.shapes.vertex_range = {{0, 0}, {0, kPoints}};
  info.body_shape = {0, 1};
  auto writer = io::SceneWriter::create(path("scene.npz"), info);
  ASSERT_TRUE(writer) << writer.error().message;
  io::SceneFrame frame;
  frame.position32 = {0, 0, 0, 1.9f, 0, 0};
  ASSERT_TRUE(writer->write_frame(frame));
  ASSERT_TRUE(writer->finish());
  const json surface = page_of(path("scene.npz"))["surface"];
  EXPECT_EQ(surface["on"]["points"], 1);
  EXPECT_EQ(surface["left_out"], 1);
}

// 2 of 3 bodies move by hand.
TEST_F(ScenePageTest, HoldsThePosesOfAllFrames) {
  io::SceneInfo info;
  info.bodies = 3;
  info.dt = 0.5;
  info.shapes.kind = {0};
  info.shapes.params = {{1}};
  info.body_shape = {0, 0, 0};
  info.body_motion = {2, 0, 1};
  auto writer = io::SceneWriter::create(path("scene.npz"), info);
  ASSERT_TRUE(writer) << writer.error().message;
  io::SceneFrame frame;
  for (const float x : {1.0f, 2.0f}) {
    frame.position32 = {x, 0, 0, 5, 5, 5, 0, 3 * x, 0};
    ASSERT_TRUE(writer->write_frame(frame));
  }
  ASSERT_TRUE(writer->finish());
  const json track = page_of(path("scene.npz"))["track"];
  EXPECT_EQ(track["dt"], 0.5);
  EXPECT_EQ(track["frame"], json::array({0, 1}));
  EXPECT_EQ(track["body"], json::array({0, 2}));
  EXPECT_EQ(track["origin"], json::array({1.0, 0.0, 0.0}));
  // base64 of 2 frames x 2 bodies x (x y z relative to the origin, 0 0 0 1), float32.
  const std::string expected =
      "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAACAPwAAgL8AAEBAAAAAAAAAAAAAAAAAAAAAAAAAgD8AAIA/"
      "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAIA/AACAvwAAwEAAAAAAAAAAAAAAAAAAAAAAAACAPw==";
  EXPECT_EQ(track["pose"], expected);
}

// --- Scenes that the recorder of the examples has written ---

// A ground of two kinds, and a body of each kind that the recorder knows, which sink into it.
World recorded_world() {
  World world({.detail = Detail::regions});
  const std::vector<Eigen::Vector3f> corners = {{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}};
  const std::vector<std::array<uint32_t, 3>> triangles = {{0, 1, 2}, {0, 2, 3}};
  const std::vector<Eigen::Vector3f> tip = {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0.5f}};
  world.add({.shape = Halfspace{{0, 0.6f, 0.8f}, 0.25f}, .motion = Motion::fixed});
  world.add({.shape = Mesh{*make_mesh(corners, triangles, {.one_sided = true, .thickness = 0.5f})},
             .motion = Motion::fixed});
  const Shape shapes[] = {Sphere{0.5f}, Capsule{{-1, 0, 0}, {1, 0, 0.25f}, 0.5f},
                          Box{{0.5f, 0.25f, 0.75f}}, Hull{build_hull(tip)->geometry}};
  for (const Shape& shape : shapes) {
    const double x = 3.0 * static_cast<double>(world.size());
    world.add({.shape = shape, .position = {x - 9, 0, 1.9375}, .motion = Motion::kinematic});
  }
  return world;
}

// The numbers of base64.
std::vector<float> numbers_in(const std::string& base64) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  uint32_t bits = 0;
  for (size_t i = 0; i < base64.size() && base64[i] != '='; ++i) {
    bits = bits << 6 | static_cast<uint32_t>(digits.find(base64[i]));
    if (i % 4 != 0) bytes += static_cast<char>(bits >> (6 - 2 * (i % 4)) & 255);
  }
  std::vector<float> numbers(bytes.size() / sizeof(float));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(float));
  return numbers;
}

TEST_F(ScenePageTest, PlaysARecordedWorld) {
  World world = recorded_world();
  constexpr uint32_t kFirstMoving = 2;
  rigid::SceneRecorder recorder(world);
  world.exclude(world.id_of(5), world.id_of(1));
  recorder.exclude(5, 1);
  std::vector<float> poses;
  const Eigen::Vector3d origin = world.position(world.id_of(kFirstMoving));
  for (uint32_t frame = 0; frame < 7; ++frame) {
    for (uint32_t i = kFirstMoving; i < world.size(); ++i) {
      const BodyId id = world.id_of(i);
      const Eigen::Vector3d position(world.position(id).x(), 0.125 * frame, 1.9375 - 0.25 * frame);
      world.set_position(id, position);
      world.set_orientation(id, {1, 0.0625f * static_cast<float>(frame), 0, 0});
      for (const double x : position - origin) poses.push_back(static_cast<float>(x));
      for (const float x : world.orientation(id).coeffs()) poses.push_back(x);
    }
    recorder.add_frame();
  }
  world.step();
  ASSERT_TRUE(recorder.write(path("recorded.npz"), 0.25));

  const json data = page_of(path("recorded.npz"), {"--detail", "regions"});
  EXPECT_EQ(report()["frames"], 7);
  EXPECT_EQ(report()["bodies"], world.size());
  EXPECT_EQ(report()["contacts_per_frame"][0], 0);
  EXPECT_EQ(data["left_out"], 0);
  const json& track = data["track"];
  EXPECT_EQ(track["dt"], 0.25);
  EXPECT_EQ(track["frame"], json::array({0, 1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(track["body"], json::array({2, 3, 4, 5}));
  EXPECT_EQ(track["origin"], json::array({origin.x(), origin.y(), origin.z()}));
  EXPECT_EQ(numbers_in(track["pose"]), poses);

  // The contacts of the last frame are those of the world, so shapes and filters were read as well.
  const json& contact = data["contact"];
  EXPECT_GT(world.contacts().size(), 3u);
  ASSERT_EQ(contact["a"].size(), world.contacts().size());
  for (size_t i = 0; i < world.contacts().size(); ++i) {
    const Contact& expected = world.contacts()[i];
    EXPECT_EQ(contact["a"][i], expected.a);
    EXPECT_EQ(contact["b"][i], expected.b);
    EXPECT_EQ(contact["separation"][i].get<float>(), expected.separation);
    EXPECT_EQ(contact["points"][i], expected.manifold_count);
    EXPECT_FALSE(expected.a == 1 && expected.b == 5);
  }
  std::vector<std::string> kinds;
  for (const size_t shape : data["body"]["shape"]) kinds.push_back(data["shapes"][shape]["kind"]);
  EXPECT_EQ(kinds,
            (std::vector<std::string>{"halfspace", "mesh", "sphere", "capsule", "box", "hull"}));
}

// Poses of 100,000 bodies: 2.8 MB a frame, so that every second frame of four is kept, the last one
// among them.
TEST_F(ScenePageTest, KeepsNoMorePosesThanFit) {
  const json track = page_of("brownian:n=100000,frames=4,density=0.01")["track"];
  EXPECT_EQ(track["frame"], json::array({1, 3}));
}

TEST_F(ScenePageTest, NoContacts) {
  const json data = page_of("still:n=1,frames=2");
  EXPECT_EQ(data["body"]["index"], json::array({0}));
  EXPECT_EQ(data["contact"]["a"], json::array());
  EXPECT_EQ(data["surface"]["on"]["points"], 0);
  EXPECT_EQ(data["surface"]["on"]["greatest"], 0.0);
}

TEST_F(ScenePageTest, NoBodies) {
  io::SceneInfo info;
  info.shapes.kind = {0};
  info.shapes.params = {{1}};
  auto writer = io::SceneWriter::create(path("empty.npz"), info);
  ASSERT_TRUE(writer) << writer.error().message;
  ASSERT_TRUE(writer->write_frame({}));
  ASSERT_TRUE(writer->finish());
  const json data = page_of(path("empty.npz"));
  EXPECT_EQ(data["body"]["index"], json::array());
  EXPECT_EQ(data["shapes"], json::array());
  EXPECT_EQ(data["contact"]["a"], json::array());
}

// JSON has no NaN and no infinity.
TEST_F(ScenePageTest, BodiesThatAreNotFiniteAreLeftOut) {
  auto writer = io::RecordingWriter::create(path("bad.aabb"), "bad", "Cubes", 4);
  ASSERT_TRUE(writer);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> boxes = {0,   0, 0, 0, 1, 1, 1, 0,   //
                                    nan, 0, 0, 0, 1, 1, 1, 0,   //
                                    1,   1, 1, 0, 2, 2, 2, 0,   //
                                    5,   5, 5, 0, 4, 6, 6, 0};  // min > max
  ASSERT_TRUE(writer->write_frame(boxes));
  ASSERT_TRUE(writer->finish());
  const json data = page_of(path("bad.aabb"));
  EXPECT_EQ(data["body"]["index"], json::array({0, 2}));
  EXPECT_EQ(data["left_out"], 2);
  EXPECT_EQ(data["contact"]["b"], json::array({2}));
}

TEST_F(ScenePageTest, NeedsNothingElse) {
  std::filesystem::create_directory(path("<script>"));
  write_builtin("all kinds, float32", path("<script>/scene.npz"));
  const json data = page_of(path("<script>/scene.npz"));
  EXPECT_EQ(data["scene"], path("<script>/scene.npz"));
  const std::string text = text_of_page();
  EXPECT_EQ(text.find("<script>/scene.npz"), std::string::npos);
  EXPECT_EQ(text.find("CAROM_DATA"), std::string::npos);
  for (const char* other : {"src=", "href=", "import(", "fetch(", "http"}) {
    EXPECT_EQ(text.find(other), std::string::npos) << other;
  }
  EXPECT_NE(text.find("</html>"), std::string::npos);
}

}  // namespace
}  // namespace carom::cli

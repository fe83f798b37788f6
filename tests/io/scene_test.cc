#include "io/scene.h"

#include <cmath>
#include <functional>

#include "io/recording.h"
#include "tests/io/io_test_util.h"
#include "tests/support/special_floats.h"

namespace carom::io {
namespace {

using test::kNan;

using ::testing::HasSubstr;

// A sphere, a hull, a mesh, a compound of the first two, a cylinder, a cone, an ellipsoid and a
// height field; three bodies.
SceneInfo full_info() {
  SceneInfo info;
  info.bodies = 3;
  info.dt = 0.25;
  info.has_orientation = info.has_linear_velocity = info.has_angular_velocity = true;
  info.shapes.kind = {0, 5, 6, 7, 9, 10, 11, 12};
  info.shapes.params = {{1}, {}, {1, 0.5f}, {}, {1, 2}, {3, 4}, {5, 6, 7}, {3, 2, 0.5f, 1}};
  info.shapes.vertex_range = {{0, 0}, {0, 4}, {1, 3}};
  info.shapes.vertex_range.resize(8);
  info.shapes.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  info.shapes.triangle_range = {{0, 0}, {0, 0}, {0, 1}};
  info.shapes.triangle_range.resize(8);
  info.shapes.triangles = {{0, 1, 2}};
  info.shapes.child_range = {{0, 0}, {0, 0}, {0, 0}, {0, 2}};
  info.shapes.child_range.resize(8);
  info.shapes.child_shape = {0, 1};
  info.shapes.child_position = {{1, 0, 0}, {0, 1, 0}};
  info.shapes.child_orientation = {{0, 0, 0, 1}, {0, 0, 0, 1}};
  info.shapes.height_range.resize(8);
  info.shapes.height_range[7] = {1, 6};
  info.shapes.heights = {9, 1, 2, 3, 4, 5, 6};
  info.shapes.rounding = {0, 0.5f, 0, 0, 0.25f, 0, 1, 0};
  info.shapes.scale.resize(8, {1, 1, 1});
  info.shapes.scale[2] = {-2, 0.5f, 1e-6f};
  info.body_shape = {0, 3, 2};
  info.body_motion = {0, 1, 2};
  info.layer = {1, 2, 3};
  info.mask = {4, 5, 6};
  info.owner = {0, 7, 7};
  info.space = {0, 4, 4};
  info.sensor = {0, 0, 1};
  info.excluded_pairs = {{1, 2}, {0, 2}};
  return info;
}

SceneFrame frame_of(size_t f) {
  SceneFrame frame;
  for (size_t i = 0; i < 12; ++i) {
    const float value = static_cast<float>(100 * f + i);
    frame.orientation.push_back(value + 0.5f);
    if (i >= 9) continue;
    frame.position32.push_back(value);
    frame.position64.push_back(value + 1e-12);
    frame.linear_velocity.push_back(-value);
    frame.angular_velocity.push_back(2 * value);
  }
  return frame;
}

class SceneTest : public TemporaryFolder {
 protected:
  void write_scene(const SceneInfo& info, size_t frames,
                   Compression compression = Compression::kDeflated) {
    auto writer = SceneWriter::create(path("s.npz"), info, compression);
    ASSERT_TRUE(succeeds(writer));
    for (size_t f = 0; f < frames; ++f) ASSERT_TRUE(succeeds(writer->write_frame(frame_of(f))));
    ASSERT_TRUE(succeeds(writer->finish()));
    ASSERT_EQ(entries(), std::vector<std::string>{"s.npz"});
  }

  // The error of opening a small scene (one sphere, two bodies) after `change` to its members.
  std::string error_after(const std::function<void(std::vector<RawMember>&)>& change) {
    std::vector<RawMember> members = {
        array<int32_t>("carom_version", "<i4", "(1,)", {1}),
        array<uint8_t>("shape_kind", "|u1", "(1,)", {0}),
        array<float>("shape_params", "<f4", "(1, 8)", {1, 0, 0, 0, 0, 0, 0, 0}),
        array<uint32_t>("body_shape", "<u4", "(2,)", {0, 0}),
        array<float>("position", "<f4", "(1, 2, 3)", {1, 2, 3, 4, 5, 6}),
    };
    change(members);
    write_zip(path("bad.npz"), members, true);
    const auto scene = open_scene(path("bad.npz"));
    if (!scene) return message_of(scene);
    SceneFrame frame;
    const std::string message = message_of((*scene)->read_frame(frame));
    // Reading the frame again gives the same error.
    EXPECT_EQ(message_of((*scene)->read_frame(frame)), message);
    return message;
  }

  std::string error_with(const RawMember& changed) {
    return error_after([&](std::vector<RawMember>& members) {
      std::erase_if(members, [&](const RawMember& m) { return m.name == changed.name; });
      members.push_back(changed);
    });
  }

  std::string error_without(const std::string& name) {
    return error_after([&](std::vector<RawMember>& members) {
      std::erase_if(members, [&](const RawMember& m) { return m.name == name + ".npy"; });
    });
  }

  template <class T>
  static RawMember array(const std::string& name, const std::string& descr,
                         const std::string& shape, const std::vector<T>& values) {
    return {name + ".npy",
            npy_bytes("{'descr': '" + descr + "', 'fortran_order': False, 'shape': " + shape + "}",
                      raw(values))};
  }

  // The message of the check of full_info() after `change`.
  static std::string check_after(const std::function<void(SceneInfo&)>& change) {
    SceneInfo info = full_info();
    change(info);
    return message_of(check_scene(info, "F"));
  }
};

TEST_F(SceneTest, ReadsWhatItWritesAndWrapsAround) {
  for (const bool float64 : {false, true}) {
    SceneInfo info = full_info();
    info.float64_positions = float64;
    write_scene(info, 3, float64 ? Compression::kStored : Compression::kDeflated);
    const auto scene = open_scene(path("s.npz"));
    ASSERT_TRUE(succeeds(scene));
    const SceneInfo& read = (*scene)->info();
    EXPECT_EQ(read.name, "s");
    EXPECT_EQ(read.frames, 3u);
    EXPECT_EQ(read.bodies, 3u);
    EXPECT_EQ(read.dt, 0.25);
    EXPECT_EQ(read.float64_positions, float64);
    EXPECT_FALSE(read.bounds_recording);
    EXPECT_EQ(read.shapes.kind, info.shapes.kind);
    EXPECT_EQ(read.shapes.params, info.shapes.params);
    EXPECT_EQ(read.shapes.rounding, info.shapes.rounding);
    EXPECT_EQ(read.shapes.vertex_range, info.shapes.vertex_range);
    EXPECT_EQ(read.shapes.vertices, info.shapes.vertices);
    EXPECT_EQ(read.shapes.triangle_range, info.shapes.triangle_range);
    EXPECT_EQ(read.shapes.triangles, info.shapes.triangles);
    EXPECT_EQ(read.shapes.child_range, info.shapes.child_range);
    EXPECT_EQ(read.shapes.child_shape, info.shapes.child_shape);
    EXPECT_EQ(read.shapes.child_position, info.shapes.child_position);
    EXPECT_EQ(read.shapes.child_orientation, info.shapes.child_orientation);
    EXPECT_EQ(read.shapes.height_range, info.shapes.height_range);
    EXPECT_EQ(read.shapes.heights, info.shapes.heights);
    EXPECT_EQ(read.shapes.scale, info.shapes.scale);
    EXPECT_EQ(read.body_shape, info.body_shape);
    EXPECT_EQ(read.body_motion, info.body_motion);
    EXPECT_EQ(read.layer, info.layer);
    EXPECT_EQ(read.mask, info.mask);
    EXPECT_EQ(read.owner, info.owner);
    EXPECT_EQ(read.space, info.space);
    EXPECT_EQ(read.sensor, info.sensor);
    EXPECT_EQ(read.excluded_pairs, info.excluded_pairs);
    SceneFrame frame;
    for (size_t f = 0; f < 7; ++f) {
      ASSERT_TRUE(succeeds((*scene)->read_frame(frame)));
      const SceneFrame expected = frame_of(f % 3);
      EXPECT_EQ(frame.position32, float64 ? std::vector<float>{} : expected.position32);
      EXPECT_EQ(frame.position64, float64 ? expected.position64 : std::vector<double>{});
      EXPECT_EQ(frame.orientation, expected.orientation);
      EXPECT_EQ(frame.linear_velocity, expected.linear_velocity);
      EXPECT_EQ(frame.angular_velocity, expected.angular_velocity);
    }
  }
}

TEST_F(SceneTest, StreamingEqualsReadingWhole) {
  write_scene(full_info(), 5);
  const auto whole = NpzReader::open(path("s.npz"))->read<float>("position", {5, 3, 3});
  ASSERT_TRUE(succeeds(whole));
  const auto scene = open_scene(path("s.npz"));
  std::vector<float> streamed;
  SceneFrame frame;
  for (size_t f = 0; f < 5; ++f) {
    ASSERT_TRUE(succeeds((*scene)->read_frame(frame)));
    streamed.insert(streamed.end(), frame.position32.begin(), frame.position32.end());
  }
  EXPECT_EQ(streamed, *whole);
}

TEST_F(SceneTest, BuffersAreReused) {
  write_scene(full_info(), 4);
  const auto scene = open_scene(path("s.npz"));
  SceneFrame frame;
  ASSERT_TRUE(succeeds((*scene)->read_frame(frame)));
  const float* const position = frame.position32.data();
  const float* const orientation = frame.orientation.data();
  for (size_t f = 0; f < 6; ++f) ASSERT_TRUE(succeeds((*scene)->read_frame(frame)));
  EXPECT_EQ(frame.position32.data(), position);
  EXPECT_EQ(frame.orientation.data(), orientation);
}

TEST_F(SceneTest, ReadsOnlyWhatIsWanted) {
  write_scene(full_info(), 2);
  const auto scene = open_scene(path("s.npz"), {false, true, false});
  ASSERT_TRUE(succeeds(scene));
  EXPECT_TRUE((*scene)->info().has_orientation);
  SceneFrame frame;
  ASSERT_TRUE(succeeds((*scene)->read_frame(frame)));
  EXPECT_TRUE(frame.orientation.empty());
  EXPECT_EQ(frame.linear_velocity, frame_of(0).linear_velocity);
  EXPECT_TRUE(frame.angular_velocity.empty());

  const auto other = open_scene(path("s.npz"));
  (*other)->want({true, false, false});
  ASSERT_TRUE(succeeds((*other)->read_frame(frame)));
  EXPECT_EQ(frame.orientation, frame_of(0).orientation);
  EXPECT_TRUE(frame.linear_velocity.empty());
}

TEST_F(SceneTest, OptionalArraysHaveDefaults) {
  EXPECT_EQ(error_after([](std::vector<RawMember>&) {}), "");
  const auto scene = open_scene(path("bad.npz"));
  ASSERT_TRUE(succeeds(scene));
  EXPECT_EQ((*scene)->info().dt, 1.0 / 60.0);
  EXPECT_TRUE((*scene)->info().body_motion.empty());
  EXPECT_FALSE((*scene)->info().has_orientation);
}

TEST_F(SceneTest, MissingMembersAreNamed) {
  const std::string prefix = path("bad.npz") + ": member ";
  EXPECT_EQ(error_without("carom_version"),
            prefix + "carom_version: is missing (int32 (1,) was expected)");
  EXPECT_EQ(error_without("shape_kind"),
            prefix + "shape_kind: is missing (uint8 (any,) was expected)");
  EXPECT_EQ(error_without("shape_params"),
            prefix + "shape_params: is missing (float32 (1, 8) was expected)");
  EXPECT_EQ(error_without("body_shape"),
            prefix + "body_shape: is missing (uint32 (2,) was expected)");
  EXPECT_EQ(error_without("position"),
            prefix + "position: is missing (float32 or float64 (any, any, 3) was expected)");
}

TEST_F(SceneTest, WrongMembersAreNamed) {
  EXPECT_THAT(error_with(array<int32_t>("carom_version", "<i4", "(1,)", {2})),
              HasSubstr("member carom_version: is 2 (1 was expected)"));
  EXPECT_THAT(error_with(array<int32_t>("position", "<i4", "(1, 2, 3)", {1, 2, 3, 4, 5, 6})),
              HasSubstr("member position: has dtype int32 (float32 or float64"));
  EXPECT_THAT(error_with(array<float>("position", "<f4", "(2, 3)", {1, 2, 3, 4, 5, 6})),
              HasSubstr("member position: has shape (2, 3)"));
  EXPECT_THAT(error_with(array<float>("position", "<f4", "(0, 2, 3)", {})),
              HasSubstr("member position: holds no frame"));
  EXPECT_THAT(error_with(array<float>("position", "<f4", "(1, 1, 3)", {1, 2, 3})),
              HasSubstr("member body_shape: has shape (2,) (uint32 (1,) was expected)"));
  EXPECT_THAT(error_with(array<float>("orientation", "<f4", "(1, 2, 3)", {1, 2, 3, 4, 5, 6})),
              HasSubstr("member orientation: has shape (1, 2, 3) (float32 (1, 2, 4)"));
  EXPECT_THAT(error_with(array<float>("body_motion", "<f4", "(2,)", {1, 1})),
              HasSubstr("member body_motion: has dtype float32 (uint8 (2,)"));
  EXPECT_THAT(error_with(array<uint32_t>("body_space", "<u4", "(1,)", {1})),
              HasSubstr("member body_space: has shape (1,) (uint32 (2,) was expected)"));
  EXPECT_THAT(error_with(array<uint32_t>("excluded_pairs", "<u4", "(2,)", {0, 1})),
              HasSubstr("member excluded_pairs: has shape (2,) (uint32 (any, 2) was expected)"));
  EXPECT_THAT(error_with(array<uint32_t>("excluded_pairs", "<u4", "(1, 3)", {0, 1, 1})),
              HasSubstr("member excluded_pairs: has shape (1, 3)"));
  EXPECT_THAT(error_with(array<int32_t>("excluded_pairs", "<i4", "(1, 2)", {0, 1})),
              HasSubstr("member excluded_pairs: has dtype int32"));
  EXPECT_THAT(error_with(array<uint32_t>("excluded_pairs", "<u4", "(2, 2)", {0, 1, 1, 0})),
              HasSubstr("member excluded_pairs: row 1 is (1, 0)"));
  EXPECT_EQ(error_with(array<uint32_t>("excluded_pairs", "<u4", "(0, 2)", {})), "");
  EXPECT_THAT(error_with(array<double>("dt", "<f8", "()", {1})),
              HasSubstr("member dt: has shape () (float64 (1,)"));
}

TEST_F(SceneTest, ScalesAreFiniteAndNotZero) {
  for (const float factor : {0.0f, -0.0f, kNan, INFINITY}) {
    EXPECT_THAT(error_with(array<float>("shape_scale", "<f4", "(1, 3)", {1, factor, 2})),
                HasSubstr("member shape_scale: element 0 is (1, "));
  }
  EXPECT_EQ(error_with(array<float>("shape_scale", "<f4", "(1, 3)", {1, 0, 2})),
            path("bad.npz") +
                ": member shape_scale: element 0 is (1, 0, 2) (finite factors other than 0 were "
                "expected)");
  EXPECT_THAT(error_with(array<float>("shape_scale", "<f4", "(1,)", {1})),
              HasSubstr("member shape_scale: has shape (1,) (float32 (1, 3) was expected)"));
  EXPECT_THAT(error_with(array<float>("shape_scale", "<f4", "(2, 3)", {1, 1, 1, 1, 1, 1})),
              HasSubstr("member shape_scale: has shape (2, 3)"));
  EXPECT_EQ(error_with(array<float>("shape_scale", "<f4", "(1, 3)", {1, -1, 2})), "");
}

TEST_F(SceneTest, OtherMembersArePassedOver) {
  EXPECT_EQ(error_with(array<float>("shape_scale", "<f4", "(1, 3)", {1, 1, 1})), "");
  EXPECT_EQ(error_with(array<float>("my_colours", "<f4", "(1,)", {1})), "");
}

TEST_F(SceneTest, RoundingsAreLengthsOfKindsThatHaveThem) {
  EXPECT_EQ(error_with(array<float>("shape_radius", "<f4", "(1,)", {0.5f})),
            path("bad.npz") +
                ": member shape_radius: element 0 is 0.5 for a shape of kind 0 (0 was expected)");
  for (const float radius : {-0.5f, kNan, INFINITY, -INFINITY}) {
    EXPECT_THAT(error_with(array<float>("shape_radius", "<f4", "(1,)", {radius})),
                HasSubstr("(a number >= 0 was expected)"));
  }
  EXPECT_THAT(error_with(array<float>("shape_radius", "<f4", "(2,)", {0, 0})),
              HasSubstr("member shape_radius: has shape (2,) (float32 (1,) was expected)"));
  EXPECT_EQ(error_with(array<float>("shape_radius", "<f4", "(1,)", {-0.0f})), "");
}

TEST_F(SceneTest, ArraysWithoutFiniteValuesAreErrors) {
  EXPECT_EQ(error_with(array<float>("position", "<f4", "(1, 2, 3)", std::vector<float>(6, kNan))),
            path("bad.npz") +
                ": member position: frame 0 holds no finite value (at least one was expected)");
  EXPECT_THAT(
      error_with(array<float>("linear_velocity", "<f4", "(1, 2, 3)", std::vector<float>(6, kNan))),
      HasSubstr("member linear_velocity: frame 0 holds no finite value"));
  EXPECT_THAT(
      error_with(array<float>("shape_params", "<f4", "(1, 8)", std::vector<float>(8, INFINITY))),
      HasSubstr("member shape_params: holds no finite value"));
  EXPECT_EQ(error_with(array<float>("position", "<f4", "(1, 2, 3)", {kNan, 1, 1, 1, 1, 1})), "");
}

TEST_F(SceneTest, ChecksValuesAndIndices) {
  EXPECT_EQ(check_after([](SceneInfo&) {}), "");
  EXPECT_EQ(check_after([](SceneInfo& i) { i.shapes.kind[1] = 13; }),
            "F: member shape_kind: element 1 is the unknown kind 13 (0 to 12 was expected)");
  EXPECT_EQ(check_after([](SceneInfo& i) { i.body_shape[2] = 8; }),
            "F: member body_shape: element 2 is 8 (at most 7 was expected)");
  EXPECT_EQ(check_after([](SceneInfo& i) { i.body_motion[0] = 3; }),
            "F: member body_motion: element 0 is 3 (at most 2 was expected)");
  EXPECT_EQ(check_after([](SceneInfo& i) { i.sensor[0] = 2; }),
            "F: member body_sensor: element 0 is 2 (at most 1 was expected)");
  EXPECT_THAT(check_after([](SceneInfo& i) { i.space.push_back(1); }),
              HasSubstr("F: member body_space: holds 4 elements"));
  EXPECT_EQ(check_after([](SceneInfo& i) {
              i.excluded_pairs[1] = {2, 1};
            }),
            "F: member excluded_pairs: row 1 is (2, 1) (two bodies a < b of 3 were expected)");
  EXPECT_THAT(check_after([](SceneInfo& i) {
                i.excluded_pairs[0] = {1, 1};
              }),
              HasSubstr("F: member excluded_pairs: row 0 is (1, 1)"));
  EXPECT_THAT(check_after([](SceneInfo& i) {
                i.excluded_pairs[0] = {0, 3};
              }),
              HasSubstr("F: member excluded_pairs: row 0 is (0, 3)"));
  EXPECT_EQ(check_after([](SceneInfo& i) {
              i.excluded_pairs.assign(9, {0, 1});
            }),
            "")
      << "a pair may be there twice";
  EXPECT_THAT(check_after([](SceneInfo& i) { i.layer.pop_back(); }),
              HasSubstr("member body_layer: holds 2 elements"));
  EXPECT_EQ(check_after([](SceneInfo& i) {
              i.shapes.vertex_range[1] = {1, 4};
            }),
            "F: member shape_vertex_range: element 1 is first 1, count 4 (a range inside 4 "
            "elements was expected)");
  EXPECT_THAT(check_after([](SceneInfo& i) {
                i.shapes.vertex_range[1] = {UINT32_MAX, UINT32_MAX};
              }),
              HasSubstr("first 4294967295, count 4294967295"));
  EXPECT_EQ(check_after([](SceneInfo& i) {
              i.shapes.vertices.resize(1 << 20);
              i.shapes.vertex_range.assign(200, {0, 1 << 20});
              i.shapes.kind.resize(200);
              i.shapes.params.resize(200);
              i.shapes.triangle_range.resize(200);
              i.shapes.child_range.resize(200);
              i.shapes.height_range.resize(200);
              i.shapes.rounding.clear();
              i.shapes.scale.resize(200, {1, 1, 1});
            }),
            "F: member shape_vertex_range: names 209715200 elements of 1048576 (at most 134217728 "
            "were expected)");
  EXPECT_THAT(check_after([](SceneInfo& i) {
                i.shapes.triangle_range[2] = {1, 1};
              }),
              HasSubstr("member shape_triangle_range: element 2"));
  EXPECT_THAT(check_after([](SceneInfo& i) {
                i.shapes.child_range[3] = {1, 2};
              }),
              HasSubstr("member shape_child_range: element 3"));
  EXPECT_EQ(check_after([](SceneInfo& i) { i.shapes.triangles[0][1] = 3; }),
            "F: member triangles: element 0 names vertex 3 (shape 2 has 3)");
  EXPECT_EQ(check_after([](SceneInfo& i) { i.shapes.child_shape[1] = 3; }),
            "F: member child_shape: element 1 is shape 3, a compound (any other kind was "
            "expected)");
  EXPECT_EQ(check_after([](SceneInfo& i) { i.shapes.child_shape[1] = 8; }),
            "F: member child_shape: element 1 is shape 8 (there are 8)");
  EXPECT_THAT(check_after([](SceneInfo& i) { i.shapes.child_position.pop_back(); }),
              HasSubstr("member child_position: holds 1 elements (2 were expected)"));
  EXPECT_EQ(check_after([](SceneInfo& i) { i.shapes.vertex_range.clear(); }),
            "F: member shape_vertex_range: is missing (shape 1 of kind 5 needs it)");
  for (const double dt : {0.0, -1.0, double{NAN}, double{INFINITY}}) {
    EXPECT_THAT(check_after([&](SceneInfo& i) { i.dt = dt; }), HasSubstr("F: member dt: is "));
  }
}

TEST_F(SceneTest, WriterRefusesWhatCannotBeAndLeavesNothing) {
  SceneInfo info = full_info();
  info.body_shape[0] = 9;
  EXPECT_THAT(message_of(SceneWriter::create(path("s.npz"), info)), HasSubstr("body_shape"));
  info = full_info();
  info.bounds_recording = true;
  EXPECT_THAT(message_of(SceneWriter::create(path("s.npz"), info)),
              HasSubstr("cannot hold a recording"));
  EXPECT_THAT(message_of(SceneWriter::create(path("none/s.npz"), full_info())),
              HasSubstr("none/s.npz: cannot be created"));
  {
    auto writer = SceneWriter::create(path("s.npz"), full_info());
    ASSERT_TRUE(succeeds(writer));
    EXPECT_THAT(message_of(writer->finish()), HasSubstr("would hold no frame"));
    SceneFrame frame = frame_of(0);
    frame.orientation.pop_back();
    EXPECT_THAT(message_of(writer->write_frame(frame)),
                HasSubstr("member orientation: frame 0 holds 11 values (12 were expected)"));
  }
  EXPECT_TRUE(entries().empty());
}

TEST_F(SceneTest, RecordingsAreScenesOfBounds) {
  auto writer = RecordingWriter::create(path("r.AABBS"), "Level", "Cubes", 1);
  for (const float x : {1.0f, 2.0f}) {
    ASSERT_TRUE(succeeds(writer->write_frame(std::vector<float>{x, x, x, 0, 5, 5, 5, 0})));
  }
  ASSERT_TRUE(succeeds(writer->finish()));
  const auto scene = open_scene(path("r.AABBS"));
  ASSERT_TRUE(succeeds(scene));
  EXPECT_TRUE((*scene)->info().bounds_recording);
  EXPECT_EQ((*scene)->info().name, "Level");
  EXPECT_EQ((*scene)->info().frames, 2u);
  SceneFrame frame;
  for (const float x : {1.0f, 2.0f, 1.0f}) {
    ASSERT_TRUE(succeeds((*scene)->read_frame(frame)));
    EXPECT_EQ(frame.boxes[0], x);
  }
}

TEST_F(SceneTest, FilesAreKnownByExtensionThenContent) {
  write_scene(full_info(), 1);
  std::filesystem::rename(path("s.npz"), path("scene.zip"));
  EXPECT_TRUE(succeeds(open_scene(path("scene.zip"))));
  std::filesystem::rename(path("scene.zip"), path("scene.aabb"));
  EXPECT_THAT(message_of(open_scene(path("scene.aabb"))), HasSubstr("scene.aabb: h"));
  EXPECT_EQ(message_of(open_scene(write_file("notes.txt", "text"))),
            path("notes.txt") +
                ": is of no known kind (a scene .npz, a recording .aabb or .aabbs, or a model "
                ".urdf or .xml was "
                "expected)");
  EXPECT_THAT(message_of(open_scene(path("none"))), HasSubstr("cannot be opened"));
  EXPECT_THAT(message_of(open_scene(path(""))), HasSubstr("is a directory"));
  EXPECT_THAT(message_of(open_scene(write_file("empty.npz", ""))), HasSubstr("is empty"));
}

}  // namespace
}  // namespace carom::io

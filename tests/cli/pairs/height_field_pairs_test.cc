// Height fields of files in the commands: their answers are those of meshes of the same triangles.
#include <algorithm>
#include <cmath>

#include "io/pairs_file.h"
#include "io/scene.h"
#include "tests/cli/pairs/pair_results.h"
#include "tests/support/special_floats.h"

namespace carom::cli {
namespace {

constexpr uint32_t kBall = 0, kBox = 1, kField = 2, kMesh = 3;

constexpr uint32_t kX = 4, kY = 3;  // samples

// A ball, a box, a height field and a mesh of the same triangles. The first height is no sample.
io::SceneShapes shapes_on_a_field() {
  constexpr float kDx = 1, kDy = 0.75f;
  io::SceneShapes shapes;
  shapes.kind = {0, 3, 12, 6};
  shapes.params = {{0.5f}, {0.5f, 0.25f, 0.25f}, {kX, kY, kDx, kDy}, {}};
  shapes.height_range = {{0, 0}, {0, 0}, {1, kX * kY}, {0, 0}};
  shapes.heights = {7, 0, 0.125f, 0.25f, 0, -0.125f, 0.5f, 0.25f, 0.125f, 0, 0, -0.25f, 0.375f};
  shapes.vertex_range = {{0, 0}, {0, 0}, {0, 0}, {0, kX * kY}};
  shapes.triangle_range = {{0, 0}, {0, 0}, {0, 0}, {0, 2 * (kX - 1) * (kY - 1)}};
  for (uint32_t j = 0; j < kY; ++j) {
    for (uint32_t i = 0; i < kX; ++i) {
      const float x = static_cast<float>(i) - 0.5f * (kX - 1);
      const float y = static_cast<float>(j) - 0.5f * (kY - 1);
      const uint32_t sample = j * kX + i;
      shapes.vertices.push_back({x * kDx, y * kDy, shapes.heights[1 + sample]});
      if (i + 1 == kX || j + 1 == kY) continue;
      shapes.triangles.push_back({sample, sample + 1, sample + kX + 1});
      shapes.triangles.push_back({sample, sample + kX + 1, sample + kX});
    }
  }
  return shapes;
}

class HeightFieldPairsTest : public CliTest {
 protected:
  // Balls and boxes all over `ground`.
  static io::PairsFile pairs_on(uint32_t ground) {
    io::PairsFile file;
    file.shapes = shapes_on_a_field();
    for (int k = 0; k < 120; ++k) {
      const auto turn = static_cast<float>(k);
      ++file.pairs;
      file.a.shape.push_back(ground);
      file.b.shape.push_back(k % 2 ? kBox : kBall);
      file.a.position32.push_back({0, 0, 0});
      file.b.position32.push_back(
          {2 * std::sin(turn), std::cos(1.3f * turn), 0.25f + 0.5f * std::sin(2.1f * turn)});
      file.a.orientation.push_back({0, 0, 0, 1});
      file.b.orientation.push_back({0.25f, std::sin(turn), 0.5f, 1});
    }
    return file;
  }

  PairResultsFile found(const io::PairsFile& file, const std::string& detail,
                        const std::string& tier = "standard") {
    EXPECT_TRUE(io::write_pairs(path("in.npz"), file));
    const CommandResult result = run_command(
        {"pairs", path("in.npz"), "-o", path("out.npz"), "--detail", detail, "--tier", tier});
    EXPECT_EQ(result.code, 0) << result.err;
    return read_pair_results(path("out.npz"), file.pairs);
  }
};

TEST_F(HeightFieldPairsTest, AnswersAreThoseOfAMesh) {
  for (const char* detail : {"overlap", "contact", "manifold", "distance"}) {
    const PairResultsFile field = found(pairs_on(kField), detail);
    const PairResultsFile mesh = found(pairs_on(kMesh), detail);
    EXPECT_EQ(field.overlap, mesh.overlap) << detail;
    EXPECT_EQ(field.separation, mesh.separation) << detail;
    EXPECT_EQ(field.normal, mesh.normal) << detail;
    EXPECT_EQ(field.point_a, mesh.point_a) << detail;
    EXPECT_EQ(field.manifold_count, mesh.manifold_count) << detail;
    EXPECT_EQ(field.sub_a, mesh.sub_a) << detail;
    EXPECT_EQ(std::count(field.status.begin(), field.status.end(), 0), 120) << detail;
  }
  const PairResultsFile exact = found(pairs_on(kField), "overlap", "exact");
  const size_t overlaps = std::count(exact.overlap.begin(), exact.overlap.end(), 1);
  EXPECT_GT(overlaps, 30u);
  EXPECT_LT(overlaps, 90u);
  EXPECT_EQ(exact.overlap, found(pairs_on(kMesh), "overlap", "exact").overlap);
}

// A ball over level ground, and over a hole in it.
TEST_F(HeightFieldPairsTest, LevelGroundWithAHole) {
  io::PairsFile file;
  file.shapes.kind = {0, 12};
  file.shapes.params = {{0.5f}, {3, 2, 2, 2}};
  file.shapes.height_range = {{0, 0}, {0, 6}};
  file.shapes.heights = {0.25f, 0.25f, test::kNan, 0.25f, 0.25f, 0.25f};
  file.pairs = 2;
  file.a.shape = {1, 1};
  file.b.shape = {0, 0};
  file.a.position32 = {{0, 0, 0}, {0, 0, 0}};
  file.b.position32 = {{-1, 0.5f, 1}, {3, 0, 0.25f}};
  const PairResultsFile results = found(file, "distance");
  EXPECT_FLOAT_EQ(results.separation[0], 0.25f);
  EXPECT_FLOAT_EQ(results.separation[1], 2.5f);  // from the border of the hole
}

TEST_F(HeightFieldPairsTest, VerifyFindsTheSame) {
  io::SceneInfo info;
  info.shapes = shapes_on_a_field();
  info.has_orientation = true;
  info.bodies = 25;
  io::SceneFrame frame;
  const io::PairsFile pairs = pairs_on(kField);
  for (size_t i = 0; i < info.bodies; ++i) {
    info.body_shape.push_back(i == 0 ? kField : pairs.b.shape[i]);
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
}

TEST_F(HeightFieldPairsTest, RefusedGridsAreNamed) {
  const auto fails = [&](const io::PairsFile& file, const std::string& part) {
    ASSERT_TRUE(io::write_pairs(path("bad.npz"), file));
    expect_error({"pairs", path("bad.npz"), "-o", path("out.npz")},
                 {"bad.npz: shape_kind: shape 2 is not valid: the height field has " + part});
    const CommandResult checked = run_command({"check", path("bad.npz")});
    EXPECT_EQ(checked.code, 0);
    EXPECT_NE(checked.out.find("no: it is not valid: the height field has " + part),
              std::string::npos)
        << checked.out;
  };
  for (const float bad : {0.0f, -1.0f, test::kNan, INFINITY}) {
    io::PairsFile file = pairs_on(kField);
    file.shapes.params[kField][3] = bad;
    fails(file, "a spacing that is not positive");
  }
  io::PairsFile file = pairs_on(kField);
  file.shapes.heights[1 + kX + 2] = -INFINITY;
  fails(file, "a sample (2, 1) that is infinite or too great");
}

}  // namespace
}  // namespace carom::cli

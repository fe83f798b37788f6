// carom pairs: its results against the reference, and its files.
#include <cmath>
#include <limits>

#include "carom/reference/reference.h"
#include "carom/simd/isa.h"
#include "cli/scenes/shapes.h"
#include "io/generate/random.h"
#include "io/pairs_file.h"
#include "tests/cli/pairs/pair_results.h"
#include "tests/support/special_floats.h"

namespace carom::cli {
namespace {

using test::kNan;

constexpr size_t kPairs = 701;

// One shape of every kind, and a second sphere and box. The half-space comes last.
io::SceneShapes all_kinds() {
  io::SceneShapes shapes;
  shapes.kind = {0, 2, 1, 3, 6, 0, 3, 8};
  shapes.params = {{1},
                   {1, 0.5f, 0.7f},
                   {-0.5f, 0, 0, 1, 0.5f, 0, 0.4f},
                   {0.5f, 2, 0.25f},
                   {0, 0},
                   {0.25f},
                   {1, 1, 1},
                   {0, 3, -4, 1}};
  shapes.vertex_range.assign(8, {1, 4});
  shapes.vertices = {{9, 9, 9}, {9, 9, 9}, {1, 0, -1}, {-1, 0.5f, 0}, {1, 0, 1.5f}};
  shapes.triangle_range.assign(8, {1, 1});
  shapes.triangles = {{0, 0, 0}, {1, 3, 2}};
  return shapes;
}

std::array<float, 3> rounded(const std::array<double, 3>& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

// All kinds against each other; half-spaces only as B.
io::PairsFile random_pairs(bool float64_positions) {
  io::Random random(3, 3);
  io::PairsFile file;
  file.pairs = kPairs;
  file.float64_positions = float64_positions;
  file.shapes = all_kinds();
  const double far = float64_positions ? 1e8 : 10;
  for (size_t i = 0; i < kPairs; ++i) {
    const io::Vec3 a = random.in_ball(far);
    const io::Vec3 d = random.in_ball(2.2);
    const std::array<double, 3> b = {a[0] + d[0], a[1] + d[1], a[2] + d[2]};
    file.a.shape.push_back(static_cast<uint32_t>(random.below(7)));
    file.b.shape.push_back(static_cast<uint32_t>(random.below(8)));
    for (io::PairSide* side : {&file.a, &file.b}) {
      std::array<float, 4>& q = side->orientation.emplace_back();
      for (float& number : q) number = static_cast<float>(random.between(-3, 3));
    }
    if (float64_positions) {
      file.a.position64.push_back(a);
      file.b.position64.push_back(b);
    } else {
      file.a.position32.push_back(rounded(a));
      file.b.position32.push_back(rounded(b));
    }
  }
  return file;
}

class PairsTest : public CliTest {
 protected:
  nlohmann::json test(const io::PairsFile& file, std::vector<std::string> options) {
    const auto written = io::write_pairs(path("in.npz"), file);
    EXPECT_TRUE(written) << written.error().message;
    std::vector<std::string> arguments = {"pairs",         path("in.npz"), "-o",
                                          path("out.npz"), "--json",       "-"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const CommandResult result = run_command(arguments);
    EXPECT_EQ(result.code, 0) << result.err;
    return result.json();
  }
};

Pose pose_of(const io::PairSide& side, size_t i) {
  Pose pose;
  pose.orientation = Eigen::Quaternionf(side.orientation[i].data());
  pose.position = side.position64.empty()
                      ? Eigen::Vector3f(side.position32[i].data()).cast<double>()
                      : Eigen::Vector3d(side.position64[i].data());
  return pose;
}

std::vector<reference::PairResult> reference_results(const io::PairsFile& file) {
  const auto shapes = convert_shapes(file.shapes, "");
  EXPECT_TRUE(shapes);
  std::vector<reference::PairResult> results;
  for (size_t i = 0; i < file.pairs; ++i) {
    results.push_back(
        reference::collide((*shapes)[file.a.shape[i]], pose_of(file.a, i),
                           (*shapes)[file.b.shape[i]], pose_of(file.b, i),
                           file.float64_positions ? PositionType::float64 : PositionType::float32));
  }
  return results;
}

// A point in the file is position + arm, rounded.
void expect_at(const float* point, const Eigen::Vector3d& position, const float* arm) {
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(point[axis], position[axis] + arm[axis], 1e-7 * std::fabs(position[axis]) + 1e-6);
  }
}

TEST_F(PairsTest, ResultsAreThoseOfTheReference) {
  for (const bool float64 : {false, true}) {
    const io::PairsFile file = random_pairs(float64);
    const auto json = test(file, {"--repeat", "3", "--threads", "2"});
    EXPECT_EQ(json["pairs"], kPairs);
    EXPECT_GT(json["ns_per_pair"], 0);
    EXPECT_EQ(json["isa"], name(active_isa()));
    EXPECT_EQ(json["tier"], "standard");
    EXPECT_EQ(json["undecided"], 0);
    EXPECT_EQ(json["detail"], "contact");
    const PairResultsFile results = read_pair_results(path("out.npz"), kPairs);
    const std::vector<reference::PairResult> expected = reference_results(file);
    size_t overlaps = 0;
    for (size_t i = 0; i < kPairs; ++i) {
      overlaps += expected[i].overlap;
      EXPECT_EQ(results.overlap[i], expected[i].overlap ? 1 : 0);
      EXPECT_EQ(results.separation[i], expected[i].separation);
      EXPECT_EQ(results.status[i], static_cast<uint8_t>(expected[i].status));
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(results.normal[i][axis], expected[i].normal[axis]);
      }
      expect_at(results.point_a[i].data(), pose_of(file.a, i).position, expected[i].arm_a.data());
      expect_at(results.point_b[i].data(), pose_of(file.b, i).position, expected[i].arm_b.data());
    }
    EXPECT_EQ(json["overlaps"], overlaps);
    EXPECT_GT(overlaps, kPairs * 3 / 10);
    EXPECT_LT(overlaps, kPairs * 7 / 10);
  }
}

TEST_F(PairsTest, RegionsAreThoseOfTheReference) {
  constexpr float kDistance = 0.25f;
  const io::PairsFile file = random_pairs(true);
  const nlohmann::json json = test(file, {"--detail", "regions", "--contact-distance", "0.25"});
  EXPECT_EQ(json["detail"], "regions");
  EXPECT_EQ(json["contact_distance"], 0.25);
  const auto results = io::NpzReader::open(path("out.npz"));
  ASSERT_TRUE(results);
  const auto first = *results->read<uint64_t>("region_first", {kPairs + 1});
  const uint64_t count = first.back();
  const auto separation = *results->read<float>("region_separation", {count});
  const auto part = *results->read<std::array<uint32_t, 2>>("region_part", {count});
  const auto points = *results->read<uint8_t>("region_point_count", {count});
  const auto point = *results->read<float>("region_point", {count, 4, 3});
  const auto converted = convert_shapes(file.shapes, "");
  ASSERT_TRUE(converted);
  const auto& shapes = *converted;
  size_t near = 0;
  for (size_t i = 0, region = 0; i < kPairs; ++i) {
    const reference::PairResult expected =
        reference::collide(shapes[file.a.shape[i]], pose_of(file.a, i), shapes[file.b.shape[i]],
                           pose_of(file.b, i), PositionType::float64, kDistance);
    const bool touches = expected.overlap || expected.separation <= kDistance;
    ASSERT_EQ(first[i + 1] - first[i], touches ? 1u : 0u) << i;
    if (!touches) continue;
    near += !expected.overlap;
    EXPECT_EQ(separation[region], expected.separation);
    EXPECT_EQ(part[region], (std::array<uint32_t, 2>{0xffffffffu, 0xffffffffu}));
    ASSERT_EQ(points[region], expected.manifold_count);
    for (size_t k = 0; k < 4; ++k) {
      const float* const at = &point[12 * region + 3 * k];
      if (k < points[region]) {
        expect_at(at, pose_of(file.a, i).position, expected.manifold.point[k].data());
      } else {
        EXPECT_TRUE(std::isnan(at[0]));
      }
    }
    ++region;
  }
  EXPECT_GT(near, 20u);
}

TEST_F(PairsTest, ManifoldsAreThoseOfTheReference) {
  for (const bool float64 : {false, true}) {
    const io::PairsFile file = random_pairs(float64);
    EXPECT_EQ(test(file, {"--detail", "manifold"})["detail"], "manifold");
    const PairResultsFile results = read_pair_results(path("out.npz"), kPairs);
    const std::vector<reference::PairResult> expected = reference_results(file);
    ASSERT_EQ(results.manifold_point.size(), 12 * kPairs);
    std::array<size_t, 5> of_count{};
    for (size_t i = 0; i < kPairs; ++i) {
      const size_t count = results.manifold_count[i];
      ASSERT_EQ(count, expected[i].manifold_count) << i;
      EXPECT_EQ(results.overlap[i], count > 0) << i;
      ++of_count[count];
      for (size_t k = 0; k < 4; ++k) {
        const float* point = &results.manifold_point[12 * i + 3 * k];
        if (k < count) {
          EXPECT_EQ(results.manifold_separation[i][k], expected[i].manifold.separation[k]);
          expect_at(point, pose_of(file.a, i).position, expected[i].manifold.point[k].data());
        } else {
          EXPECT_TRUE(std::isnan(results.manifold_separation[i][k]));
          EXPECT_TRUE(std::isnan(point[0]) && std::isnan(point[1]) && std::isnan(point[2]));
        }
      }
    }
    EXPECT_GT(of_count[1], 0u);
    EXPECT_GT(of_count[4], 0u);
  }
}

TEST_F(PairsTest, DetailsAgree) {
  const io::PairsFile file = random_pairs(false);
  test(file, {});
  const PairResultsFile contact = read_pair_results(path("out.npz"), kPairs);
  EXPECT_TRUE(contact.manifold_count.empty() && contact.manifold_point.empty());
  EXPECT_EQ(test(file, {"--detail", "overlap"})["detail"], "overlap");
  const PairResultsFile overlap = read_pair_results(path("out.npz"), kPairs);
  EXPECT_EQ(overlap.overlap, contact.overlap);
  EXPECT_EQ(overlap.status, contact.status);
  EXPECT_TRUE(overlap.separation.empty());
  for (const char* detail : {"distance", "manifold"}) {
    EXPECT_EQ(test(file, {"--detail", detail})["detail"], detail);
    const PairResultsFile other = read_pair_results(path("out.npz"), kPairs);
    EXPECT_EQ(other.overlap, contact.overlap);
    EXPECT_EQ(other.separation, contact.separation);
    EXPECT_EQ(other.normal, contact.normal);
    EXPECT_EQ(other.point_a, contact.point_a);
    EXPECT_EQ(other.point_b, contact.point_b);
  }
}

TEST_F(PairsTest, Tiers) {
  const io::PairsFile file = random_pairs(false);
  const auto standard = test(file, {});
  const auto fast = test(file, {"--tier", "fast"});
  EXPECT_EQ(fast["tier"], "fast");
  EXPECT_NEAR(fast["overlaps"].get<double>(), standard["overlaps"].get<double>(), 2);

  for (const char* tier : {"certified", "exact"}) {
    const auto json = test(file, {"--tier", tier, "--detail", "manifold"});
    EXPECT_EQ(json["tier"], tier);
    const PairResultsFile results = read_pair_results(path("out.npz"), kPairs);
    std::array<uint64_t, 3> of{};
    for (const uint8_t overlap : results.overlap) ++of.at(overlap);
    EXPECT_EQ(json["overlaps"], of[1]);
    EXPECT_EQ(json["undecided"], of[2]);
  }
}

// A cube turned by 45 degrees reaches further than an unturned one.
TEST_F(PairsTest, OrientationsAreRead) {
  io::PairsFile file;
  file.pairs = 2;
  file.shapes.kind = {0, 3};
  file.shapes.params = {{0.25f}, {1, 1, 1}};
  file.a.shape = {0, 0};
  file.a.position32 = {{1.5f, 0, 0}, {1.5f, 0, 0}};
  file.b.shape = {1, 1};
  file.b.position32 = {{0, 0, 0}, {0, 0, 0}};
  EXPECT_EQ(test(file, {})["overlaps"], 0);
  file.b.orientation = {{0, 0, 0, 2}, {0, 0, 0.41421356f, 1}};
  test(file, {});
  const PairResultsFile results = read_pair_results(path("out.npz"), 2);
  EXPECT_EQ(results.overlap, (std::vector<uint8_t>{0, 1}));
  EXPECT_NEAR(results.separation[0], 0.25, 1e-6);
}

TEST_F(PairsTest, InvalidPairsAreMarkedAlone) {
  io::PairsFile file = random_pairs(false);
  test(file, {"--detail", "manifold"});
  const PairResultsFile valid = read_pair_results(path("out.npz"), kPairs);
  for (size_t i = 0; i < 3 * 8; i += 3) {  // each kind with each bad orientation
    file.b.shape[i] = file.b.shape[i + 1] = file.b.shape[i + 2] = static_cast<uint32_t>(i / 3);
    file.b.orientation[i] = {0, 0, 0, 0};
    file.b.orientation[i + 1] = {0, kNan, 0, 1};
    file.b.orientation[i + 2] = {0, 0, 0, std::numeric_limits<float>::infinity()};
  }
  file.a.position32[24][1] = kNan;
  file.b.position32[25][2] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(test(file, {"--detail", "manifold"})["invalid"], 26);
  const PairResultsFile results = read_pair_results(path("out.npz"), kPairs);
  for (size_t i = 0; i < kPairs; ++i) {
    if (i < 26) {
      EXPECT_EQ(results.status[i], 3) << i;
      EXPECT_EQ(results.overlap[i], 0) << i;
      EXPECT_EQ(results.manifold_count[i], 0) << i;
      EXPECT_TRUE(std::isnan(results.separation[i]) && std::isnan(results.point_a[i][0])) << i;
      EXPECT_TRUE(std::isnan(results.manifold_separation[i][0])) << i;
    } else {
      EXPECT_EQ(results.status[i], valid.status[i]) << i;
      EXPECT_EQ(results.separation[i], valid.separation[i]) << i;
    }
  }
}

// The orientations of spheres and aabbs do not matter, those of other kinds do.
TEST_F(PairsTest, SpheresAndAabbsDoNotTurn) {
  io::PairsFile file = random_pairs(false);
  for (size_t i = 0; i < kPairs; ++i) {
    file.a.shape[i] = i % 2;
    file.b.shape[i] = i / 2 % 2;
  }
  test(file, {});
  const PairResultsFile turned = read_pair_results(path("out.npz"), kPairs);
  file.a.orientation.clear();
  file.b.orientation.clear();
  test(file, {});
  EXPECT_EQ(read_pair_results(path("out.npz"), kPairs).point_a, turned.point_a);
}

TEST_F(PairsTest, NoPairsAtAll) {
  io::PairsFile file;
  file.shapes.kind = {0};
  file.shapes.params = {{1}};
  EXPECT_EQ(test(file, {})["pairs"], 0);
  EXPECT_TRUE(read_pair_results(path("out.npz"), 0).overlap.empty());
}

}  // namespace
}  // namespace carom::cli

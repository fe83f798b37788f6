// carom pairs: results against the reference, and its files.
#include <cmath>
#include <limits>

#include "carom/reference/reference.h"
#include "carom/simd/isa.h"
#include "io/generate/random.h"
#include "io/npz.h"
#include "io/pairs_file.h"
#include "tests/cli/cli_test_util.h"

namespace carom::cli {
namespace {

constexpr size_t kPairs = 501;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// Spheres and boxes against each other.
io::PairsFile random_pairs(bool float64_positions) {
  io::Random random(3, 3);
  io::PairsFile file;
  file.pairs = kPairs;
  file.float64_positions = float64_positions;
  file.shapes.kind = {0, 2, 0, 2};
  file.shapes.params = {{1}, {1, 0.5f, 0.7f}, {0.25f}, {0.5f, 2, 0.25f}};
  const double far = float64_positions ? 1e8 : 10;
  for (size_t i = 0; i < kPairs; ++i) {
    const io::Vec3 a = random.in_ball(far);
    const io::Vec3 d = random.in_ball(2.2);
    const std::array<double, 3> b = {a[0] + d[0], a[1] + d[1], a[2] + d[2]};
    file.a.shape.push_back(static_cast<uint32_t>(random.below(4)));
    file.b.shape.push_back(static_cast<uint32_t>(random.below(4)));
    const auto rounded = [](const std::array<double, 3>& v) {
      return std::array{static_cast<float>(v[0]), static_cast<float>(v[1]),
                        static_cast<float>(v[2])};
    };
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

struct Results {
  std::vector<uint8_t> overlap, status;
  std::vector<float> separation;
  std::vector<std::array<float, 3>> normal, point_a, point_b;
};

Results read_results(const std::string& path, size_t pairs) {
  auto reader = io::NpzReader::open(path);
  EXPECT_TRUE(reader) << reader.error().message;
  Results results;
  const auto read = [&](const char* name, auto& out) {
    using T = typename std::decay_t<decltype(out)>::value_type;
    auto values = reader->read<T>(name, {pairs});
    EXPECT_TRUE(values) << values.error().message;
    out = *values;
  };
  read("overlap", results.overlap);
  read("status", results.status);
  if (!reader->has("separation")) return results;
  read("separation", results.separation);
  read("normal", results.normal);
  read("point_a", results.point_a);
  read("point_b", results.point_b);
  return results;
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

Shape shape_of(const io::PairsFile& file, uint32_t index) {
  const auto& p = file.shapes.params[index];
  if (file.shapes.kind[index] == 0) return Sphere{p[0]};
  return Aabb::from_half_extents({p[0], p[1], p[2]});
}

Eigen::Vector3d position_of(const io::PairSide& side, size_t i) {
  if (!side.position64.empty()) return Eigen::Vector3d(side.position64[i].data());
  return Eigen::Vector3f(side.position32[i].data()).cast<double>();
}

TEST_F(PairsTest, ResultsAreThoseOfTheReference) {
  for (const bool float64 : {false, true}) {
    const io::PairsFile file = random_pairs(float64);
    const auto json = test(file, {"--repeat", "3", "--threads", "2"});
    EXPECT_EQ(json["pairs"], kPairs);
    EXPECT_GT(json["ns_per_pair"], 0);
    EXPECT_EQ(json["isa"], name(active_isa()));
    EXPECT_EQ(json["tier"], "standard");
    EXPECT_EQ(json["detail"], "contact");
    const Results results = read_results(path("out.npz"), kPairs);
    size_t overlaps = 0;
    for (size_t i = 0; i < kPairs; ++i) {
      const Eigen::Vector3d a = position_of(file.a, i);
      const Eigen::Vector3d b = position_of(file.b, i);
      const reference::PairResult expected =
          reference::collide(shape_of(file, file.a.shape[i]), a, shape_of(file, file.b.shape[i]), b,
                             float64 ? PositionType::float64 : PositionType::float32);
      overlaps += expected.overlap;
      EXPECT_EQ(results.overlap[i], expected.overlap ? 1 : 0);
      EXPECT_EQ(results.separation[i], expected.separation);
      EXPECT_EQ(results.status[i], static_cast<uint8_t>(expected.status));
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(results.normal[i][axis], expected.normal[axis]);
        EXPECT_NEAR(results.point_a[i][axis], a[axis] + expected.arm_a[axis],
                    1e-7 * std::fabs(a[axis]) + 1e-6);
        EXPECT_NEAR(results.point_b[i][axis], b[axis] + expected.arm_b[axis],
                    1e-7 * std::fabs(b[axis]) + 1e-6);
      }
    }
    EXPECT_EQ(json["overlaps"], overlaps);
    EXPECT_GT(overlaps, kPairs * 3 / 10);
    EXPECT_LT(overlaps, kPairs * 7 / 10);
  }
}

TEST_F(PairsTest, DetailsAgree) {
  const io::PairsFile file = random_pairs(false);
  test(file, {});
  const Results contact = read_results(path("out.npz"), kPairs);
  EXPECT_EQ(test(file, {"--detail", "overlap"})["detail"], "overlap");
  const Results overlap = read_results(path("out.npz"), kPairs);
  EXPECT_EQ(overlap.overlap, contact.overlap);
  EXPECT_EQ(overlap.status, contact.status);
  EXPECT_TRUE(overlap.separation.empty());
  EXPECT_EQ(test(file, {"--detail", "distance"})["detail"], "distance");
  const Results distance = read_results(path("out.npz"), kPairs);
  EXPECT_EQ(distance.separation, contact.separation);
  EXPECT_EQ(distance.normal, contact.normal);
}

TEST_F(PairsTest, InvalidPairsAreMarkedAlone) {
  io::PairsFile file = random_pairs(false);
  test(file, {});
  const Results valid = read_results(path("out.npz"), kPairs);
  file.a.orientation.assign(kPairs, {0, 0, 0, 1});
  file.b.orientation.assign(kPairs, {0.5f, 0.5f, 0, 3});
  file.a.orientation[3] = {0, 0, 0, 0};
  file.b.orientation[4] = {0, kNan, 0, 1};
  file.a.orientation[5] = {0, 0, 0, std::numeric_limits<float>::infinity()};
  file.a.position32[6][1] = kNan;
  file.b.position32[7][2] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(test(file, {})["invalid"], 5);
  const Results results = read_results(path("out.npz"), kPairs);
  for (size_t i = 0; i < kPairs; ++i) {
    if (i >= 3 && i <= 7) {
      EXPECT_EQ(results.status[i], 3) << i;
      EXPECT_EQ(results.overlap[i], 0) << i;
      EXPECT_TRUE(std::isnan(results.separation[i]) && std::isnan(results.point_a[i][0])) << i;
    } else {
      EXPECT_EQ(results.status[i], valid.status[i]) << i;
      EXPECT_EQ(results.separation[i], valid.separation[i]) << i;
    }
  }
}

TEST_F(PairsTest, NoPairsAtAll) {
  io::PairsFile file;
  file.shapes.kind = {0};
  file.shapes.params = {{1}};
  EXPECT_EQ(test(file, {})["pairs"], 0);
  EXPECT_TRUE(read_results(path("out.npz"), 0).overlap.empty());
}

// Samples with exact answers: decisions wherever they are certain, separations within 2e-6 L.
TEST_F(PairsTest, SharedSphereSphere) {
  const std::string shared = shared_folder();
  if (shared.empty()) return;
  const CommandResult run =
      run_command({"pairs", shared + "/pairs/sphere_sphere.npz", "-o", path("out.npz")});
  ASSERT_EQ(run.code, 0) << run.err;
  auto reference = io::NpzReader::open(shared + "/reference/sphere_sphere.npz");
  ASSERT_TRUE(reference);
  const auto overlap = reference->read<uint8_t>("overlap", {io::kAny});
  const auto separation = reference->read<double>("separation", {io::kAny});
  const auto scale = reference->read<double>("scale", {io::kAny});
  ASSERT_TRUE(overlap && separation && scale);
  const Results results = read_results(path("out.npz"), overlap->size());
  constexpr double kEps = 0x1p-23;
  for (size_t i = 0; i < overlap->size(); ++i) {
    const double gap = (*separation)[i];
    if (std::fabs(gap) > 4 * kEps * ((*scale)[i] + std::fabs(gap))) {
      EXPECT_EQ(results.overlap[i], (*overlap)[i]) << i;
    }
    EXPECT_NEAR(results.separation[i], gap, 2e-6 * (*scale)[i]) << i;
  }
}

}  // namespace
}  // namespace carom::cli

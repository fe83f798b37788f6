// carom pairs --detail toi: known times of impact, and its files.
#include <cmath>
#include <fstream>
#include <iterator>

#include "carom/simd/isa.h"
#include "io/pairs_file.h"
#include "tests/cli/pairs/toi_checks.h"
#include "tests/support/special_floats.h"

namespace carom::cli {
namespace {

using test::kInfinity;
using test::kNan;

using Row3 = std::array<float, 3>;

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class ToiTest : public CliTest {
 protected:
  CommandResult run(const std::string& pairs, const std::vector<std::string>& options = {}) {
    std::vector<std::string> arguments = {"pairs",    pairs, "-o",     path("out.npz"),
                                          "--detail", "toi", "--json", "-"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_command(arguments);
  }

  PairResultsFile find(const io::PairsFile& file, const std::vector<std::string>& options = {}) {
    const auto written = io::write_pairs(path("in.npz"), file);
    EXPECT_TRUE(written) << written.error().message;
    const CommandResult result = run(path("in.npz"), options);
    EXPECT_EQ(result.code, 0) << result.err;
    json_ = result.json();
    return read_pair_results(path("out.npz"), file.pairs);
  }

  // Compares the times of a file with the known ones on every instruction set, and all results bit
  // for bit.
  void check(const std::string& pairs, const std::string& answers_path) {
    const ImpactAnswers answers = read_impact_answers(answers_path);
    std::string expected;
    for (const Isa isa : usable_isas()) {
      for (const char* threads : {"1", "2"}) {
        const CommandResult result = run(pairs, {"--isa", name(isa), "--threads", threads});
        ASSERT_EQ(result.code, 0) << result.err;
        const std::string bytes = bytes_of(path("out.npz"));
        if (expected.empty()) {
          expected = bytes;
          const auto results = read_pair_results(path("out.npz"), answers.state.size());
          expect_times(results.toi, answers);
          expect_contacts_of_impacts(results, answers);
        }
        EXPECT_EQ(bytes == expected, true) << name(isa) << ' ' << threads;
      }
    }
  }

  nlohmann::json json_;
};

TEST_F(ToiTest, Sample) {
  check(test_data("toi_sample.npz"), test_data("toi_sample.reference.npz"));
}

TEST_F(ToiTest, SampleIsVerified) {
  const CommandResult result =
      run_command({"verify", test_data("toi_sample.npz"), "--threads", "2"});
  EXPECT_EQ(result.code, 0) << result.out << result.err;
  EXPECT_NE(result.out.find("times of impact"), std::string::npos) << result.out;
}

TEST_F(ToiTest, Shared) {
  const std::string shared = shared_folder();
  if (shared.empty()) return;
  const std::string ending = ".reference.npz";
  size_t sets = 0;
  for (const auto& entry : std::filesystem::directory_iterator(shared + "/toi")) {
    std::string answers = entry.path().string();
    if (!answers.ends_with(ending)) continue;
    ++sets;
    const std::string stem = answers.substr(0, answers.size() - ending.size());
    SCOPED_TRACE(stem);
    check(stem + ".npz", answers);
  }
  EXPECT_GT(sets, 0u);
}

TEST_F(ToiTest, SharedAreVerified) {
  const std::string shared = shared_folder();
  if (shared.empty()) return;
  for (const std::string set : {"sphere_capsule", "hull16_hull16_rot", "grazing"}) {
    const CommandResult result =
        run_command({"verify", shared + "/toi/" + set + ".npz", "--threads", "1"});
    EXPECT_EQ(result.code, 0) << result.out << result.err;
  }
}

// The checks of this file find every kind of fault.
TEST(ToiChecks, FindWhatIsWrong) {
  ImpactAnswers answers;
  answers.toi_lo = {0.5, kInfinity, kInfinity, 0, 0.5};
  answers.toi_hi = {0.5, kInfinity, kInfinity, 0, 0.5};
  answers.size.assign(5, 1);
  answers.travel.assign(5, 1);
  answers.least = {-0.1, 0.1, 1e-6, -0.1, -1e-7};
  answers.state = {kImpact, kNoImpact, kNoImpact, kOverlapAtStart, kImpact};
  answers.grazing = {0, 0, 1, 0, 1};
  const auto fault = [&](size_t i, float toi) { return fault_of(toi, answers, i); };
  EXPECT_EQ(fault(0, 0.5f), "");
  EXPECT_EQ(fault(0, std::nextafter(0.5f, 1.0f)), "");
  EXPECT_EQ(fault(0, 0.500001f), "is late");
  EXPECT_EQ(fault(0, 0.49999f), "");
  EXPECT_EQ(fault(0, 0.4999f), "is early");
  EXPECT_EQ(fault(0, kInfinity), "misses the impact");
  for (const float toi : {kNan, -0.5f, 1.5f, -kInfinity}) {
    EXPECT_EQ(fault(0, toi), "is no time of impact") << toi;
  }
  EXPECT_EQ(fault(1, kInfinity), "");
  EXPECT_EQ(fault(1, 0.5f), "is of a pair that stays apart");
  EXPECT_EQ(fault(2, 0.5f), "");
  EXPECT_EQ(fault(3, 0), "");
  EXPECT_EQ(fault(3, 1e-9f), "is not at the start");
  EXPECT_EQ(fault(4, kInfinity), "");  // too shallow to be required
  EXPECT_EQ(fault(4, 0.6f), "is late");
}

TEST(ToiChecks, AcceptTheKnownTimes) {
  const ImpactAnswers answers = read_impact_answers(test_data("toi_sample.reference.npz"));
  std::vector<float> toi;
  for (const double known : answers.toi_lo) {
    toi.push_back(std::nextafter(static_cast<float>(known), 0.0f));
    if (std::isinf(known)) toi.back() = kInfinity;
  }
  expect_times(toi, answers);
}

// Times may not be late, and early only by rounding.
void expect_about(const std::vector<float>& toi, const std::vector<float>& exact) {
  ASSERT_EQ(toi.size(), exact.size());
  for (size_t i = 0; i < toi.size(); ++i) {
    EXPECT_LE(toi[i], exact[i]) << i;
    EXPECT_GE(toi[i], std::isfinite(exact[i]) ? exact[i] - 1e-6f : exact[i]) << i;
  }
}

// Pairs of balls of radius 1 with centres four apart: some meet, miss, touch at the start, or
// overlap at the start.
io::PairsFile balls() {
  io::PairsFile file;
  file.pairs = 4;
  file.shapes.kind = {0};
  file.shapes.params = {{1}};
  file.a.shape = file.b.shape = {0, 0, 0, 0};
  file.a.position32.assign(4, {0, 0, 0});
  file.b.position32 = {{4, 0, 0}, {4, 0, 0}, {2, 0, 0}, {0, 1, 0}};
  file.a.displacement = {{4, 0, 0}, {0, 4, 0}, {1, 0, 0}, {0, -9, 0}};
  file.b.displacement.assign(4, {0, 0, 0});
  return file;
}

TEST_F(ToiTest, TimesAndContactsOfBalls) {
  const PairResultsFile results = find(balls());
  expect_about(results.toi, {0.5f, kInfinity, 0, 0});
  EXPECT_EQ(results.overlap, (std::vector<uint8_t>{1, 0, 1, 1}));
  EXPECT_EQ(results.status, (std::vector<uint8_t>{0, 0, 0, 0}));
  EXPECT_EQ(results.normal[0], (Row3{1, 0, 0}));
  EXPECT_NEAR(results.separation[0], 0, 1e-5);
  // World coordinates at the time of impact.
  EXPECT_NEAR(results.point_a[0][0], 3, 1e-5);
  EXPECT_NEAR(results.point_b[0][0], 3, 1e-5);
  EXPECT_TRUE(std::isnan(results.separation[1]) && std::isnan(results.normal[1][1]) &&
              std::isnan(results.point_a[1][0]) && std::isnan(results.point_b[1][2]));
  EXPECT_EQ(results.separation[3], -1);
  EXPECT_EQ(results.normal[3], (Row3{0, 1, 0}));
  EXPECT_TRUE(results.manifold_count.empty() && results.sub_a.empty());
}

TEST_F(ToiTest, Report) {
  io::PairsFile file = balls();
  file.b.displacement[1][2] = kNan;
  find(file, {"--repeat", "3", "--tier", "fast", "--isa", "scalar"});
  EXPECT_EQ(json_["pairs"], 4);
  EXPECT_GT(json_["ns_per_pair"], 0);
  EXPECT_EQ(json_["isa"], "scalar");
  EXPECT_EQ(json_["tier"], "fast");
  EXPECT_EQ(json_["detail"], "toi");
  EXPECT_EQ(json_["repeat"], 3);
  EXPECT_EQ(json_["overlaps"], 3);
  EXPECT_EQ(json_["impacts"], 3);
  EXPECT_EQ(json_["at_start"], 2);
  EXPECT_EQ(json_["budget"], 0);
  EXPECT_EQ(json_["invalid"], 1);
  const CommandResult table =
      run_command({"pairs", path("in.npz"), "-o", path("out.npz"), "--detail", "toi"});
  EXPECT_NE(table.out.find("impacts"), std::string::npos) << table.out;
  EXPECT_EQ(table.out.find("overlapping"), std::string::npos) << table.out;
}

TEST_F(ToiTest, OtherDetailsHaveNoTimes) {
  ASSERT_TRUE(io::write_pairs(path("in.npz"), balls()));
  const CommandResult result =
      run_command({"pairs", path("in.npz"), "-o", path("out.npz"), "--json", "-"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_FALSE(result.json().contains("impacts"));
  EXPECT_TRUE(read_pair_results(path("out.npz"), 4).toi.empty());
}

// An absent array means no motion of that kind.
TEST_F(ToiTest, AbsentMotionsAreZero) {
  io::PairsFile file = balls();
  const std::vector<float> toi = find(file).toi;
  file.b.displacement.clear();
  EXPECT_EQ(find(file).toi, toi);
  file.a.rotation.assign(4, {0, 0, 0});
  EXPECT_EQ(find(file).toi, toi);
  file.b.displacement = file.a.displacement;
  for (Row3& d : file.b.displacement) d = {-d[0], -d[1], -d[2]};
  file.a.displacement.clear();
  EXPECT_EQ(find(file).toi, toi);
}

// A rod makes a quarter turn and its end hits a ball; without the rotation it would pass.
TEST_F(ToiTest, RotationsAreRead) {
  io::PairsFile file;
  file.pairs = 2;
  file.shapes.kind = {0, 1};
  file.shapes.params = {{0.5f}, {-2, 0, 0, 2, 0, 0, 0.5f}};
  file.a.shape = {1, 1};
  file.b.shape = {0, 0};
  file.a.position32.assign(2, {0, 0, 0});
  file.b.position32.assign(2, {0, 2, 0});
  file.a.displacement.assign(2, {0, 0, 0});
  file.a.rotation = {{0, 0, 0}, {0, 0, 1.5707964f}};
  const PairResultsFile results = find(file);
  // After 60 degrees: the ball is 1 from the axis.
  expect_about(results.toi, {kInfinity, 2.0f / 3});
}

TEST_F(ToiTest, Float64PositionsFarAway) {
  io::PairsFile file = balls();
  file.float64_positions = true;
  for (io::PairSide* side : {&file.a, &file.b}) {
    for (const Row3& p : side->position32) side->position64.push_back({p[0] + 1e9, p[1], p[2]});
  }
  expect_about(find(file).toi, {0.5f, kInfinity, 0, 0});
}

TEST_F(ToiTest, InvalidMotionsAreMarkedAlone) {
  io::PairsFile file = balls();
  file.a.rotation.assign(4, {0, 0, 0});
  file.b.rotation.assign(4, {0, 0, 0});
  const PairResultsFile valid = find(file);
  for (auto* rows : {&file.a.displacement, &file.b.displacement, &file.a.rotation, &file.b.rotation,
                     &file.a.position32}) {
    for (const float bad : {kNan, kInfinity, -kInfinity}) {
      const float before = std::exchange((*rows)[0][1], bad);
      const PairResultsFile results = find(file);
      EXPECT_EQ(results.status, (std::vector<uint8_t>{3, 0, 0, 0}));
      EXPECT_TRUE(std::isnan(results.toi[0]) && std::isnan(results.separation[0]));
      EXPECT_EQ(results.overlap, (std::vector<uint8_t>{0, 0, 1, 1}));
      for (size_t i = 1; i < 4; ++i) {
        EXPECT_EQ(results.toi[i], valid.toi[i]) << i;
      }
      EXPECT_EQ(json_["invalid"], 1);
      (*rows)[0][1] = before;
    }
  }
}

TEST_F(ToiTest, SubShapesOfComposites) {
  io::PairsFile file = balls();
  file.shapes.kind = {0, 7};
  file.shapes.params = {{1}, {}};
  file.shapes.child_range = {{0, 0}, {0, 2}};
  file.shapes.child_shape = {0, 0};
  file.shapes.child_position = {{0, 0, 5}, {0, 0, 0}};
  file.shapes.child_orientation.assign(2, {0, 0, 0, 1});
  file.shapes.vertex_range.assign(2, {0, 0});
  file.shapes.triangle_range.assign(2, {0, 0});
  file.b.shape = {1, 1, 1, 1};
  const PairResultsFile results = find(file);
  expect_about(results.toi, {0.5f, kInfinity, 0, 0});
  EXPECT_EQ(results.sub_a, (std::vector<uint32_t>{0, 0, 0, 0}));
  EXPECT_EQ(results.sub_b, (std::vector<uint32_t>{1, 0, 1, 1}));
}

TEST_F(ToiTest, NoPairsAtAll) {
  io::PairsFile file;
  file.shapes.kind = {0};
  file.shapes.params = {{1}};
  EXPECT_TRUE(find(file).toi.empty());
  EXPECT_EQ(json_["impacts"], 0);
}

}  // namespace
}  // namespace carom::cli

// carom pairs on samples with exact answers: decisions, separations and manifolds.
#include <algorithm>
#include <cmath>

#include "tests/cli/pairs/pair_results.h"

namespace carom::cli {
namespace {

struct ExactAnswers {
  std::vector<uint8_t> overlap;
  std::vector<double> separation;
  std::vector<double> scale;        // L: the mean of the bounding radii
  std::vector<double> uncertainty;  // of the exact answers themselves
};

ExactAnswers read_answers(const std::string& path) {
  auto reader = io::NpzReader::open(path);
  EXPECT_TRUE(reader) << reader.error().message;
  auto overlap = reader->read<uint8_t>("overlap", {io::kAny});
  auto separation = reader->read<double>("separation", {io::kAny});
  auto scale = reader->read<double>("scale", {io::kAny});
  auto uncertainty = reader->read<double>("uncertainty", {io::kAny});
  EXPECT_TRUE(overlap && separation && scale && uncertainty);
  return {*overlap, *separation, *scale, *uncertainty};
}

constexpr double kSeparationError = 2e-6;  // in units of L

bool is_certain(const ExactAnswers& answers, size_t i) {
  const double gap = std::fabs(answers.separation[i]);
  return gap > std::max(answers.uncertainty[i], 4 * 0x1p-23 * (answers.scale[i] + gap));
}

void expect_contacts(const PairResultsFile& results, const ExactAnswers& answers) {
  for (size_t i = 0; i < answers.overlap.size(); ++i) {
    EXPECT_EQ(results.status[i], 0) << i;
    if (is_certain(answers, i)) {
      EXPECT_EQ(results.overlap[i], answers.overlap[i]) << i;
    }
    EXPECT_NEAR(results.separation[i], answers.separation[i], kSeparationError * answers.scale[i])
        << i;
  }
}

void expect_manifolds(const PairResultsFile& results, const ExactAnswers& answers) {
  for (size_t i = 0; i < answers.overlap.size(); ++i) {
    const size_t count = results.manifold_count[i];
    EXPECT_EQ(count > 0, results.overlap[i] == 1) << i;
    ASSERT_LE(count, 4u) << i;
    const double tolerance = kSeparationError * answers.scale[i];
    for (size_t k = 0; k < count; ++k) {
      EXPECT_GE(results.manifold_separation[i][k], answers.separation[i] - tolerance) << i;
      EXPECT_LE(results.manifold_separation[i][k], tolerance) << i;
    }
  }
}

class ExactPairsTest : public CliTest {
 protected:
  void check(const std::string& pairs, const std::string& answers_path) {
    const ExactAnswers answers = read_answers(answers_path);
    for (const char* detail : {"overlap", "contact", "manifold"}) {
      const CommandResult run =
          run_command({"pairs", pairs, "-o", path("out.npz"), "--detail", detail});
      ASSERT_EQ(run.code, 0) << run.err;
      const PairResultsFile results = read_pair_results(path("out.npz"), answers.overlap.size());
      if (detail == std::string("overlap")) {
        overlap_ = results.overlap;
        continue;
      }
      EXPECT_EQ(results.overlap, overlap_) << pairs << ' ' << detail;
      expect_contacts(results, answers);
      if (detail == std::string("manifold")) expect_manifolds(results, answers);
    }
  }

 private:
  std::vector<uint8_t> overlap_;  // at detail overlap
};

TEST_F(ExactPairsTest, Sample) {
  check(test_data("pairs_sample.npz"), test_data("pairs_sample.reference.npz"));
}

TEST_F(ExactPairsTest, SampleIsVerified) {
  const CommandResult result =
      run_command({"verify", test_data("pairs_sample.npz"), "--threads", "2"});
  EXPECT_EQ(result.code, 0) << result.out << result.err;
}

TEST_F(ExactPairsTest, Shared) {
  const std::string shared = shared_folder();
  if (shared.empty()) return;
  for (const std::string name :
       {"sphere_sphere", "sphere_capsule", "sphere_box", "sphere_tri", "capsule_capsule",
        "capsule_box", "capsule_tri", "box_box", "box_tri"}) {
    SCOPED_TRACE(name);
    const std::string pairs = shared + "/pairs/" + name + ".npz";
    check(pairs, shared + "/reference/" + name + ".npz");
    const CommandResult verified = run_command({"verify", pairs, "--threads", "1"});
    EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
  }
}

}  // namespace
}  // namespace carom::cli

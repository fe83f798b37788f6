// carom tunnelling and run --detection: what fast bodies meet, in a generated room of bullets and
// in a recorded one.
#include "carom/simd/isa.h"
#include "tests/cli/cli_test_util.h"

namespace carom::cli {
namespace {

using nlohmann::json;
using TunnellingTest = CliTest;

constexpr const char* kBullets = "bullets:n=60,frames=4,seed=3";

json measure(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "tunnelling");
  arguments.insert(arguments.end(), {"--substeps", "1,8", "--json", "-"});
  const CommandResult result = run_command(arguments);
  EXPECT_EQ(result.code, 0) << result.out << result.err;
  return result.json();
}

json row_of(const json& report, const std::string& detection, int substeps = 1) {
  for (const json& row : report["rows"]) {
    if (row["detection"] == detection && row["substeps"] == substeps) return row;
  }
  ADD_FAILURE() << "no row " << detection;
  return {};
}

// Continuous bodies find every impact, in time; steps without looking ahead miss most of them.
void expect_trade(const json& report) {
  const uint64_t meetings = report["meetings"];
  EXPECT_GT(meetings, 20u);
  for (const char* detection : {"continuous", "automatic"}) {
    const json row = row_of(report, detection);
    EXPECT_EQ(row["missed"], 0) << detection;
    EXPECT_EQ(row["late"], 0) << detection;
    EXPECT_EQ(row["unfounded"], 0) << detection;
    EXPECT_LE(row["latest"], 0) << detection;
    // Times are rounded downwards to float32. A grazing impact is early by the square root of the
    // slack.
    EXPECT_LT(row["earliest"], 1e-6) << detection;
    EXPECT_EQ(row["seen"], meetings) << detection;
  }
  const json once = row_of(report, "discrete"), often = row_of(report, "discrete", 8);
  EXPECT_GT(once["missed"].get<uint64_t>(), meetings / 3);
  EXPECT_LT(often["missed"], once["missed"]);
  EXPECT_LT(row_of(report, "swept")["missed"], often["missed"]);
  EXPECT_EQ(report["failures"].size(), 0u);
  for (const json& row : report["rows"]) {
    EXPECT_EQ(row["seen"].get<uint64_t>() + row["missed"].get<uint64_t>(), meetings);
    EXPECT_GT(row["frame_ms"], 0);
  }
}

// In this scene one step a frame misses 90 % or more.
TEST_F(TunnellingTest, BulletsOfAllKindsOnEveryIsa) {
  for (const Isa isa : usable_isas()) {
    expect_trade(measure({kBullets, "--reference-substeps", "500", "--isa", name(isa)}));
  }
}

// The reference finds times between its substeps, so their number does not matter.
TEST_F(TunnellingTest, ReferenceDoesNotDependOnItsSubsteps) {
  const json few = measure({kBullets, "--frames", "2", "--reference-substeps", "7"});
  const json many = measure({kBullets, "--frames", "2", "--reference-substeps", "2000"});
  EXPECT_EQ(few["meetings"], many["meetings"]);
  EXPECT_EQ(few["grazing"].size(), many["grazing"].size());
  EXPECT_EQ(few["frames"], 2);
}

TEST_F(TunnellingTest, Table) {
  const CommandResult result = run_command(
      {"tunnelling", "bullets:n=8,frames=1", "--substeps", "1,2", "--reference-substeps", "100"});
  EXPECT_EQ(result.code, 0) << result.err;
  for (const char* part : {"8 of 50 bodies move", "discrete, 1 step a frame",
                           "discrete, 2 steps a frame", "swept", "continuous", "automatic"}) {
    EXPECT_NE(result.out.find(part), std::string::npos) << part << '\n' << result.out;
  }
}

TEST_F(TunnellingTest, Errors) {
  expect_error({"tunnelling", path("absent.npz")}, {"absent.npz"});
  expect_error({"tunnelling", kBullets, "--substeps", "0"}, {"--substeps"});
  expect_error({"tunnelling", kBullets, "--substeps", "1,x"}, {"--substeps"});
  expect_error({"tunnelling", kBullets, "--reference-substeps", "0"}, {"--reference-substeps"});
  expect_error({"tunnelling", kBullets, "--threads", "0"}, {"--threads 0"});
  expect_error({"tunnelling", kBullets, "--isa", "mmx"}, {"unknown ISA 'mmx'"});
  run_command({"generate", "brownian:n=5,frames=2", "-o", path("bounds.aabb")});
  expect_error({"tunnelling", path("bounds.aabb")}, {"bounds.aabb: has no velocities"});
  expect_error({"tunnelling", "brownian:n=9,shape=cone"}, {"has a cone", "are not measured"});
  expect_error({"run", path("bounds.aabb"), "--detection", "swept"},
               {"bounds.aabb: has no velocities", "--detection swept"});
  expect_error({"run", kBullets, "--detection", "psychic"},
               {"unknown detection 'psychic'", "discrete, swept, continuous, automatic"});
}

json run_json(const std::string& scene, std::vector<std::string> options) {
  options.insert(options.begin(), {"run", scene});
  options.insert(options.end(), {"--json", "-"});
  const CommandResult result = run_command(options);
  EXPECT_EQ(result.code, 0) << result.err;
  return result.json();
}

void expect_one_hash(const std::string& scene, const std::string& detection) {
  std::string hash;
  for (const Isa isa : usable_isas()) {
    for (const char* threads : {"1", "2"}) {
      const json report = run_json(scene, {"--frames", "3", "--detection", detection, "--isa",
                                           name(isa), "--threads", threads});
      if (hash.empty()) hash = report["state_hash"];
      EXPECT_EQ(report["state_hash"], hash) << detection << ' ' << name(isa) << ' ' << threads;
    }
  }
}

TEST_F(TunnellingTest, RunSaysWhatIsAhead) {
  const json discrete = run_json(kBullets, {});
  EXPECT_EQ(discrete["detection"], "discrete");
  EXPECT_FALSE(discrete.contains("impacts_per_frame"));
  EXPECT_EQ(run_json(kBullets, {"--detection", "discrete"})["state_hash"], discrete["state_hash"]);

  const json continuous = run_json(kBullets, {"--detection", "continuous"});
  EXPECT_EQ(continuous["detection"], "continuous");
  ASSERT_EQ(continuous["impacts_per_frame"].size(), 4u);
  EXPECT_EQ(continuous["swept_per_frame"][0], 60);
  EXPECT_EQ(continuous["speculative_per_frame"][0], 0);
  EXPECT_GT(continuous["impacts_per_frame"][0], 0);
  EXPECT_TRUE(continuous["stage_ms"].contains("impacts"));
  EXPECT_TRUE(continuous["stage_ms"].contains("sweeps"));
  EXPECT_NE(continuous["state_hash"], discrete["state_hash"]);

  const json swept = run_json(kBullets, {"--detection", "swept"});
  EXPECT_EQ(swept["impacts_per_frame"][0], 0);
  EXPECT_GT(swept["speculative_per_frame"][0], 0);
  const CommandResult table = run_command({"run", kBullets, "--detection", "automatic"});
  EXPECT_NE(table.out.find("impacts"), std::string::npos) << table.out;
}

TEST_F(TunnellingTest, HashesDoNotDependOnHowScenesAreRun) {
  for (const char* detection : {"swept", "continuous", "automatic"}) {
    expect_one_hash(kBullets, detection);
  }
}

TEST_F(TunnellingTest, SharedFast) {
  const std::string shared = shared_folder();
  if (shared.empty()) return;
  const std::string scene = shared + "/scenes/fast.npz";
  expect_one_hash(scene, "continuous");
  for (const Isa isa : usable_isas()) {
    expect_trade(
        measure({scene, "--frames", "6", "--reference-substeps", "1000", "--isa", name(isa)}));
  }
}

}  // namespace
}  // namespace carom::cli

// The recordings beside the project: exact pair counts, and the same hash however they are run.
#include "carom/simd/isa.h"
#include "tests/cli/cli_test_util.h"

namespace carom::cli {
namespace {

nlohmann::json run_recording(const std::string& path, const char* isa, const char* threads) {
  const CommandResult result =
      run_command({"run", path, "--isa", isa, "--threads", threads, "--json", "-"});
  EXPECT_EQ(result.code, 0) << result.err;
  return result.json();
}

TEST(SharedTest, RecordingsHaveTheExpectedPairs) {
  const std::string shared = shared_folder();
  if (shared.empty()) return;
  size_t recordings = 0;
  for (const auto& entry : std::filesystem::directory_iterator(shared + "/scenes")) {
    if (entry.path().extension() != ".aabb") continue;
    ++recordings;
    auto beside = entry.path();
    const auto expected = read_json(beside.replace_extension(".expected.json").string());
    std::string hash;
    for (const Isa isa : usable_isas()) {
      for (const char* threads : {"1", "2"}) {
        const auto report = run_recording(entry.path().string(), name(isa), threads);
        EXPECT_EQ(report["pairs_per_frame"], expected["pairs_per_frame"]) << entry.path();
        if (hash.empty()) hash = report["state_hash"];
        EXPECT_EQ(report["state_hash"], hash) << entry.path() << ' ' << name(isa) << ' ' << threads;
      }
    }
  }
  EXPECT_GT(recordings, 0u);
}

// Hulls and a terrain among other kinds.
TEST(SharedTest, Junkyard) {
  const std::string shared = shared_folder();
  if (shared.empty()) return;
  const std::string scene = shared + "/scenes/junkyard.npz";
  std::string hash;
  for (const Isa isa : usable_isas()) {
    const CommandResult run = run_command(
        {"run", scene, "--frames", "3", "--detail", "manifold", "--isa", name(isa), "--json", "-"});
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(run.err, "");  // no body is left out
    const auto report = run.json();
    if (hash.empty()) hash = report["state_hash"];
    EXPECT_EQ(report["state_hash"], hash) << name(isa);
    for (const auto& contacts : report["contacts_per_frame"]) EXPECT_GT(contacts, 0);
  }
}

TEST(SharedTest, HullPairs) {
  const std::string shared = shared_folder();
  if (shared.empty()) return;
  const CommandResult verified =
      run_command({"verify", shared + "/pairs/hull8_hull8.npz", "--threads", "1"});
  EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
}

// Spheres that settle between half-spaces.
TEST(SharedTest, SpheresBetweenHalfspaces) {
  const std::string shared = shared_folder();
  if (shared.empty()) return;
  const std::string scene = shared + "/scenes/spheres.npz";
  const CommandResult run = run_command({"run", scene, "--detail", "manifold", "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err, "");  // no body is left out
  const auto report = run.json();
  for (const auto& contacts : report["contacts_per_frame"]) EXPECT_GT(contacts, 0);
  const CommandResult verified = run_command({"verify", scene, "--frames", "2", "--threads", "1"});
  EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
}

}  // namespace
}  // namespace carom::cli

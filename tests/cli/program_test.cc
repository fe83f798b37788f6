// carom info, help, and the small parts of the program.
#include "carom/simd/isa.h"
#include "cli/state_hash.h"
#include "cli/statistics.h"
#include "tests/cli/cli_test_util.h"

namespace carom::cli {
namespace {

TEST(ProgramTest, InfoTellsBuildAndMachine) {
  const CommandResult result = run_command({"info"});
  EXPECT_EQ(result.code, 0) << result.err;
  for (const char* word : {"compiler", "flags", "-ffp-contract=off", "ISAs compiled in",
                           "ISAs usable here", "threads", "Highway", "oneTBB", "libzip"}) {
    EXPECT_NE(result.out.find(word), std::string::npos) << word;
  }
  EXPECT_NE(result.out.find(name(active_isa())), std::string::npos);
}

TEST(ProgramTest, HelpAndVersion) {
  const CommandResult help = run_command({"--help"});
  EXPECT_EQ(help.code, 0);
  EXPECT_NE(help.out.find("verify"), std::string::npos);
  EXPECT_EQ(run_command({"run", "--help"}).code, 0);
  EXPECT_NE(run_command({"generate", "--help"}).out.find("brownian"), std::string::npos);
  EXPECT_EQ(run_command({"--version"}).out.rfind("carom ", 0), 0u);
}

TEST(ProgramTest, Statistics) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 2, 3}), 2.5);
  EXPECT_EQ(median({}), 0);
  std::vector<double> values;
  for (int i = 200; i >= 1; --i) values.push_back(i);
  const Summary summary = summarize(values);
  EXPECT_EQ(summary.min, 1);
  EXPECT_EQ(summary.p99, 198);
  EXPECT_EQ(summary.median, 100.5);
  EXPECT_EQ(summary.mean, 100.5);
  EXPECT_EQ(summarize({7}).p99, 7);
}

std::string hash_of(const std::vector<std::vector<uint8_t>>& lists) {
  StateHash hash;
  for (const auto& list : lists) hash.add(std::span(list));
  return hash.text();
}

TEST(ProgramTest, HashSeesOrderLengthAndEveryBit) {
  EXPECT_EQ(hash_of({{1, 2}, {3}}), hash_of({{1, 2}, {3}}));
  EXPECT_NE(hash_of({{1, 2}, {3}}), hash_of({{1}, {2, 3}}));
  EXPECT_NE(hash_of({{1, 2}}), hash_of({{2, 1}}));
  EXPECT_NE(hash_of({{0}}), hash_of({{0, 0}}));
  EXPECT_NE(hash_of({{}}), hash_of({}));
  EXPECT_NE(hash_of({std::vector<uint8_t>(64, 0)}), hash_of({std::vector<uint8_t>(64, 128)}));
}

}  // namespace
}  // namespace carom::cli

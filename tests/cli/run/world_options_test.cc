// The options of `carom run` that are settings of its world: their text, their keys, their
// documents.
#include "cli/run/world_options.h"

#include "cli/support/command_line.h"
#include "tests/cli/cli_test_util.h"

namespace carom::cli {
namespace {

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

std::string text_of_file(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

// No setting has its default.
RunSettings unusual_settings() {
  RunSettings settings;
  settings.world.accuracy.tier = Tier::fast;
  settings.world.accuracy.tolerance = 0.125f;
  settings.world.detail = Detail::manifold;
  settings.detection = Detection::continuous;
  settings.world.broadphase = BroadphaseMethod::sweep;
  settings.world.margin = 0.1f;
  settings.world.contact_distance = 0.05f;
  settings.world.dop_bounds = DopKind::k14;
  settings.world.carry_results = false;
  return settings;
}

constexpr char kUnusualText[] =
    " --tier fast --tolerance 0.125 --detail manifold --detection "
    "continuous --broadphase sweep --margin 0.1 --contact-distance 0.05 --dop-bounds 14 --no-cache";

Result<RunSettings> parse(const std::string& text) {
  CommandLine program("carom", "", "");
  Command command = program.add_command("run", "");
  WorldOptions options;
  options.add_to(command);
  command.run([](const Console&) { return Result<int>(0); });
  std::vector<std::string> words = words_of("run" + text);
  const Result<Action> action = program.parse(words, {std::cout, std::cerr});
  return action ? options.read() : action.error();
}

TEST(WorldOptions, TheirTextChoosesTheSettingsAgain) {
  const WorldOptions options;
  EXPECT_EQ(options.text_of({}), "");
  EXPECT_EQ(options.text_of(unusual_settings()), kUnusualText);
  for (const std::string& text :
       {std::string(), std::string(kUnusualText), std::string(" --tier certified"),
        std::string(" --tier exact --detail pairs"), std::string(" --tier fast"),
        std::string(" --detail pairs --pair-order any"),
        std::string(" --detection swept --broadphase brute --dop-bounds 26")}) {
    const Result<RunSettings> settings = parse(text);
    ASSERT_TRUE(settings) << settings.error().message;
    EXPECT_EQ(options.text_of(*settings), text);
  }
}

TEST(WorldOptions, UnusualSettingsAreRead) {
  const Result<RunSettings> settings = parse(kUnusualText);
  ASSERT_TRUE(settings) << settings.error().message;
  const WorldSettings& world = settings->world;
  EXPECT_EQ(world.accuracy.tier, Tier::fast);
  EXPECT_EQ(world.accuracy.tolerance, 0.125f);
  EXPECT_EQ(world.detail, Detail::manifold);
  EXPECT_EQ(settings->detection, Detection::continuous);
  EXPECT_EQ(world.broadphase, BroadphaseMethod::sweep);
  EXPECT_EQ(world.margin, 0.1f);
  EXPECT_EQ(world.contact_distance, 0.05f);
  EXPECT_EQ(world.dop_bounds, DopKind::k14);
  EXPECT_FALSE(world.carry_results);
}

// With all options given: the first keys of the JSON, in their order.
TEST(WorldOptions, TheJsonHasTheirKeys) {
  std::vector<std::string> arguments =
      words_of("run brownian:n=20,frames=2" + std::string(kUnusualText) + " --json -");
  const CommandResult result = run_command(arguments);
  ASSERT_EQ(result.code, 0) << result.err;
  const auto report = nlohmann::ordered_json::parse(result.out);
  std::vector<std::string> keys;
  for (const auto& item : report.items()) keys.push_back(item.key());
  const std::vector<std::string> expected = {"scene",
                                             "bodies",
                                             "frames",
                                             "threads",
                                             "isa",
                                             "tier",
                                             "tolerance",
                                             "detail",
                                             "detection",
                                             "broadphase",
                                             "broadphase_reason",
                                             "pair_order",
                                             "margin",
                                             "contact_distance",
                                             "dop_bounds",
                                             "pipeline"};
  ASSERT_GE(keys.size(), expected.size());
  keys.resize(expected.size());
  EXPECT_EQ(keys, expected);
  EXPECT_EQ(report["tier"], "fast");
  EXPECT_EQ(report["tolerance"], 0.125);
  EXPECT_EQ(report["detail"], "manifold");
  EXPECT_EQ(report["detection"], "continuous");
  EXPECT_EQ(report["broadphase"], "sweep");
  EXPECT_EQ(report["margin"].get<float>(), 0.1f);
  EXPECT_EQ(report["dop_bounds"], 14);
}

TEST(WorldOptions, DocumentsNameEveryOptionAndEveryKey) {
  const std::string docs = test_data("../../docs/");
  const std::string command_line = text_of_file(docs + "command-line.md");
  const std::string formats = text_of_file(docs + "formats.md");
  size_t options = 0;
  for (const std::string& word : words_of(run_command({"run", "--help"}).out)) {
    if (word.rfind("--", 0) != 0) continue;
    ++options;
    EXPECT_NE(command_line.find("`" + word), std::string::npos) << word;
  }
  EXPECT_GE(options, 15u);
  const CommandResult result =
      run_command(words_of("run brownian:n=20,frames=2" + std::string(kUnusualText) + " --json -"));
  ASSERT_EQ(result.code, 0) << result.err;
  const nlohmann::json report = result.json();
  for (const auto& item : report.items()) {
    EXPECT_NE(formats.find("`" + item.key() + "`"), std::string::npos) << item.key();
  }
}

}  // namespace
}  // namespace carom::cli

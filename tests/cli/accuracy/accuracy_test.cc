// The command carom accuracy; tests/accuracy tests the measurements themselves.
#include <gmock/gmock.h>

#include "tests/cli/cli_test_util.h"

namespace carom::cli {
namespace {

using testing::HasSubstr;

class AccuracyCommand : public CliTest {};

TEST_F(AccuracyCommand, WritesDataAndPage) {
  const std::string folder = path("new/folder");
  const CommandResult result =
      run_command({"accuracy", "--pairs", "sphere_sphere", "--out", folder});
  EXPECT_EQ(result.code, 0) << result.err << result.out;
  EXPECT_THAT(result.out, HasSubstr("certified"));
  EXPECT_THAT(result.out, HasSubstr("No failures"));
  const nlohmann::json json = read_json(folder + "/accuracy.json");
  EXPECT_EQ(json["carom_accuracy"], 1);
  EXPECT_EQ(json["tradeoff"][0]["pair"], "sphere_sphere");
  std::ifstream page(folder + "/index.html");
  const std::string text(std::istreambuf_iterator<char>(page), {});
  EXPECT_THAT(text, HasSubstr("\"tradeoff\":[{\"pair\":\"sphere_sphere\""));
}

TEST_F(AccuracyCommand, RefusesWhatItDoesNotKnow) {
  expect_error({"accuracy", "--pairs", "sphere_cow"}, {"sphere_cow"});
  expect_error({"accuracy", "--mode", "endless"}, {"--mode"});
  expect_error({"accuracy", "--out", test_data("settling.npz")}, {"settling.npz"});
}

}  // namespace
}  // namespace carom::cli

#include "tests/cli/cli_test_util.h"

namespace carom::cli {

CommandResult run_command(const std::vector<std::string>& arguments) {
  std::ostringstream out, err;
  const int code = run_cli(all_commands(), arguments, out, err);
  return {code, out.str(), err.str()};
}

void expect_error(const std::vector<std::string>& arguments,
                  std::initializer_list<std::string> parts) {
  const CommandResult result = run_command(arguments);
  EXPECT_NE(result.code, 0);
  EXPECT_EQ(result.err.rfind("carom: ", 0), 0u) << result.err;
  EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << result.err;
  for (const std::string& part : parts) {
    EXPECT_NE(result.err.find(part), std::string::npos) << part << " is not in " << result.err;
  }
}

CliTest::CliTest() {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  folder_ = std::filesystem::temp_directory_path() /
            (std::string("carom_cli_") + test->test_suite_name() + "_" + test->name() + "_" +
             std::to_string(::getpid()));
  std::filesystem::create_directories(folder_);
}

size_t CliTest::files() const {
  const std::filesystem::directory_iterator entries(folder_);
  return static_cast<size_t>(std::distance(begin(entries), end(entries)));
}

std::string test_data(const std::string& name) {
  return std::string(CAROM_TEST_DATA_DIR) + "/" + name;
}

nlohmann::json read_json(const std::string& path) {
  std::ifstream file(path);
  return nlohmann::json::parse(file, nullptr, false);
}

void write_builtin(const std::string& name, const std::string& path) {
  for (BuiltinScene& builtin : builtin_scenes()) {
    if (builtin.name != name) continue;
    auto writer = io::SceneWriter::create(path, builtin.scene->info());
    ASSERT_TRUE(writer) << writer.error().message;
    io::SceneFrame frame;
    for (uint64_t i = 0; i < builtin.scene->info().frames; ++i) {
      ASSERT_TRUE(builtin.scene->read_frame(frame));
      ASSERT_TRUE(writer->write_frame(frame));
    }
    ASSERT_TRUE(writer->finish());
    return;
  }
  FAIL() << "no scene " << name;
}

std::string shared_folder() {
  const char* variable = std::getenv("CAROM_SHARED");
  const std::string folder = variable ? variable : CAROM_SHARED_DIR;
  if (std::filesystem::is_directory(folder + "/scenes")) return folder;
  std::cout << "no shared samples at " << folder << ": not tested with them\n";
  return "";
}

}  // namespace carom::cli

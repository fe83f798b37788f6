// Runs commands in this process, and makes files for them.
#pragma once

#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "cli/cli.h"
#include "cli/verify/verify_builtin.h"

namespace carom::cli {

struct CommandResult {
  int code;
  std::string out;
  std::string err;

  nlohmann::json json() const { return nlohmann::json::parse(out, nullptr, false); }
};

inline CommandResult run_command(const std::vector<std::string>& arguments) {
  std::ostringstream out, err;
  const int code = run_cli(all_commands(), arguments, out, err);
  return {code, out.str(), err.str()};
}

// Expects one line on standard error that starts with "carom: " and contains all of `parts`.
inline void expect_error(const std::vector<std::string>& arguments,
                         std::initializer_list<std::string> parts) {
  const CommandResult result = run_command(arguments);
  EXPECT_NE(result.code, 0);
  EXPECT_EQ(result.err.rfind("carom: ", 0), 0u) << result.err;
  EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << result.err;
  for (const std::string& part : parts) {
    EXPECT_NE(result.err.find(part), std::string::npos) << part << " is not in " << result.err;
  }
}

// A test with a folder of its own, which is removed afterwards.
class CliTest : public testing::Test {
 protected:
  CliTest() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("carom_cli_") + test->test_suite_name() + "_" + test->name() + "_" +
               std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  ~CliTest() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  size_t files() const {
    const std::filesystem::directory_iterator entries(folder_);
    return static_cast<size_t>(std::distance(begin(entries), end(entries)));
  }

 private:
  std::filesystem::path folder_;
};

inline std::string test_data(const std::string& name) {
  return std::string(CAROM_TEST_DATA_DIR) + "/" + name;
}

inline nlohmann::json read_json(const std::string& path) {
  std::ifstream file(path);
  return nlohmann::json::parse(file, nullptr, false);
}

// Writes the built-in scene that `carom verify` lists by this name.
inline void write_builtin(const std::string& name, const std::string& path) {
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

// The folder of recorded samples: CAROM_SHARED or the one beside the project. If there is none it
// prints so and returns an empty string; the test then has nothing to check.
inline std::string shared_folder() {
  const char* variable = std::getenv("CAROM_SHARED");
  const std::string folder = variable ? variable : CAROM_SHARED_DIR;
  if (std::filesystem::is_directory(folder + "/scenes")) return folder;
  std::cout << "no shared samples at " << folder << ": not tested with them\n";
  return "";
}

}  // namespace carom::cli

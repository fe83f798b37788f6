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

CommandResult run_command(const std::vector<std::string>& arguments);

// Expects one line on standard error that starts with "carom: " and contains all of `parts`.
void expect_error(const std::vector<std::string>& arguments,
                  std::initializer_list<std::string> parts);

// A test with a folder of its own, which is removed afterwards.
class CliTest : public testing::Test {
 protected:
  CliTest();
  ~CliTest() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  size_t files() const;

 private:
  std::filesystem::path folder_;
};

std::string test_data(const std::string& name);

nlohmann::json read_json(const std::string& path);

// Writes the built-in scene that `carom verify` lists by this name.
void write_builtin(const std::string& name, const std::string& path);

// The folder of recorded samples: CAROM_SHARED or the one beside the project. If there is none it
// prints so and returns an empty string; the test then has nothing to check.
std::string shared_folder();

}  // namespace carom::cli

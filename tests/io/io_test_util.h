// For tests of readers and writers: a scratch folder, and files made byte by byte.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "io/files/npz.h"

namespace carom::io {

class TemporaryFolder : public ::testing::Test {
 protected:
  TemporaryFolder();
  ~TemporaryFolder() override;

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::string write_file(const std::string& name, std::string_view bytes) const;

  std::string read_file(const std::string& name) const;

  // The names of all entries of the folder.
  std::vector<std::string> entries() const;

 private:
  std::filesystem::path folder_;
};

// For EXPECT_TRUE: a failure shows the text of the error.
template <class T>
::testing::AssertionResult succeeds(const Result<T>& result) {
  if (result) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << result.error().message;
}

// The error's text, which must be one line; empty if there is no error.
template <class T>
std::string message_of(const Result<T>& result) {
  if (result) return "";
  EXPECT_EQ(result.error().message.find('\n'), std::string::npos) << result.error().message;
  return result.error().message;
}

// One member of an archive that is written with libzip directly.
struct RawMember {
  std::string name;  // with ".npy"
  std::string bytes;
};
void write_zip(const std::string& path, const std::vector<RawMember>& members, bool deflate);

// A .npy file with this header text and data.
std::string npy_bytes(const std::string& dict, const std::string& data, char version = 1);

template <class T>
std::string raw(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

}  // namespace carom::io

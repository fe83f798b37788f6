// A file that appears under its name only when it is complete.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "carom/base/result.h"
#include "io/files/file.h"

namespace carom::io {

// Writes to a temporary file in the target's folder; commit() gives it the target's name.
// Destroyed before that, it removes the temporary file and leaves the target as it was.
class AtomicFile {
 public:
  // Refuses a target that exists and is not a regular file.
  static Result<AtomicFile> create(const std::string& path);
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  ~AtomicFile();

  const std::string& path() const { return path_; }
  const std::string& temporary_path() const { return temporary_path_; }
  uint64_t bytes_written() const { return offset_; }

  Result<void> write(std::span<const std::byte> bytes);  // appends
  Result<void> write_at(uint64_t offset, std::span<const std::byte> bytes);
  Result<void> commit();

 private:
  AtomicFile(std::string path, std::string temporary_path, File file);
  void remove_temporary();
  void forget_temporary();

  std::string path_;
  std::string temporary_path_;  // empty once committed or moved from
  int slot_ = -1;               // where remove_temporary_files() finds the path; -1: nowhere
  File file_;
  uint64_t offset_ = 0;
};

// Removes the temporary file of every AtomicFile. A handler of a fatal signal calls this; it is
// safe at any moment and in any thread.
void remove_temporary_files() noexcept;

// An unnamed file in the folder of `path`; it disappears when its last descriptor is closed.
Result<File> open_spool(const std::string& path);

// Writes a whole text file (JSON output) or leaves everything as it was.
Result<void> write_text_file(const std::string& path, std::string_view text);

}  // namespace carom::io

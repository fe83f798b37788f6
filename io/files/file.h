// An owned file descriptor, and whole reads and writes on it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "carom/base/result.h"

namespace carom::io {

class File {
 public:
  File() = default;
  explicit File(int descriptor) : descriptor_(descriptor) {}
  File(File&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  File& operator=(File&& other) noexcept;
  ~File();

  // A regular file to read; `what` names the kind expected, for the error ("a .npz archive").
  static Result<File> open(const std::string& path, const std::string& what);

  explicit operator bool() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }
  int release() { return std::exchange(descriptor_, -1); }

  Result<uint64_t> size(const std::string& path) const;
  // Fills `out` from `offset`; fails if the file ends before. The error names `path`.
  Result<void> read_at(uint64_t offset, std::span<std::byte> out, const std::string& path) const;
  Result<void> write_at(uint64_t offset, std::span<const std::byte> bytes,
                        const std::string& path) const;
  // Closes now; fails if the data did not reach the file.
  Result<void> close(const std::string& path);

 private:
  int descriptor_ = -1;
};

// An error "path: text".
Error file_error(const std::string& path, const std::string& text);
// An error "path: text: reason of errno".
Error system_error(const std::string& path, const std::string& text, int error_number);

// "folder/" of a path, "./" if it names none.
std::string folder_of(const std::string& path);
// The file's name without its folder and last extension.
std::string stem_of(const std::string& path);
// Ignores case; `extension` includes the dot.
bool has_extension(const std::string& path, const std::string& extension);

}  // namespace carom::io

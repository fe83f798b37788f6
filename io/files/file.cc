#include "io/files/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <system_error>

#include "io/printable.h"

namespace carom::io {

Error file_error(const std::string& path, const std::string& text) {
  return {printable_name(path) + ": " + text};
}

Error system_error(const std::string& path, const std::string& text, int error_number) {
  return file_error(path, text + ": " + std::generic_category().message(error_number));
}

std::string folder_of(const std::string& path) {
  const size_t slash = path.rfind('/');
  return slash == std::string::npos ? "./" : path.substr(0, slash + 1);
}

std::string stem_of(const std::string& path) {
  const size_t slash = path.rfind('/');
  std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
  const size_t dot = name.rfind('.');
  return dot == std::string::npos || dot == 0 ? name : name.substr(0, dot);
}

bool has_extension(const std::string& path, const std::string& extension) {
  if (path.size() < extension.size()) return false;
  return std::equal(extension.rbegin(), extension.rend(), path.rbegin(), [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) ==
           std::tolower(static_cast<unsigned char>(b));
  });
}

File& File::operator=(File&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

File::~File() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Result<File> File::open(const std::string& path, const std::string& what) {
  // O_NONBLOCK: do not hang on a pipe without a writer. Regular files ignore the flag.
  File file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!file) return system_error(path, "cannot be opened", errno);
  struct stat status {};
  if (::fstat(file.descriptor(), &status) != 0) {
    return system_error(path, "cannot be examined", errno);
  }
  if (S_ISDIR(status.st_mode)) {
    return file_error(path, "is a directory (" + what + " was expected)");
  }
  if (!S_ISREG(status.st_mode)) {
    return file_error(path, "is not a regular file (" + what + " was expected)");
  }
  if (status.st_size == 0) return file_error(path, "is empty (" + what + " was expected)");
  return file;
}

Result<uint64_t> File::size(const std::string& path) const {
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) {
    return system_error(path, "cannot be examined", errno);
  }
  return static_cast<uint64_t>(status.st_size);
}

Result<void> File::read_at(uint64_t offset, std::span<std::byte> out,
                           const std::string& path) const {
  while (!out.empty()) {
    const ssize_t count = ::pread(descriptor_, out.data(), out.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return system_error(path, "cannot be read", errno);
    if (count == 0) {
      return file_error(path, "is truncated: ends at byte " + std::to_string(offset) + " (" +
                                  std::to_string(out.size()) + " more were expected)");
    }
    out = out.subspan(static_cast<size_t>(count));
    offset += static_cast<uint64_t>(count);
  }
  return {};
}

Result<void> File::write_at(uint64_t offset, std::span<const std::byte> bytes,
                            const std::string& path) const {
  while (!bytes.empty()) {
    const ssize_t count =
        ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return system_error(path, "cannot be written", errno);
    bytes = bytes.subspan(static_cast<size_t>(count));
    offset += static_cast<uint64_t>(count);
  }
  return {};
}

Result<void> File::close(const std::string& path) {
  const int descriptor = release();
  if (descriptor >= 0 && ::close(descriptor) != 0) {
    return system_error(path, "cannot be written", errno);
  }
  return {};
}

}  // namespace carom::io

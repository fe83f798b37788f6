// A file in memory with a path, for readers that take paths.
#pragma once

#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>

#include "io/files/file.h"

namespace carom::fuzz {

class MemoryFile {
 public:
  MemoryFile(const uint8_t* data, size_t size) : file_(memfd_create("fuzz", MFD_CLOEXEC)) {
    if (!file_ || !file_.write_at(0, std::as_bytes(std::span(data, size)), "memory")) std::abort();
  }

  std::string path() const { return "/proc/self/fd/" + std::to_string(file_.descriptor()); }

 private:
  io::File file_;
};

}  // namespace carom::fuzz

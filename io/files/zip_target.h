// Lets libzip write an archive straight into an AtomicFile. Given a path, libzip would write a
// temporary file of its own, which an interrupted program could not remove.
#pragma once

#include <zip.h>

#include <cstdint>
#include <optional>

#include "io/files/atomic_file.h"

namespace carom::io {

class ZipTarget {
 public:
  // `file` must outlive this object, and this object the archive.
  explicit ZipTarget(AtomicFile& file) : file_(file) { zip_error_init(&error_); }
  ZipTarget(const ZipTarget&) = delete;
  ZipTarget& operator=(const ZipTarget&) = delete;
  ~ZipTarget() { zip_error_fini(&error_); }

  // A new archive; nullptr if libzip refuses.
  zip_t* open();
  // The write error, or nothing if another step failed.
  const std::optional<Error>& failure() const { return failure_; }

 private:
  static zip_int64_t call(void* self, void* data, zip_uint64_t length, zip_source_cmd_t command);
  zip_int64_t serve(void* data, zip_uint64_t length, zip_source_cmd_t command);
  zip_int64_t write(const void* data, zip_uint64_t length);
  zip_int64_t seek(void* data, zip_uint64_t length);
  zip_int64_t refuse(int zip_code, int error_number);

  AtomicFile& file_;
  uint64_t position_ = 0;
  uint64_t size_ = 0;
  zip_error_t error_;
  std::optional<Error> failure_;
};

}  // namespace carom::io

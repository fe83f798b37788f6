#include "io/files/zip_target.h"

#include <algorithm>
#include <cerrno>

namespace carom::io {

zip_t* ZipTarget::open() {
  zip_source_t* source = zip_source_function_create(call, this, nullptr);
  if (source == nullptr) return nullptr;
  zip_t* archive = zip_open_from_source(source, ZIP_CREATE | ZIP_TRUNCATE, nullptr);
  if (archive == nullptr) zip_source_free(source);
  return archive;
}

zip_int64_t ZipTarget::call(void* self, void* data, zip_uint64_t length, zip_source_cmd_t command) {
  return static_cast<ZipTarget*>(self)->serve(data, length, command);
}

zip_int64_t ZipTarget::serve(void* data, zip_uint64_t length, zip_source_cmd_t command) {
  switch (command) {
    case ZIP_SOURCE_SUPPORTS:
      return ZIP_SOURCE_SUPPORTS_WRITABLE;
    case ZIP_SOURCE_STAT:
      return refuse(ZIP_ER_READ, ENOENT);  // there is no older archive to read
    case ZIP_SOURCE_WRITE:
      return write(data, length);
    case ZIP_SOURCE_SEEK_WRITE:
      return seek(data, length);
    case ZIP_SOURCE_TELL_WRITE:
      return static_cast<zip_int64_t>(position_);
    case ZIP_SOURCE_ERROR:
      return zip_error_to_data(&error_, data, length);
    case ZIP_SOURCE_BEGIN_WRITE:
    case ZIP_SOURCE_COMMIT_WRITE:  // the AtomicFile's own commit() follows
    case ZIP_SOURCE_ROLLBACK_WRITE:
    case ZIP_SOURCE_REMOVE:
    case ZIP_SOURCE_FREE:
      return 0;
    default:
      return refuse(ZIP_ER_OPNOTSUPP, 0);
  }
}

zip_int64_t ZipTarget::write(const void* data, zip_uint64_t length) {
  const std::span bytes(static_cast<const std::byte*>(data), length);
  if (Result<void> done = file_.write_at(position_, bytes); !done) {
    failure_ = done.error();
    return refuse(ZIP_ER_WRITE, EIO);
  }
  position_ += length;
  size_ = std::max(size_, position_);
  return static_cast<zip_int64_t>(length);
}

zip_int64_t ZipTarget::seek(void* data, zip_uint64_t length) {
  const zip_int64_t offset =
      zip_source_seek_compute_offset(position_, size_, data, length, &error_);
  if (offset < 0) return -1;
  position_ = static_cast<uint64_t>(offset);
  return 0;
}

zip_int64_t ZipTarget::refuse(int zip_code, int error_number) {
  zip_error_set(&error_, zip_code, error_number);
  return -1;
}

}  // namespace carom::io

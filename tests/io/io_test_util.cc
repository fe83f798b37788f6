#include "tests/io/io_test_util.h"

#include <zip.h>

namespace carom::io {

void write_zip(const std::string& path, const std::vector<RawMember>& members, bool deflate) {
  zip_t* archive = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
  ASSERT_NE(archive, nullptr);
  for (const RawMember& member : members) {
    zip_source_t* source = zip_source_buffer(archive, member.bytes.data(), member.bytes.size(), 0);
    const zip_int64_t index = zip_file_add(archive, member.name.c_str(), source, 0);
    ASSERT_GE(index, 0);
    zip_set_file_compression(archive, static_cast<zip_uint64_t>(index),
                             deflate ? ZIP_CM_DEFLATE : ZIP_CM_STORE, 0);
  }
  ASSERT_EQ(zip_close(archive), 0);
}

std::string npy_bytes(const std::string& dict, const std::string& data, char version) {
  std::string out = "\x93NUMPY";
  out += version;
  out += '\0';
  const size_t length = dict.size();
  out += static_cast<char>(length & 0xff);
  out += static_cast<char>(length >> 8);
  if (version > 1) out += std::string(2, '\0');
  return out + dict + data;
}

}  // namespace carom::io

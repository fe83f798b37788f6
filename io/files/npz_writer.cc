#include <unistd.h>
#include <zip.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>

#include "io/files/npz.h"
#include "io/files/zip_target.h"

namespace carom::io {

struct PendingMember {
  std::string name;
  NpyHeader header;
  std::vector<std::byte> bytes;  // header and data, or
  File spool;                    // room for the header, then data
  uint64_t row_bytes = 0;
  uint64_t spooled = 0;  // bytes of data
  uint64_t rows = 0;
};

namespace {

// Bytes reserved in front of spooled data for the header, which is written last; enough for every
// shape.
constexpr uint64_t kSpoolHeaderBytes = 256;

// 1980-01-01 00:00: a fixed date, so that the same arrays always make the same file.
constexpr zip_uint16_t kDosDate = 1 << 5 | 1;

struct ZipDiscard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};

}  // namespace

struct NpzWriter::State {
  AtomicFile file;
  Compression compression;
  std::vector<PendingMember> members;

  Error error(const PendingMember& member, const std::string& text) const {
    return member_error(file.path(), member.name, text);
  }
  bool has(const std::string& name) const {
    return std::any_of(members.begin(), members.end(),
                       [&](const PendingMember& member) { return member.name == name; });
  }
  Result<void> complete_spool(PendingMember& member) const;
  Result<void> add_to(zip_t* archive, PendingMember& member) const;
};

NpzWriter::NpzWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}
NpzWriter::NpzWriter(NpzWriter&&) noexcept = default;
NpzWriter& NpzWriter::operator=(NpzWriter&&) noexcept = default;
NpzWriter::~NpzWriter() = default;

Result<NpzWriter> NpzWriter::create(const std::string& path, Compression compression) {
  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return file.error();
  return NpzWriter(std::unique_ptr<State>(new State{std::move(*file), compression, {}}));
}

Result<void> NpzWriter::add_bytes(const std::string& name, const NpyHeader& header,
                                  std::span<const std::byte> bytes) {
  const std::string& path = state_->file.path();
  if (state_->has(name)) return member_error(path, name, "is added twice");
  Result<uint64_t> expected = npy_data_bytes(header);
  if (!expected || *expected != bytes.size()) {
    return member_error(path, name,
                        "holds " + std::to_string(bytes.size()) + " bytes, which is not shape " +
                            shape_text(header.shape) + " of " + dtype_name(header.dtype));
  }
  PendingMember member;
  member.name = name;
  member.header = header;
  const std::string text = print_npy_header(header);
  const auto head = std::as_bytes(std::span(text.data(), text.size()));
  member.bytes.reserve(head.size() + bytes.size());
  member.bytes.assign(head.begin(), head.end());
  member.bytes.insert(member.bytes.end(), bytes.begin(), bytes.end());
  state_->members.push_back(std::move(member));
  return {};
}

Result<size_t> NpzWriter::begin(const std::string& name, DType dtype, const Shape& row) {
  const std::string& path = state_->file.path();
  if (state_->has(name)) return member_error(path, name, "is added twice");
  PendingMember member;
  member.name = name;
  member.header = {dtype, false, row};
  Result<uint64_t> row_bytes = npy_data_bytes(member.header);
  if (!row_bytes) return member_error(path, name, row_bytes.error().message);
  Result<File> spool = open_spool(path);
  if (!spool) return spool.error();
  member.row_bytes = *row_bytes;
  member.spool = std::move(*spool);
  state_->members.push_back(std::move(member));
  return state_->members.size() - 1;
}

Result<void> NpzWriter::append(size_t member_index, std::span<const std::byte> bytes) {
  PendingMember& member = state_->members[member_index];
  Result<void> done =
      member.spool.write_at(kSpoolHeaderBytes + member.spooled, bytes, state_->file.path());
  if (!done) return done;
  member.spooled += bytes.size();
  // A row without bytes (a frame without bodies) still counts as a row.
  member.rows = member.row_bytes == 0 ? member.rows + 1 : member.spooled / member.row_bytes;
  return {};
}

// Sets the first extent, which is now known, and writes the header into its reserved bytes.
Result<void> NpzWriter::State::complete_spool(PendingMember& member) const {
  if (member.rows * member.row_bytes != member.spooled) {
    return error(member, "holds " + std::to_string(member.spooled) +
                             " bytes, which is no whole number of rows of shape " +
                             shape_text(member.header.shape));
  }
  Shape& shape = member.header.shape;
  shape.insert(shape.begin(), member.rows);
  const std::string text = print_npy_header(member.header, kSpoolHeaderBytes);
  return member.spool.write_at(0, std::as_bytes(std::span(text.data(), text.size())), file.path());
}

Result<void> NpzWriter::State::add_to(zip_t* archive, PendingMember& member) const {
  zip_source_t* source = nullptr;
  if (member.spool) {
    Result<void> completed = complete_spool(member);
    if (!completed) return completed;
    std::FILE* stream = ::fdopen(member.spool.descriptor(), "rb");
    if (stream == nullptr) return system_error(file.path(), "cannot be written", errno);
    member.spool.release();  // the stream owns it now, and the source below owns the stream
    source = zip_source_filep(archive, stream, 0, -1);
    if (source == nullptr) std::fclose(stream);
  } else {
    source = zip_source_buffer(archive, member.bytes.data(), member.bytes.size(), 0);
  }
  if (source == nullptr) return error(member, zip_strerror(archive));
  const zip_int64_t index =
      zip_file_add(archive, (member.name + ".npy").c_str(), source, ZIP_FL_ENC_UTF_8);
  if (index < 0) {
    zip_source_free(source);
    return error(member, zip_strerror(archive));
  }
  const auto entry = static_cast<zip_uint64_t>(index);
  const zip_int32_t method = compression == Compression::kStored ? ZIP_CM_STORE : ZIP_CM_DEFLATE;
  if (zip_set_file_compression(archive, entry, method, 0) != 0 ||
      zip_file_set_dostime(archive, entry, 0, kDosDate, 0) != 0) {
    return error(member, zip_strerror(archive));
  }
  return {};
}

Result<void> NpzWriter::finish() {
  const std::string& path = state_->file.path();
  if (state_->members.empty()) return file_error(path, "would hold no array");
  ZipTarget target(state_->file);
  std::unique_ptr<zip_t, ZipDiscard> archive(target.open());
  if (!archive) return file_error(path, "cannot be written: libzip cannot start an archive");
  for (PendingMember& member : state_->members) {
    Result<void> added = state_->add_to(archive.get(), member);
    if (!added) return added;
  }
  if (zip_close(archive.get()) != 0) {
    if (target.failure()) return *target.failure();
    return file_error(path, std::string("cannot be written: ") + zip_strerror(archive.get()));
  }
  (void)archive.release();  // zip_close() has freed it
  return state_->file.commit();
}

}  // namespace carom::io

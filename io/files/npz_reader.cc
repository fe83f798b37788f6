#include <zip.h>

#include <algorithm>
#include <unordered_map>

#include "io/files/npz.h"
#include "io/printable.h"

namespace carom::io {

struct ArchiveClose {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
struct MemberClose {
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};
using OpenMember = std::unique_ptr<zip_file_t, MemberClose>;

struct ArchiveMember {
  zip_uint64_t index = 0;
  uint64_t bytes = 0;  // uncompressed, header included
};

namespace {

// Deflate cannot compress further than this, so a member that claims more is damaged.
constexpr uint64_t kMaxDeflateRatio = 1032;

constexpr const char* kSuffix = ".npy";
constexpr const char* kWhat = "a .npz archive";

std::string bytes_text(uint64_t bytes) { return std::to_string(bytes) + " bytes"; }

// The error in a member's directory entry, or an empty text.
std::string entry_problem(const zip_stat_t& entry, uint64_t archive_bytes) {
  constexpr zip_uint64_t kNeeded = ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE | ZIP_STAT_COMP_METHOD;
  if ((entry.valid & kNeeded) != kNeeded) return "has an incomplete directory entry";
  if ((entry.valid & ZIP_STAT_ENCRYPTION_METHOD) && entry.encryption_method != ZIP_EM_NONE) {
    return "is encrypted (plain data was expected)";
  }
  if (entry.comp_method != ZIP_CM_STORE && entry.comp_method != ZIP_CM_DEFLATE) {
    return "has compression method " + std::to_string(entry.comp_method) +
           " (stored or deflated was expected)";
  }
  const uint64_t limit = entry.comp_method == ZIP_CM_STORE
                             ? entry.comp_size
                             : entry.comp_size * kMaxDeflateRatio + kMaxDeflateRatio;
  if (entry.comp_size > archive_bytes || entry.size > limit) {
    return "is absurdly large: it claims " + bytes_text(entry.size) + " from " +
           bytes_text(entry.comp_size) + " in an archive of " + bytes_text(archive_bytes);
  }
  return {};
}

}  // namespace

Error member_error(const std::string& path, const std::string& name, const std::string& text) {
  return {printable_name(path) + ": member " + printable_name(name) + ": " + printable(text)};
}

struct NpzReader::State {
  std::string path;
  std::unique_ptr<zip_t, ArchiveClose> archive;
  std::vector<std::string> names;
  std::unordered_map<std::string, ArchiveMember> members;

  Result<void> list_members(uint64_t archive_bytes);
};

struct NpzStream::State {
  std::shared_ptr<NpzReader::State> reader;
  std::string name;
  ArchiveMember member;
  OpenMember file;
  NpyHeader header;
  uint64_t header_bytes = 0;
  uint64_t data_bytes = 0;
  uint64_t position = 0;

  Error error(const std::string& text) const { return member_error(reader->path, name, text); }
  Result<void> open();
  Result<void> read_raw(std::byte* out, uint64_t bytes);
  Result<void> read_header();
  Result<void> check_end();
};

Result<void> NpzReader::State::list_members(uint64_t archive_bytes) {
  const zip_int64_t count = zip_get_num_entries(archive.get(), 0);
  for (zip_int64_t i = 0; i < count; ++i) {
    zip_stat_t entry;
    zip_stat_init(&entry);
    const auto index = static_cast<zip_uint64_t>(i);
    if (zip_stat_index(archive.get(), index, 0, &entry) != 0 || entry.name == nullptr) {
      return file_error(path, "entry " + std::to_string(i) + " has no readable directory entry");
    }
    std::string name = entry.name;
    if (!has_extension(name, kSuffix)) continue;
    name.resize(name.size() - std::char_traits<char>::length(kSuffix));
    const std::string problem = entry_problem(entry, archive_bytes);
    if (!problem.empty()) return member_error(path, name, problem);
    if (!members.emplace(name, ArchiveMember{index, entry.size}).second) {
      return member_error(path, name, "is there twice");
    }
    names.push_back(std::move(name));
  }
  return {};
}

NpzReader::NpzReader(std::shared_ptr<State> state) : state_(std::move(state)) {}
NpzReader::NpzReader(NpzReader&&) noexcept = default;
NpzReader& NpzReader::operator=(NpzReader&&) noexcept = default;
NpzReader::~NpzReader() = default;

Result<NpzReader> NpzReader::open(const std::string& path) {
  Result<File> file = File::open(path, kWhat);
  if (!file) return file.error();
  Result<uint64_t> bytes = file->size(path);
  if (!bytes) return bytes.error();
  int code = 0;
  auto state = std::make_shared<State>();
  state->path = path;
  state->archive.reset(zip_open(path.c_str(), ZIP_RDONLY, &code));
  if (!state->archive) {
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    std::string text = std::string("is not a readable zip archive: ") + zip_error_strerror(&error);
    zip_error_fini(&error);
    return file_error(path, text + " (" + kWhat + " was expected)");
  }
  Result<void> listed = state->list_members(*bytes);
  if (!listed) return listed.error();
  return NpzReader(std::move(state));
}

const std::string& NpzReader::path() const { return state_->path; }
const std::vector<std::string>& NpzReader::members() const { return state_->names; }
bool NpzReader::has(const std::string& name) const { return state_->members.contains(name); }

Result<NpyHeader> NpzReader::header(const std::string& name) const {
  Result<NpzStream> opened = stream(name);
  if (!opened) return opened.error();
  return opened->header();
}

Result<NpzStream> NpzReader::stream(const std::string& name) const {
  const auto found = state_->members.find(name);
  if (found == state_->members.end()) return member_error(path(), name, "is missing");
  auto state = std::make_unique<NpzStream::State>();
  state->reader = state_;
  state->name = name;
  state->member = found->second;
  Result<void> opened = state->open();
  if (!opened) return opened.error();
  return NpzStream(std::move(state));
}

Result<NpzStream> NpzReader::stream(const std::string& name, const Expected& expected) const {
  const std::string wanted = std::string(" (") + dtype_name(expected.dtype) + " " +
                             shape_text(expected.shape) + " was expected)";
  if (!has(name)) return member_error(path(), name, "is missing" + wanted);
  Result<NpzStream> opened = stream(name);
  if (!opened) return opened.error();
  const NpyHeader& header = opened->header();
  if (header.dtype != expected.dtype) {
    return member_error(path(), name,
                        std::string("has dtype ") + dtype_name(header.dtype) + wanted);
  }
  if (!shape_matches(header.shape, expected.shape)) {
    return member_error(path(), name, "has shape " + shape_text(header.shape) + wanted);
  }
  return opened;
}

NpzStream::NpzStream() = default;
NpzStream::NpzStream(std::unique_ptr<State> state) : state_(std::move(state)) {}
NpzStream::NpzStream(NpzStream&&) noexcept = default;
NpzStream& NpzStream::operator=(NpzStream&&) noexcept = default;
NpzStream::~NpzStream() = default;

const NpyHeader& NpzStream::header() const { return state_->header; }
uint64_t NpzStream::data_bytes() const { return state_->data_bytes; }
uint64_t NpzStream::bytes_left() const { return state_->data_bytes - state_->position; }
Result<void> NpzStream::rewind() { return state_->open(); }

Result<void> NpzStream::read(std::span<std::byte> out) {
  if (out.size() > bytes_left()) {
    return state_->error("ends " + bytes_text(out.size() - bytes_left()) +
                         " before what was asked");
  }
  Result<void> done = state_->read_raw(out.data(), out.size());
  if (!done) return done;
  state_->position += out.size();
  if (bytes_left() == 0) return state_->check_end();
  return {};
}

Result<void> NpzStream::State::open() {
  zip_t* archive = reader->archive.get();
  file.reset(zip_fopen_index(archive, member.index, 0));
  if (!file) return error(std::string("cannot be read: ") + zip_strerror(archive));
  position = 0;
  return read_header();
}

Result<void> NpzStream::State::read_raw(std::byte* out, uint64_t bytes) {
  while (bytes > 0) {
    const zip_int64_t count = zip_fread(file.get(), out, bytes);
    if (count < 0) {
      return error(std::string("cannot be read: ") + zip_file_strerror(file.get()));
    }
    if (count == 0) return error("is truncated: " + bytes_text(bytes) + " are missing");
    out += count;
    bytes -= static_cast<uint64_t>(count);
  }
  return {};
}

Result<void> NpzStream::State::read_header() {
  if (member.bytes < kNpyPrefixBytes) return error("is too short for a .npy array");
  std::byte prefix_bytes[kNpyPrefixBytes];
  Result<void> done = read_raw(prefix_bytes, kNpyPrefixBytes);
  if (!done) return done;
  Result<NpyPrefix> prefix = parse_npy_prefix(prefix_bytes);
  if (!prefix) return error(prefix.error().message);

  header_bytes = prefix->text_begin + prefix->text_bytes;
  if (header_bytes < kNpyPrefixBytes || header_bytes > member.bytes) {
    return error("has a .npy header of " + bytes_text(header_bytes) + " in " +
                 bytes_text(member.bytes));
  }
  // With version 1 the prefix already holds the first two characters of the text.
  const size_t known = kNpyPrefixBytes - prefix->text_begin;
  std::string text(prefix->text_bytes, ' ');
  std::copy_n(reinterpret_cast<const char*>(prefix_bytes) + prefix->text_begin, known,
              text.begin());
  done = read_raw(reinterpret_cast<std::byte*>(text.data()) + known, text.size() - known);
  if (!done) return done;
  Result<NpyHeader> parsed = parse_npy_dict(text);
  if (!parsed) return error(parsed.error().message);
  if (parsed->fortran_order) return error("is in Fortran order (C order was expected)");
  Result<uint64_t> bytes = npy_data_bytes(*parsed);
  if (!bytes) return error(bytes.error().message);
  header = std::move(*parsed);
  data_bytes = *bytes;
  if (data_bytes != member.bytes - header_bytes) {
    return error("holds " + bytes_text(member.bytes - header_bytes) + " of data (" +
                 bytes_text(data_bytes) + " were expected for shape " + shape_text(header.shape) +
                 " of " + dtype_name(header.dtype) + ")");
  }
  return {};
}

// libzip compares the checksum when it meets the end of the data.
Result<void> NpzStream::State::check_end() {
  std::byte extra;
  const zip_int64_t count = zip_fread(file.get(), &extra, 1);
  if (count < 0) return error(std::string("is damaged: ") + zip_file_strerror(file.get()));
  if (count > 0) return error("holds more data than " + bytes_text(data_bytes));
  return {};
}

}  // namespace carom::io

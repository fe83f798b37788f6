#include "io/recording.h"
#include "io/printable.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace carom::io {
namespace {

constexpr size_t kNameBytes = 128;
constexpr const char* kWhat = "a recording of bounds";

// The first 304 bytes of the file.
struct Header {
  char name[kNameBytes];
  char object_type[kNameBytes];
  int32_t bodies;
  int32_t frames;  // stored frames less one
  int32_t reserved[2];
  float world[kFloatsPerBox];
};
static_assert(sizeof(Header) == 304);

constexpr uint64_t kBoxBytes = kFloatsPerBox * sizeof(float);

std::string padded_text(const char (&text)[kNameBytes]) {
  return printable(std::string(text, strnlen(text, kNameBytes)));
}

void pad_text(const std::string& text, char (&out)[kNameBytes]) { text.copy(out, kNameBytes - 1); }

bool is_finite_box(std::span<const float> box) {
  return std::isfinite(box[0]) && std::isfinite(box[1]) && std::isfinite(box[2]) &&
         std::isfinite(box[4]) && std::isfinite(box[5]) && std::isfinite(box[6]);
}

bool has_finite_box(std::span<const float> boxes) {
  for (size_t i = 0; i < boxes.size(); i += kFloatsPerBox) {
    if (is_finite_box(boxes.subspan(i, kFloatsPerBox))) return true;
  }
  return false;
}

Result<void> check_header(const Header& header, uint64_t file_bytes, const std::string& path) {
  if (header.bodies < 0 || header.frames < 0) {
    return file_error(path, "header holds " + std::to_string(header.bodies) + " bodies and " +
                                std::to_string(header.frames) +
                                " frames (numbers of 0 or more were expected)");
  }
  // 32 * 2^31 * 2^31 overflows 64 bits, so the frames are compared instead of the bytes.
  const uint64_t frame_bytes = kBoxBytes * static_cast<uint64_t>(header.bodies);
  const uint64_t frames = static_cast<uint64_t>(header.frames) + 1;
  const uint64_t data_bytes = file_bytes - sizeof(Header);
  const bool matches = frame_bytes == 0
                           ? data_bytes == 0
                           : data_bytes % frame_bytes == 0 && data_bytes / frame_bytes == frames;
  if (matches) return {};
  return file_error(path, "has " + std::to_string(file_bytes) + " bytes (304 + 32 * " +
                              std::to_string(header.bodies) + " bodies * " +
                              std::to_string(frames) + " frames were expected)");
}

}  // namespace

RecordingReader::RecordingReader(std::string path, File file, RecordingInfo info)
    : path_(std::move(path)), file_(std::move(file)), info_(std::move(info)) {}

Result<RecordingReader> RecordingReader::open(const std::string& path) {
  Result<File> file = File::open(path, kWhat);
  if (!file) return file.error();
  Result<uint64_t> bytes = file->size(path);
  if (!bytes) return bytes.error();
  if (*bytes < sizeof(Header)) {
    return file_error(path, "is truncated: has " + std::to_string(*bytes) + " bytes (a header of " +
                                std::to_string(sizeof(Header)) + " was expected)");
  }
  Header header;
  Result<void> done = file->read_at(0, std::as_writable_bytes(std::span(&header, 1)), path);
  if (!done) return done.error();
  done = check_header(header, *bytes, path);
  if (!done) return done.error();

  RecordingInfo info;
  info.name = padded_text(header.name);
  info.object_type = padded_text(header.object_type);
  info.bodies = static_cast<uint64_t>(header.bodies);
  info.frames = static_cast<uint64_t>(header.frames) + 1;
  std::copy(std::begin(header.world), std::end(header.world), info.world.begin());
  return RecordingReader(path, std::move(*file), std::move(info));
}

Result<void> RecordingReader::read_frame(std::vector<float>& boxes) {
  boxes.resize(info_.bodies * kFloatsPerBox);
  const uint64_t frame_bytes = info_.bodies * kBoxBytes;
  Result<void> done = file_.read_at(sizeof(Header) + next_frame_ * frame_bytes,
                                    std::as_writable_bytes(std::span(boxes)), path_);
  if (!done) return done;
  if (!boxes.empty() && !has_finite_box(boxes)) {
    return file_error(path_, "frame " + std::to_string(next_frame_) +
                                 " holds no finite box (at least one was expected)");
  }
  next_frame_ = (next_frame_ + 1) % info_.frames;
  return {};
}

RecordingWriter::RecordingWriter(AtomicFile file, RecordingInfo info)
    : file_(std::move(file)), info_(std::move(info)) {}

Result<RecordingWriter> RecordingWriter::create(const std::string& path, const std::string& name,
                                                const std::string& object_type, uint64_t bodies) {
  if (bodies > static_cast<uint64_t>(std::numeric_limits<int32_t>::max())) {
    return file_error(path, "cannot hold " + std::to_string(bodies) + " bodies (at most 2^31 - 1)");
  }
  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return file.error();
  RecordingInfo info;
  info.name = name;
  info.object_type = object_type;
  info.bodies = bodies;
  // A blank header; finish() writes the real one.
  const Header blank{};
  Result<void> done = file->write(std::as_bytes(std::span(&blank, 1)));
  if (!done) return done.error();
  return RecordingWriter(std::move(*file), std::move(info));
}

Result<void> RecordingWriter::write_frame(std::span<const float> boxes) {
  if (boxes.size() != info_.bodies * kFloatsPerBox) {
    return file_error(file_.path(), "frame " + std::to_string(info_.frames) + " holds " +
                                        std::to_string(boxes.size()) + " floats (8 for each of " +
                                        std::to_string(info_.bodies) + " bodies were expected)");
  }
  for (size_t i = 0; i < boxes.size(); i += kFloatsPerBox) {
    const std::span<const float> box = boxes.subspan(i, kFloatsPerBox);
    if (!is_finite_box(box)) continue;
    if (!has_bounds_) std::copy(box.begin(), box.end(), info_.world.begin());
    has_bounds_ = true;
    for (size_t axis = 0; axis < 3; ++axis) {
      info_.world[axis] = std::min(info_.world[axis], box[axis]);
      info_.world[4 + axis] = std::max(info_.world[4 + axis], box[4 + axis]);
    }
  }
  ++info_.frames;
  return file_.write(std::as_bytes(boxes));
}

Result<void> RecordingWriter::finish() {
  if (info_.frames == 0 || info_.frames > uint64_t{1} << 31) {
    return file_error(file_.path(), "cannot hold " + std::to_string(info_.frames) +
                                        " frames (1 to 2^31 were expected)");
  }
  Header header{};
  pad_text(info_.name, header.name);
  pad_text(info_.object_type, header.object_type);
  header.bodies = static_cast<int32_t>(info_.bodies);
  header.frames = static_cast<int32_t>(info_.frames - 1);
  std::copy(info_.world.begin(), info_.world.end(), header.world);
  Result<void> done = file_.write_at(0, std::as_bytes(std::span(&header, 1)));
  if (!done) return done;
  return file_.commit();
}

}  // namespace carom::io

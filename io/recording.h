// Recordings of bounds (.aabb, .aabbs): N boxes a frame, read and written frame by frame.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "carom/base/result.h"
#include "io/files/atomic_file.h"
#include "io/files/file.h"

namespace carom::io {

// A box in the file: min x y z 0, max x y z 0.
inline constexpr size_t kFloatsPerBox = 8;

struct RecordingInfo {
  std::string name;  // of the scene
  std::string object_type;
  uint64_t bodies = 0;
  uint64_t frames = 0;                       // stored frames: F + 1
  std::array<float, kFloatsPerBox> world{};  // bounds of everything
};

class RecordingReader {
 public:
  static Result<RecordingReader> open(const std::string& path);

  const RecordingInfo& info() const { return info_; }
  const std::string& path() const { return path_; }

  // Reads the next frame, and the first after the last. Passes on boxes with NaN or min > max, but
  // fails if a frame has boxes and none is finite.
  Result<void> read_frame(std::vector<float>& boxes);

 private:
  RecordingReader(std::string path, File file, RecordingInfo info);

  std::string path_;
  File file_;
  RecordingInfo info_;
  uint64_t next_frame_ = 0;
};

class RecordingWriter {
 public:
  // Names longer than the format's 127 bytes are cut.
  static Result<RecordingWriter> create(const std::string& path, const std::string& name,
                                        const std::string& object_type, uint64_t bodies);

  // 8 floats a box.
  Result<void> write_frame(std::span<const float> boxes);
  // Writes the header (frame count, bounds of all finite boxes) and gives the file its name.
  Result<void> finish();

 private:
  RecordingWriter(AtomicFile file, RecordingInfo info);

  AtomicFile file_;
  RecordingInfo info_;
  bool has_bounds_ = false;  // info_.world holds a box
};

}  // namespace carom::io

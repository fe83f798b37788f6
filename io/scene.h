// Scenes (.npz) and recordings of bounds (.aabb, .aabbs) behind one interface that streams frames.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "carom/base/result.h"
#include "io/shape_arrays.h"

namespace carom::io {

// The data that all frames share. Optional arrays are empty if absent.
struct SceneInfo {
  std::string name;
  uint64_t bodies = 0;
  uint64_t frames = 0;            // stored frames; for a recording F + 1
  bool bounds_recording = false;  // no shapes, frames hold boxes
  bool float64_positions = false;
  bool has_orientation = false;
  bool has_linear_velocity = false;
  bool has_angular_velocity = false;
  double dt = 1.0 / 60.0;
  SceneShapes shapes;
  std::vector<uint32_t> body_shape;
  std::vector<uint8_t> body_motion;  // 0 static, 1 kinematic, 2 dynamic; empty: all dynamic
  std::vector<uint32_t> layer;
  std::vector<uint32_t> mask;
  std::vector<uint32_t> owner;
  std::vector<uint32_t> space;
  std::vector<uint8_t> sensor;
  std::vector<float> contact_distance;                  // metres, >= 0
  std::vector<std::array<uint32_t, 2>> excluded_pairs;  // a < b, in any order
};

// Checks shapes, indices, flags and dt; `path` is for the message.
Result<void> check_scene(const SceneInfo& info, const std::string& path);

// One frame. Arrays that the scene lacks or the caller did not want are empty.
struct SceneFrame {
  std::vector<float> position32;   // 3 a body, or
  std::vector<double> position64;  // if SceneInfo::float64_positions
  std::vector<float> orientation;  // 4 a body
  std::vector<float> linear_velocity;
  std::vector<float> angular_velocity;
  std::vector<float> boxes;  // recordings: min x y z 0, max x y z 0 a body
};

// The arrays of a frame that the caller reads; others are neither inflated nor stored.
struct SceneArrays {
  bool orientation = true;
  bool linear_velocity = true;
  bool angular_velocity = true;
};

class SceneReader {
 public:
  virtual ~SceneReader() = default;
  virtual const SceneInfo& info() const = 0;
  // Limits the arrays that read_frame() fills. Call it before the first read_frame(), after info()
  // has shown which arrays the scene has.
  virtual void want(const SceneArrays& wanted) = 0;
  // Reads the next frame into the same buffers, and the first after the last. NaN is passed on, but
  // fails if an array of this frame has no finite value.
  virtual Result<void> read_frame(SceneFrame& frame) = 0;
};

// Opens a scene or a recording by its extension. With another extension, a zip archive is read as a
// scene.
Result<std::unique_ptr<SceneReader>> open_scene(const std::string& path,
                                                const SceneArrays& wanted = {});

// Writes a scene frame by frame. The file appears at finish() only.
class SceneWriter {
 public:
  // `info` says what every frame will hold (float64_positions, has_*); `frames` and `name` are not
  // used. Checks `info` as a reader would.
  static Result<SceneWriter> create(const std::string& path, const SceneInfo& info,
                                    Compression compression = Compression::kStored);

  Result<void> write_frame(const SceneFrame& frame);
  Result<void> finish();

 private:
  struct Column {
    const char* name;
    bool present;
    size_t member;  // index in the archive
    size_t values;  // in one frame
  };
  SceneWriter(std::string path, NpzWriter writer);
  Result<void> add_column(const char* name, bool present, DType dtype, uint64_t bodies,
                          uint64_t width);
  template <class T>
  Result<void> append(const Column& column, const std::vector<T>& values);

  std::string path_;
  NpzWriter writer_;
  bool float64_positions_ = false;
  std::vector<Column> columns_;  // position, orientation, linear and angular velocity
  uint64_t frames_ = 0;
};

}  // namespace carom::io

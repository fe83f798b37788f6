#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "io/models/read_model.h"
#include "io/recording.h"
#include "io/scene.h"

namespace carom::io {
namespace {

template <class T>
bool has_finite_value(std::span<const T> values) {
  return values.empty() ||
         std::any_of(values.begin(), values.end(), [](T value) { return std::isfinite(value); });
}

class RecordingScene final : public SceneReader {
 public:
  explicit RecordingScene(RecordingReader reader) : reader_(std::move(reader)) {
    const RecordingInfo& recording = reader_.info();
    info_.name = recording.name.empty() ? stem_of(reader_.path()) : recording.name;
    info_.bodies = recording.bodies;
    info_.frames = recording.frames;
    info_.bounds_recording = true;
  }

  const SceneInfo& info() const override { return info_; }
  void want(const SceneArrays&) override {}  // a recording has boxes only

  Result<void> read_frame(SceneFrame& frame) override { return reader_.read_frame(frame.boxes); }

 private:
  RecordingReader reader_;
  SceneInfo info_;
};

// Reads the arrays that all frames share.
class InfoParser {
 public:
  explicit InfoParser(const NpzReader& reader) : reader_(reader) {}

  Result<SceneInfo> parse() {
    Result<void> result = check_version(reader_, true);
    if (result) result = read_layout();
    if (result) result = read_shape_arrays();
    if (result) result = read_bodies();
    if (result) result = read_dt();
    if (result) result = check_scene(info_, reader_.path());
    if (!result) return result.error();
    info_.name = stem_of(reader_.path());
    return std::move(info_);
  }

 private:
  // Reads the numbers of frames and bodies, and which arrays a frame has.
  Result<void> read_layout() {
    const std::string expected = " (float32 or float64 (any, any, 3) was expected)";
    if (!reader_.has("position")) {
      return member_error(reader_.path(), "position", "is missing" + expected);
    }
    Result<NpyHeader> header = reader_.header("position");
    if (!header) return header.error();
    if (header->dtype != DType::kFloat32 && header->dtype != DType::kFloat64) {
      return member_error(reader_.path(), "position",
                          std::string("has dtype ") + dtype_name(header->dtype) + expected);
    }
    if (!shape_matches(header->shape, {kAny, kAny, 3})) {
      return member_error(reader_.path(), "position",
                          "has shape " + shape_text(header->shape) + expected);
    }
    info_.frames = header->shape[0];
    info_.bodies = header->shape[1];
    info_.float64_positions = header->dtype == DType::kFloat64;
    if (info_.frames == 0) {
      return member_error(reader_.path(), "position", "holds no frame (at least 1 was expected)");
    }
    Result<void> result = find_column("orientation", 4, info_.has_orientation);
    if (result) result = find_column("linear_velocity", 3, info_.has_linear_velocity);
    if (result) result = find_column("angular_velocity", 3, info_.has_angular_velocity);
    return result;
  }

  Result<void> find_column(const char* name, uint64_t width, bool& found) {
    found = reader_.has(name);
    if (!found) return {};
    Result<NpzStream> stream =
        reader_.stream(name, {DType::kFloat32, {info_.frames, info_.bodies, width}});
    if (!stream) return stream.error();
    return {};
  }

  Result<void> read_shape_arrays() {
    Result<SceneShapes> shapes = read_shapes(reader_);
    if (!shapes) return shapes.error();
    info_.shapes = std::move(*shapes);
    Result<void> result = check_finite("shape_params", info_.shapes.params);
    if (result) result = check_finite("vertices", info_.shapes.vertices);
    return result;
  }

  template <size_t kWidth>
  Result<void> check_finite(const char* name,
                            const std::vector<std::array<float, kWidth>>& values) {
    const auto row_has_finite = [](const std::array<float, kWidth>& row) {
      return has_finite_value(std::span<const float>(row));
    };
    if (values.empty() || std::any_of(values.begin(), values.end(), row_has_finite)) return {};
    return member_error(reader_.path(), name, "holds no finite value");
  }

  Result<void> read_bodies() {
    Result<std::vector<uint32_t>> body_shape = reader_.read<uint32_t>("body_shape", {info_.bodies});
    if (!body_shape) return body_shape.error();
    info_.body_shape = std::move(*body_shape);
    Result<void> result = read_per_body("body_motion", info_.body_motion);
    if (result) result = read_per_body("body_layer", info_.layer);
    if (result) result = read_per_body("body_mask", info_.mask);
    if (result) result = read_per_body("body_owner", info_.owner);
    if (result) result = read_per_body("body_space", info_.space);
    if (result) result = read_per_body("body_sensor", info_.sensor);
    if (result) result = read_per_body("body_contact_distance", info_.contact_distance);
    if (result) result = read_optional("excluded_pairs", kAny, info_.excluded_pairs);
    return result;
  }

  template <class T>
  Result<void> read_per_body(const char* name, std::vector<T>& out) {
    return read_optional(name, info_.bodies, out);
  }

  template <class T>
  Result<void> read_optional(const char* name, uint64_t rows, std::vector<T>& out) {
    if (!reader_.has(name)) return {};
    Result<std::vector<T>> values = reader_.read<T>(name, {rows});
    if (!values) return values.error();
    out = std::move(*values);
    return {};
  }

  Result<void> read_dt() {
    if (!reader_.has("dt")) return {};
    Result<std::vector<double>> dt = reader_.read<double>("dt", {1});
    if (!dt) return dt.error();
    info_.dt = dt->front();
    return {};
  }

  const NpzReader& reader_;
  SceneInfo info_;
};

class NpzScene final : public SceneReader {
 public:
  NpzScene(NpzReader reader, SceneInfo info, const SceneArrays& wanted)
      : reader_(std::move(reader)), info_(std::move(info)), wanted_(wanted) {}

  const SceneInfo& info() const override { return info_; }
  void want(const SceneArrays& wanted) override { wanted_ = wanted; }

  Result<void> read_frame(SceneFrame& frame) override {
    if (failure_) return *failure_;
    Result<void> done = next_frame_ == 0 ? start() : Result<void>();
    if (done) done = read_columns(frame);
    // After an error the streams may be anywhere inside a frame, so every later call returns the
    // same error.
    if (!done) failure_ = done.error();
    next_frame_ = (next_frame_ + 1) % info_.frames;
    return done;
  }

 private:
  Result<void> start() {
    Result<void> done = start_stream("position", true, position_);
    if (done) {
      done =
          start_stream("orientation", info_.has_orientation && wanted_.orientation, orientation_);
    }
    if (done) {
      done = start_stream("linear_velocity", info_.has_linear_velocity && wanted_.linear_velocity,
                          linear_velocity_);
    }
    if (done) {
      done =
          start_stream("angular_velocity", info_.has_angular_velocity && wanted_.angular_velocity,
                       angular_velocity_);
    }
    return done;
  }

  Result<void> start_stream(const char* name, bool used, std::optional<NpzStream>& stream) {
    if (!used) return {};
    if (stream) return stream->rewind();
    Result<NpzStream> opened = reader_.stream(name);
    if (!opened) return opened.error();
    stream = std::move(*opened);
    return {};
  }

  Result<void> read_columns(SceneFrame& frame) {
    Result<void> done = info_.float64_positions
                            ? read_column("position", position_, 3, frame.position64)
                            : read_column("position", position_, 3, frame.position32);
    if (done) done = read_column("orientation", orientation_, 4, frame.orientation);
    if (done) done = read_column("linear_velocity", linear_velocity_, 3, frame.linear_velocity);
    if (done) done = read_column("angular_velocity", angular_velocity_, 3, frame.angular_velocity);
    return done;
  }

  template <class T>
  Result<void> read_column(const char* name, std::optional<NpzStream>& stream, uint64_t width,
                           std::vector<T>& values) {
    values.resize(stream ? info_.bodies * width : 0);
    if (!stream) return {};
    Result<void> done = stream->read(std::as_writable_bytes(std::span(values)));
    if (!done) return done;
    if (has_finite_value(std::span<const T>(values))) return {};
    return member_error(reader_.path(), name,
                        "frame " + std::to_string(next_frame_) +
                            " holds no finite value (at least one was expected)");
  }

  NpzReader reader_;
  SceneInfo info_;
  SceneArrays wanted_;
  std::optional<NpzStream> position_;
  std::optional<NpzStream> orientation_;
  std::optional<NpzStream> linear_velocity_;
  std::optional<NpzStream> angular_velocity_;
  uint64_t next_frame_ = 0;
  std::optional<Error> failure_;
};

Result<std::unique_ptr<SceneReader>> open_recording_scene(const std::string& path) {
  Result<RecordingReader> recording = RecordingReader::open(path);
  if (!recording) return recording.error();
  return std::unique_ptr<SceneReader>(std::make_unique<RecordingScene>(std::move(*recording)));
}

Result<std::unique_ptr<SceneReader>> open_npz_scene(const std::string& path,
                                                    const SceneArrays& wanted) {
  Result<NpzReader> reader = NpzReader::open(path);
  if (!reader) return reader.error();
  Result<SceneInfo> info = InfoParser(*reader).parse();
  if (!info) return info.error();
  return std::unique_ptr<SceneReader>(
      std::make_unique<NpzScene>(std::move(*reader), std::move(*info), wanted));
}

Result<bool> is_zip(const std::string& path) {
  Result<File> file = File::open(path, "a scene or a recording of bounds");
  if (!file) return file.error();
  Result<uint64_t> size = file->size(path);
  if (!size) return size.error();
  char magic[2] = {};
  if (*size < sizeof(magic)) return false;
  Result<void> done = file->read_at(0, std::as_writable_bytes(std::span(magic)), path);
  if (!done) return done.error();
  return magic[0] == 'P' && magic[1] == 'K';
}

}  // namespace

Result<std::unique_ptr<SceneReader>> open_scene(const std::string& path,
                                                const SceneArrays& wanted) {
  if (has_extension(path, ".aabb") || has_extension(path, ".aabbs")) {
    return open_recording_scene(path);
  }
  if (has_extension(path, ".npz")) return open_npz_scene(path, wanted);
  if (names_model(path)) return open_model(path, wanted);
  Result<bool> zip = is_zip(path);
  if (!zip) return zip.error();
  if (*zip) return open_npz_scene(path, wanted);
  return file_error(
      path,
      "is of no known kind (a scene .npz, a recording .aabb or .aabbs, or a model .urdf "
      "or .xml was expected)");
}

}  // namespace carom::io

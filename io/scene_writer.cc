#include <span>

#include "io/scene.h"

namespace carom::io {
namespace {

template <class T>
Result<void> write_optional(NpzWriter& writer, const char* name, const std::vector<T>& values) {
  if (values.empty()) return {};
  return writer.add(name, values);
}

Result<void> write_constants(const SceneInfo& info, NpzWriter& writer) {
  Result<void> result = write_version(writer);
  if (result) result = write_shapes(info.shapes, writer);
  if (result) result = writer.add("body_shape", info.body_shape);
  if (result) result = write_optional(writer, "body_motion", info.body_motion);
  if (result) result = write_optional(writer, "body_layer", info.layer);
  if (result) result = write_optional(writer, "body_mask", info.mask);
  if (result) result = write_optional(writer, "body_owner", info.owner);
  if (result) result = write_optional(writer, "body_space", info.space);
  if (result) result = write_optional(writer, "body_sensor", info.sensor);
  if (result) result = write_optional(writer, "body_contact_distance", info.contact_distance);
  if (result) result = write_optional(writer, "excluded_pairs", info.excluded_pairs);
  if (result) result = writer.add("dt", std::vector<double>{info.dt});
  return result;
}

}  // namespace

SceneWriter::SceneWriter(std::string path, NpzWriter writer)
    : path_(std::move(path)), writer_(std::move(writer)) {}

Result<SceneWriter> SceneWriter::create(const std::string& path, const SceneInfo& info,
                                        Compression compression) {
  if (info.bounds_recording) {
    return file_error(path, "cannot hold a recording of bounds (a scene with shapes was expected)");
  }
  Result<void> result = check_scene(info, path);
  if (!result) return result.error();
  Result<NpzWriter> npz = NpzWriter::create(path, compression);
  if (!npz) return npz.error();
  SceneWriter writer(path, std::move(*npz));
  writer.float64_positions_ = info.float64_positions;

  result = write_constants(info, writer.writer_);
  const DType position = info.float64_positions ? DType::kFloat64 : DType::kFloat32;
  if (result) result = writer.add_column("position", true, position, info.bodies, 3);
  if (result) {
    result =
        writer.add_column("orientation", info.has_orientation, DType::kFloat32, info.bodies, 4);
  }
  if (result) {
    result = writer.add_column("linear_velocity", info.has_linear_velocity, DType::kFloat32,
                               info.bodies, 3);
  }
  if (result) {
    result = writer.add_column("angular_velocity", info.has_angular_velocity, DType::kFloat32,
                               info.bodies, 3);
  }
  if (!result) return result.error();
  return writer;
}

Result<void> SceneWriter::add_column(const char* name, bool present, DType dtype, uint64_t bodies,
                                     uint64_t width) {
  columns_.push_back({name, present, 0, bodies * width});
  if (!present) return {};
  Result<size_t> member = writer_.begin(name, dtype, {bodies, width});
  if (!member) return member.error();
  columns_.back().member = *member;
  return {};
}

template <class T>
Result<void> SceneWriter::append(const Column& column, const std::vector<T>& values) {
  if (!column.present) return {};
  if (values.size() != column.values) {
    return member_error(path_, column.name,
                        "frame " + std::to_string(frames_) + " holds " +
                            std::to_string(values.size()) + " values (" +
                            std::to_string(column.values) + " were expected)");
  }
  return writer_.append(column.member, std::as_bytes(std::span(values)));
}

Result<void> SceneWriter::write_frame(const SceneFrame& frame) {
  Result<void> result = float64_positions_ ? append(columns_[0], frame.position64)
                                           : append(columns_[0], frame.position32);
  if (result) result = append(columns_[1], frame.orientation);
  if (result) result = append(columns_[2], frame.linear_velocity);
  if (result) result = append(columns_[3], frame.angular_velocity);
  if (result) ++frames_;
  return result;
}

Result<void> SceneWriter::finish() {
  if (frames_ == 0) return file_error(path_, "would hold no frame");
  return writer_.finish();
}

}  // namespace carom::io

#include "cli/scenes/player.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "cli/scenes/shapes.h"
#include "io/recording.h"

namespace carom::cli {
namespace {

// Copies rows of 3 into records of 4; the fourth number stays.
template <class T>
void write_positions(const std::vector<T>& rows, T* records) {
  for (size_t i = 0; i < rows.size() / 3; ++i) {
    for (size_t axis = 0; axis < 3; ++axis) records[4 * i + axis] = rows[3 * i + axis];
  }
}

void write(const std::vector<float>& rows, std::span<Eigen::Vector3f> vectors) {
  for (size_t i = 0; i < rows.size() / 3; ++i) {
    vectors[i] = Eigen::Map<const Eigen::Vector3f>(&rows[3 * i]);
  }
}

std::vector<Pair> sorted_pairs(const std::vector<std::array<uint32_t, 2>>& rows) {
  std::vector<Pair> pairs;
  pairs.reserve(rows.size());
  for (const auto& [a, b] : rows) pairs.push_back({a, b});
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace

Player::Player(const io::SceneInfo& info, std::vector<Shape> shapes)
    : info_(&info),
      shapes_(std::move(shapes)),
      excluded_(sorted_pairs(info.excluded_pairs)),
      oriented_(reads_orientations()) {}

Result<Player> Player::create(const io::SceneInfo& info, const std::string& source) {
  const std::vector<uint8_t>& kinds = info.shapes.kind;
  if (info.shapes.scale.empty() && std::all_of(kinds.begin(), kinds.end(), is_its_parameters))
    return Player(info, {});
  Result<std::vector<Shape>> shapes = convert_shapes(info.shapes, source);
  if (!shapes) return shapes.error();
  return Player(info, std::move(*shapes));
}

Result<std::vector<LadderReport>> Player::add_ladders(std::span<const double> errors) {
  std::vector<LadderReport> reports;
  for (Shape& shape : shapes_) {
    if (!has_geometry(kind_of(shape))) continue;
    Result<LadderedShape> laddered = build_ladder(shape, errors);
    if (!laddered) continue;  // a shape that is not valid stays so
    shape = std::move(laddered->shape);
    reports.push_back(std::move(laddered->report));
  }
  return reports;
}

Shape Player::scene_shape(size_t index) const {
  return shapes_.empty() ? *convert_simple_shape(info_->shapes, index) : shapes_[index];
}

// Whether orientations matter: spheres and aabbs ignore them.
bool Player::reads_orientations() const {
  return info_->has_orientation &&
         std::any_of(info_->body_shape.begin(), info_->body_shape.end(),
                     [&](uint32_t shape) { return row_count(kind_of(scene_shape(shape))) > 0; });
}

PositionType Player::positions() const {
  return info_->float64_positions ? PositionType::float64 : PositionType::float32;
}

BodiesOfKind Player::bodies_of_kind() const {
  BodiesOfKind bodies{};
  if (info_->bounds_recording) bodies[static_cast<size_t>(ShapeKind::aabb)] = info_->bodies;
  for (const uint32_t shape : info_->body_shape) {
    ++bodies[static_cast<size_t>(kind_of(scene_shape(shape)))];
  }
  return bodies;
}

io::SceneArrays Player::wanted(Detail detail, bool looks_ahead) const {
  return {.orientation = oriented_,
          .linear_velocity = detail >= Detail::contact || looks_ahead,
          .angular_velocity = detail >= Detail::contact || looks_ahead};
}

Shape Player::shape(const io::SceneFrame& frame, size_t index) const {
  if (!info_->bounds_recording) return scene_shape(info_->body_shape[index]);
  const float* box = &frame.boxes[io::kFloatsPerBox * index];
  return Aabb{{box[0], box[1], box[2]}, {box[4], box[5], box[6]}};
}

BodyDesc Player::body(const io::SceneFrame& frame, size_t index) const {
  BodyDesc desc;
  desc.shape = shape(frame, index);
  if (!frame.position32.empty()) {
    desc.position = Eigen::Map<const Eigen::Vector3f>(&frame.position32[3 * index]).cast<double>();
  } else if (!frame.position64.empty()) {
    desc.position = Eigen::Map<const Eigen::Vector3d>(&frame.position64[3 * index]);
  }
  if (oriented_) desc.orientation = Eigen::Quaternionf(&frame.orientation[4 * index]);
  if (!frame.linear_velocity.empty()) {
    desc.linear_velocity = Eigen::Map<const Eigen::Vector3f>(&frame.linear_velocity[3 * index]);
  }
  if (!frame.angular_velocity.empty()) {
    desc.angular_velocity = Eigen::Map<const Eigen::Vector3f>(&frame.angular_velocity[3 * index]);
  }
  if (!info_->body_motion.empty()) desc.motion = static_cast<Motion>(info_->body_motion[index]);
  if (!info_->layer.empty()) desc.layer = info_->layer[index];
  if (!info_->mask.empty()) desc.mask = info_->mask[index];
  if (!info_->owner.empty()) desc.owner = info_->owner[index];
  if (!info_->space.empty()) desc.space = info_->space[index];
  if (!info_->sensor.empty()) desc.sensor = info_->sensor[index] != 0;
  if (!info_->contact_distance.empty()) desc.contact_distance = info_->contact_distance[index];
  desc.user = index;
  return desc;
}

void Player::start(const io::SceneFrame& frame, World& world, Detection detection) const {
  constexpr size_t kChunk = 4096;
  std::vector<BodyDesc> bodies;
  std::vector<BodyId> ids;
  for (size_t first = 0; first < info_->bodies; first += kChunk) {
    bodies.clear();
    ids.clear();
    size_t end = std::min<size_t>(first + kChunk, info_->bodies);
    for (size_t i = first; i < end; ++i) {
      bodies.push_back(body(frame, i));
      if (bodies.back().motion == Motion::dynamic) bodies.back().detection = detection;
    }
    world.add(bodies, ids);
  }
  world.exclude(excluded_);
  write_velocities(frame, world);
}

void Player::move(const io::SceneFrame& frame, World& world) const {
  if (info_->bounds_recording) {
    write_boxes(frame, world);
    return;
  }
  BodyArrays arrays = world.arrays();
  if (info_->float64_positions) {
    write_positions(frame.position64, arrays.record64);
  } else {
    write_positions(frame.position32, arrays.record32);
  }
  write_orientations(frame, world);
  write_velocities(frame, world);
}

void Player::write_boxes(const io::SceneFrame& frame, World& world) const {
  BoxArrays boxes = world.boxes();
  for (size_t i = 0; i < info_->bodies; ++i) {
    uint32_t slot = world.box_slot(world.id_of(static_cast<uint32_t>(i)));
    const float* box = &frame.boxes[io::kFloatsPerBox * i];
    std::copy_n(box, 3, boxes.lower(slot));
    std::copy_n(box + 4, 3, boxes.upper(slot));
  }
}

void Player::write_orientations(const io::SceneFrame& frame, World& world) const {
  if (!oriented_) return;
  std::copy(frame.orientation.begin(), frame.orientation.end(), world.arrays().orientation);
}

void Player::write_velocities(const io::SceneFrame& frame, World& world) const {
  if (!frame.linear_velocity.empty()) write(frame.linear_velocity, world.linear_velocities());
  if (!frame.angular_velocity.empty()) write(frame.angular_velocity, world.angular_velocities());
}

}  // namespace carom::cli

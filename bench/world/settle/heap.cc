#include "bench/world/settle/heap.h"

#include <cstddef>
#include <cstdint>
#include <variant>

#include "carom/reference/reference.h"
#include "carom/shapes/views.h"
#include "examples/rigid_scenes.h"

namespace carom::bench {
namespace {

// Triangles and flat boxes have no volume, but a body that moves needs a mass.
constexpr float kLeastHalf = 1e-3f;  // metres

bool moves(const BodyDesc& body) {
  return body.motion == Motion::dynamic && !body.sensor &&
         kind_of(body.shape) != ShapeKind::halfspace;
}

// A ball, or the box of the local bounds. The solver takes the position as the centre of mass.
rigid::Mass mass_of(const Shape& shape) {
  if (const auto* ball = std::get_if<Sphere>(&shape); ball && ball->radius > 0) {
    return rigid::mass_of_ball(ball->radius);
  }
  const reference::Box box = reference::bounds(shape, Pose{}, PositionType::float32);
  rigid::Mass mass = rigid::mass_of_box((0.5f * (box.upper - box.lower)).cwiseMax(kLeastHalf));
  // An aabb does not turn, whatever pushes it.
  if (kind_of(shape) == ShapeKind::aabb) mass.inertia *= 1e12f;
  return mass;
}

WorldSettings world_settings(const cli::Player& player) {
  return {.positions = player.positions(), .events = false};
}

void append(std::vector<float>& values, const Eigen::Vector3f& vector) {
  values.insert(values.end(), vector.data(), vector.data() + 3);
}

}  // namespace

Eigen::Vector3f find_down(const cli::Player& player, const io::SceneFrame& first,
                          const io::SceneFrame& last) {
  Eigen::Vector3d way = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < player.info().bodies; ++i) {
    const BodyDesc body = player.body(last, i);
    if (moves(body)) way += body.position - player.body(first, i).position;
  }
  return way.y() < 0 && way.y() < way.z() ? -Eigen::Vector3f::UnitY() : -Eigen::Vector3f::UnitZ();
}

Heap::Heap(const cli::Player& player, const io::SceneFrame& start,
           const rigid::SolverSettings& settings)
    : solver_(settings, world_settings(player)) {
  for (size_t i = 0; i < player.info().bodies; ++i) {
    add(player.body(start, i));
    orientation_.push_back(start.orientation.empty()
                               ? Eigen::Quaternionf::Identity()
                               : Eigen::Quaternionf(&start.orientation[4 * i]));
  }
  solver_.world().exclude(player.excluded());
}

void Heap::add(const BodyDesc& body) {
  if (moves(body)) {
    moving_.push_back(solver_.add(body, mass_of(body.shape)));
    return;
  }
  BodyDesc standing = body;
  standing.linear_velocity.setZero();
  standing.angular_velocity.setZero();
  solver_.add(standing);
}

void Heap::step() {
  solver_.step();
  for (const BodyId id : moving_) {
    Eigen::Quaternionf& orientation = orientation_[id.index];
    if (row_count(kind_of(world().shape(id))) > 0) {
      orientation = world().orientation(id);
    } else {
      orientation = (solver_.bodies()[id.index].turned * orientation).normalized();
    }
  }
}

void Heap::write(io::SceneFrame& frame) const {
  frame = {};
  for (uint32_t i = 0; i < world().size(); ++i) {
    const Eigen::Vector3d position = world().position(world().id_of(i));
    if (world().settings().positions == PositionType::float64) {
      frame.position64.insert(frame.position64.end(), position.begin(), position.end());
    } else {
      append(frame.position32, position.cast<float>());
    }
    const auto& coefficients = orientation_[i].coeffs();
    frame.orientation.insert(frame.orientation.end(), coefficients.begin(), coefficients.end());
    append(frame.linear_velocity, solver_.bodies()[i].velocity);
    append(frame.angular_velocity, solver_.bodies()[i].spin);
  }
}

}  // namespace carom::bench

// Bodies: a collidable is a shape with a pose and the few properties that decide whom it meets.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <compare>
#include <cstdint>

#include "carom/shapes/shape.h"

namespace carom {

// Names a body for as long as it lives: an index is used again after removal, with the next
// generation, so an old id never names a newer body.
struct BodyId {
  uint32_t index = 0xffffffffu;
  uint32_t generation = 0;

  friend auto operator<=>(const BodyId&, const BodyId&) = default;
};

enum class Motion : uint8_t { fixed = 0, kinematic = 1, dynamic = 2 };

// How a body is looked after between this step and the next, by World. The interval that a step
// looks ahead over is WorldSettings::dt, and a body's motion in it is velocity x dt.
enum class Detection : uint8_t {
  discrete,    // as it is now, and no other way
  swept,       // a candidate with everything it may reach; near ones are speculative contacts
  continuous,  // and when it meets each of them is found: impacts
  automatic,   // each step continuous if it moves far for its size, otherwise discrete
};

// Storage of positions, chosen once a world (or a call) from what the scene needs.
enum class PositionType : uint8_t { float32, float64 };

// Where a body is: x of its own frame is at position + R x of the world. The orientation need not
// be a unit quaternion (R = M(q) / |q|^2), but not zero; spheres and aabbs ignore it.
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // world frame, metres
  Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity();
};

// Two bodies may meet if each one's layer is in the other's mask, they do not share a non-zero
// owner, and not both are fixed (static).
struct BodyDesc {
  Shape shape = Sphere{};
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               // world frame, metres
  Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity();  // as in Pose
  Eigen::Vector3f linear_velocity = Eigen::Vector3f::Zero();        // world frame, metres a second
  Eigen::Vector3f angular_velocity = Eigen::Vector3f::Zero();       // world frame, radians a second
  Motion motion = Motion::dynamic;
  Detection detection = Detection::discrete;
  uint32_t layer = 0xffffffffu;
  uint32_t mask = 0xffffffffu;
  uint32_t owner = 0;   // 0: none
  bool sensor = false;  // reports overlap and events, never contacts
  uint64_t user = 0;    // handed back untouched
};

}  // namespace carom

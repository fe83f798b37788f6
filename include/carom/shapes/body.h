/// @file
/// Bodies: a shape with a pose, a velocity and the properties that decide which bodies it may meet.
#pragma once

#include <Eigen/Core>
#include <compare>
#include <cstdint>
#include <optional>

#include "carom/shapes/orientation.h"
#include "carom/shapes/shape.h"

namespace carom {

/// Names a body for as long as it lives. An index is used again after removal, with the next
/// generation, so an old id never names a newer body.
struct BodyId {
  uint32_t index = 0xffffffffu;  ///< row of the body; the default names no body
  uint32_t generation = 0;       ///< how often the index was used before

  /// Orders by (index, generation).
  friend auto operator<=>(const BodyId&, const BodyId&) = default;
};

/// Who moves a body. Two fixed bodies are never paired; Carom treats the other two alike.
enum class Motion : uint8_t {
  fixed = 0,      ///< nobody: it is static
  kinematic = 1,  ///< the caller, whatever the body meets
  dynamic = 2     ///< the caller's dynamics, which contacts change
};

/// How World looks after a body between this step and the next. A step looks ahead over the
/// interval WorldSettings::dt, in which a body moves by velocity x dt.
enum class Detection : uint8_t {
  discrete,    ///< only as it is now
  swept,       ///< paired with all it may reach; those that come near are speculative contacts
  continuous,  ///< also finds when it meets each of them: impacts
  automatic,   ///< in each step continuous if it moves far for its size, otherwise discrete
};

/// How positions are stored, chosen once for a world (or a call) from what the scene needs.
enum class PositionType : uint8_t {
  float32,  ///< single precision
  float64   ///< double precision, for scenes far from the origin
};

/// Where a body is: a point x of its own frame is at position + R x of the world. The orientation
/// need not be a unit quaternion (R = M(q) / |q|^2), but not zero; spheres and aabbs ignore it.
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< world frame, metres
  Orientation orientation = Orientation::Identity();   ///< from body to world frame
};

/// What two layers and two masks must say for a pair (docs/filters.md).
enum class FilterRule : uint8_t {
  both,   ///< each one's layer has a bit of the other's mask
  either  ///< at least one's layer has a bit of the other's mask
};

/// All properties of a body. Two bodies may meet unless one of these forbids it, in this order:
/// both are fixed; they share a non-zero owner; their spaces differ; they share a negative group;
/// they do not share a positive group, and layers and masks disagree (FilterRule); the world
/// excludes the pair (World::exclude()); the predicate of the caller drops it.
struct BodyDesc {
  Shape shape = Sphere{};                                      ///< in the body's frame
  Eigen::Vector3d position = Eigen::Vector3d::Zero();          ///< world frame, metres
  Orientation orientation = Orientation::Identity();           ///< as in Pose
  Eigen::Vector3f linear_velocity = Eigen::Vector3f::Zero();   ///< world frame, metres a second
  Eigen::Vector3f angular_velocity = Eigen::Vector3f::Zero();  ///< world frame, radians a second
  Motion motion = Motion::dynamic;                             ///< who moves it
  Detection detection = Detection::discrete;                   ///< how World looks after it
  uint32_t layer = 0xffffffffu;                                ///< bits of the layers it is in
  uint32_t mask = 0xffffffffu;                                 ///< bits of the layers it may meet
  uint32_t owner = 0;                                          ///< 0: none
  int32_t group = 0;    ///< 0: none; below: never meets its own; above: layers do not part its own
  uint32_t space = 0;   ///< bodies of different spaces never meet
  bool sensor = false;  ///< reports overlaps and events, never contacts
  /// Metres, finite, >= 0: separate pairs of this body have contacts from this separation on. The
  /// distance of a pair is the larger one of its two bodies, and not less than that of the world.
  float contact_distance = 0;
  /// Metres, finite, >= 0 (otherwise World throws std::invalid_argument): Accuracy::tolerance of
  /// this body; none: that of the world. Half of it counts for each of its pairs, and half of that
  /// of the other body.
  std::optional<float> tolerance = std::nullopt;
  uint64_t user = 0;  ///< handed back unchanged
};

}  // namespace carom

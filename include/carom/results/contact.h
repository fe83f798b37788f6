/// @file
/// Results of the narrow phase: contacts and manifolds.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace carom {

/// How much is asked for; nothing beyond it is computed.
enum class Detail : uint8_t {
  pairs,     ///< candidate pairs only, no narrow phase
  overlap,   ///< overlap or not
  contact,   ///< also normal, separation and witness points
  manifold,  ///< also up to four manifold points of every overlap
};

/// Whether results at this detail include contacts.
constexpr bool has_contacts(Detail detail) { return detail >= Detail::contact; }

/// The frame of the witness points that stateless calls write.
enum class WitnessFrame : uint8_t {
  world,  ///< world coordinates, rounded to float32; NaN beyond its range
  body,   ///< relative to the body's own position, world axes: exact far from the origin, too
};

/// How a result came about.
enum class Status : uint8_t {
  ok = 0,          ///< as documented
  budget = 1,      ///< iteration budget reached: the result is the best bound
  degenerate = 2,  ///< degenerate input: the answer is defined, the normal is a convention
  invalid = 3,     ///< NaN, infinite or negative size: there is no answer
};

/// One contact of a world, 64 bytes. Of the two bodies A has the lower index.
struct Contact {
  uint32_t a;              ///< body index of A, a < b
  uint32_t b;              ///< body index of B
  uint32_t sub_a;          ///< sub-shape (child, triangle) of A; 0 for simple shapes
  uint32_t sub_b;          ///< sub-shape (child, triangle) of B; 0 for simple shapes
  Eigen::Vector3f normal;  ///< unit, world frame, from A to B
  /// Metres; <= 0: overlap by that much. Moving B by -separation * normal makes the two touch.
  /// Beyond the range of float32 it is the largest float or infinite, with the right sign.
  float separation;
  /// Witness point of A relative to A's position, world axes: position_a + arm_a is on A, and
  /// (position_b + arm_b) - (position_a + arm_a) = separation * normal.
  Eigen::Vector3f arm_a;
  /// Rate of change of the separation, (v_b - v_a) . normal, metres a second; negative:
  /// approaching; 0 where no velocities are given.
  float normal_velocity;
  Eigen::Vector3f arm_b;              ///< witness point of B relative to B's position, world axes
  Status status;                      ///< how the contact came about
  uint8_t manifold_count = 0;         ///< 1 to 4 at Detail::manifold, else 0
  std::array<uint8_t, 2> reserved{};  ///< zero, so that contacts compare and hash as bytes
};
static_assert(sizeof(Contact) == 64);

/// The manifold of one overlap, 64 bytes: up to four points on the surface of A, spread as wide as
/// the area in which A and B overlap along the contact's normal. No point is deeper than the
/// contact, up to rounding. Unused entries are zero. There are no initialisers, since this is also
/// scratch memory.
struct ManifoldPoints {
  std::array<std::array<float, 3>, 4> point;  ///< points on A; the owner says in which frame
  /// Point i is separation[i] * normal from B's surface, in metres. For a body with parts the
  /// normal is that of the pair of parts, up to 18 degrees from the contact's.
  std::array<float, 4> separation;
};
static_assert(sizeof(ManifoldPoints) == 64);

}  // namespace carom

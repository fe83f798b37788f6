/// @file
/// Results of the narrow phase: contacts, manifolds, and the columns that stateless calls write to.
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

/// Where stateless calls write: dense columns with one entry a pair; a column that is nullptr is
/// not written. A pair without an answer gets overlap 0, Status::invalid and NaN elsewhere. Names
/// and signs are those of Contact.
struct ResultColumns {
  uint8_t* overlap = nullptr;          ///< 1 overlap, 0 separate; kUndecided at Tier::certified
  uint8_t* status = nullptr;           ///< Status
  float* separation = nullptr;         ///< metres; <= 0: overlap by that much
  std::array<float*, 3> normal{};      ///< unit, world frame, from A to B
  std::array<float*, 3> point_a{};     ///< witness point of A, in the WitnessFrame of the call
  std::array<float*, 3> point_b{};     ///< witness point of B, in the WitnessFrame of the call
  uint8_t* manifold_count = nullptr;   ///< 0 for separate pairs, else 1 to 4
  ManifoldPoints* manifold = nullptr;  ///< in the frame of point_a
  /// Metres by which the separation may be off at most: a forward bound of the kernel
  /// (docs/accuracy.md). Optional, at any detail but pairs; NaN for invalid pairs.
  float* separation_bound = nullptr;
  /// The sub-shape of A that makes the contact: the child of a compound, the triangle of a mesh; 0
  /// for simple shapes, and for a pair without contact. Optional, at details with contacts.
  uint32_t* sub_a = nullptr;
  uint32_t* sub_b = nullptr;  ///< the sub-shape of B, likewise
  /// In and out: the closest corners of two hulls, coded. Zero it at first. A caller that measures
  /// the same pairs again and again hands in the entries that the last call left; calls then take
  /// 0.60 to 0.78 of the time while pairs move slowly (docs/narrowphase_peers.md). The content does
  /// not change decisions. Separations, normals and points are as accurate with any content, but
  /// may differ in bits where two sets of corners are equally near. Used at details with contacts,
  /// in the tiers standard and fast, where separate pairs are measured; entries of other kinds stay
  /// as they are. Optional.
  uint64_t* features = nullptr;
};

/// Which pairs get more than the decision: separation, normal and points, at details with contacts.
/// For the other pairs all columns but overlap, status and manifold_count may hold anything; their
/// status is that of the decision.
enum class Measured : uint8_t {
  all,          ///< every pair
  overlapping,  ///< contacts only. Boxes and hulls against boxes and hulls take half of the time if
                ///< they are separate; most other kinds gain nothing
  separate,     ///< clearances only: no penetration search, which is most of the time that
                ///< overlapping hulls take (composites are searched). There are no manifold points
};

/// The frame of the witness points in ResultColumns.
enum class WitnessFrame : uint8_t {
  world,  ///< world coordinates, rounded to float32; NaN beyond its range
  body,   ///< relative to the body's own position, world axes: exact far from the origin, too
};

}  // namespace carom

// Results of the narrow phase.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace carom {

// How much is asked for; nothing beyond it is computed.
enum class Detail : uint8_t {
  pairs,     // candidate pairs only, no narrow phase
  overlap,   // the decision
  contact,   // decision, normal, separation, witness points
  manifold,  // and up to four points of every overlap
};

constexpr bool has_contacts(Detail detail) { return detail >= Detail::contact; }

enum class Status : uint8_t {
  ok = 0,
  budget = 1,      // iteration budget reached: the result is the best bound
  degenerate = 2,  // degenerate input handled: the answer is defined, the normal is a convention
  invalid = 3,     // NaN, infinite or negative size: there is no answer
};

// One contact of a world, 64 bytes.
//   normal      unit, world frame, from body A to body B
//   separation  metres; <= 0: overlap by that much. Moving B by -separation * normal makes the two
//               touch. Beyond the range of float32 it is the largest float or infinite, with the
//               right sign
//   arm_a/_b    witness point of each body relative to that body's position, world axes:
//               position_a + arm_a is on A, position_b + arm_b on B, and
//               (position_b + arm_b) - (position_a + arm_a) = separation * normal
//   normal_velocity  rate of change of the separation, (v_b - v_a) . normal, metres a second;
//               negative: approaching; 0 where no velocities are given
struct Contact {
  uint32_t a;  // body indices, a < b
  uint32_t b;
  uint32_t sub_a;  // sub-shape (child, triangle) of each; 0 for simple shapes
  uint32_t sub_b;
  Eigen::Vector3f normal;
  float separation;
  Eigen::Vector3f arm_a;
  float normal_velocity;
  Eigen::Vector3f arm_b;
  Status status;
  uint8_t manifold_count = 0;         // at Detail::manifold, 1 to 4
  std::array<uint8_t, 2> reserved{};  // zero, so that contacts compare and hash as bytes
};
static_assert(sizeof(Contact) == 64);

// The points of one overlap, 64 bytes: up to four, on the surface of A, spread as wide as the area
// in which A and B overlap along the contact's normal. Point i is separation[i] * normal from B's
// surface; where B or A has parts along the normal of these, up to 18 degrees from the contact's.
// None is deeper than the contact, up to rounding. Unused: zero. No initialisers: scratch memory.
struct ManifoldPoints {
  std::array<std::array<float, 3>, 4> point;
  std::array<float, 4> separation;
};
static_assert(sizeof(ManifoldPoints) == 64);

// Where stateless calls write; one entry a pair in every column that is not nullptr. Columns are
// dense. A pair that has no answer gets overlap 0, status 3 and NaN elsewhere.
struct ResultColumns {
  uint8_t* overlap = nullptr;  // 1 overlap, 0 separate; kUndecided at Tier::certified
  uint8_t* status = nullptr;   // Status
  float* separation = nullptr;
  std::array<float*, 3> normal{};
  std::array<float*, 3> point_a{};
  std::array<float*, 3> point_b{};
  uint8_t* manifold_count = nullptr;   // 0 for separate pairs, else 1 to 4
  ManifoldPoints* manifold = nullptr;  // in the frame of point_a
  // Metres by which the separation may be off at most, at any detail but pairs: a forward bound of
  // the kernel (docs/accuracy.md). Optional; NaN for invalid pairs.
  float* separation_bound = nullptr;
  // The sub-shape of each body that the contact is with: the child of a compound, the triangle of a
  // mesh; 0 for simple shapes, and where a pair has no contact to name. Optional, at details with
  // contacts.
  uint32_t* sub_a = nullptr;
  uint32_t* sub_b = nullptr;
  // In and out: by which corners two hulls are nearest, or overlap. Zeros at first; a caller that
  // measures the same pairs again and again hands in what the last call left, and calls take 0.60
  // to 0.78 of the time while pairs move slowly (docs/narrowphase_peers.md). Decisions are the same
  // with any content; separations, normals and points are as near to the truth, but not to the bit
  // where two sets of corners are as near. At details with contacts, in the tiers standard and
  // fast, where separate pairs are measured; of other kinds it stays as it is. Optional.
  uint64_t* features = nullptr;
};

// Of which pairs more is found out than whether they overlap: how far or how deep, along which
// normal, between which points. Of the others, columns but overlap, status and manifold_count may
// hold anything, at details with contacts; the status is that of the decision.
enum class Measured : uint8_t {
  all,
  overlapping,  // contacts. Boxes and hulls against boxes and hulls take half of the time if they
                // are apart; for most kinds nothing is saved
  separate,     // clearances: no depth is searched for, which is most of the time that overlapping
                // hulls take; of composites it is. There are no manifold points
};

// The frame of the witness points in ResultColumns.
enum class WitnessFrame : uint8_t {
  world,  // world coordinates, rounded to float32; not a number beyond its range
  body,   // relative to the body's own position, world axes: exact far from the origin, too
};

}  // namespace carom

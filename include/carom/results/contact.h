/// @file
/// Results of the narrow phase: contacts and manifolds.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

namespace carom {

/// How much is asked for; nothing beyond it is computed.
enum class Detail : uint8_t {
  pairs,     ///< candidate pairs only, no narrow phase
  overlap,   ///< overlap or not
  contact,   ///< also normal, separation and witness points
  manifold,  ///< also up to four manifold points of every contact
  regions,   ///< as manifold, with all contacts of a pair instead of the deepest one alone
};

/// Whether results at this detail include contacts.
constexpr bool has_contacts(Detail detail) { return detail >= Detail::contact; }

/// Whether results at this detail include manifolds.
constexpr bool has_manifolds(Detail detail) { return detail >= Detail::manifold; }

/// How the contacts of a pair are divided at Detail::regions. Only bodies with parts (meshes and
/// compounds) can have more than one.
struct RegionLimits {
  /// The cosine of the greatest angle between the normals of parts that share a contact: 18
  /// degrees. With this one the first contact of a pair is that of Detail::manifold, bit for bit.
  double cosine = 0.95;
  /// The most contacts of a pair, 1 to 65,535. The deepest ones are kept; Contact::left_out counts
  /// the others.
  uint32_t most = 16;
};

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

/// One contact of a world, 64 bytes. Of the two bodies A has the lower index. At Detail::regions a
/// pair has a run of contacts, one for each plane in which the bodies touch, the deepest first; at
/// other details one.
struct Contact {
  uint32_t a;              ///< body index of A, a < b
  uint32_t b;              ///< body index of B
  uint32_t sub_a;          ///< sub-shape (child, triangle) of A; 0 for simple shapes
  uint32_t sub_b;          ///< sub-shape (child, triangle) of B; 0 for simple shapes
  Eigen::Vector3f normal;  ///< unit, world frame, from A to B
  /// Metres; <= 0: overlap by that much; > 0: the gap of a contact within the contact distance.
  /// Moving B by -separation * normal makes the two touch.
  /// Beyond the range of float32 it is the largest float or infinite, with the right sign.
  float separation;
  /// Witness point of A relative to A's position, world axes: position_a + arm_a is on A, and
  /// (position_b + arm_b) - (position_a + arm_a) = separation * normal.
  Eigen::Vector3f arm_a;
  /// Rate of change of the separation, metres a second; negative: approaching; 0 where no
  /// velocities are given. It is (v_b - v_a) . normal, with the velocities v of the two witness
  /// points: that of a body's position plus, if the body turns, angular velocity x arm. (Spheres
  /// and aabbs do not turn.) This holds in every list of contacts.
  float normal_velocity;
  Eigen::Vector3f arm_b;       ///< witness point of B relative to B's position, world axes
  Status status;               ///< how the contact came about
  uint8_t manifold_count = 0;  ///< 1 to 4 at details with manifolds, else 0
  /// At Detail::regions, in the first contact of a pair: how many more the pair has than
  /// RegionLimits::most, and how many parts touch beside the 4,096 deepest ones, of which contacts
  /// are made; at most 65,535. Otherwise 0.
  uint16_t left_out = 0;
};
static_assert(sizeof(Contact) == 64);

/// The contacts of the pair of contacts[first], from there on.
inline std::span<const Contact> contact_run(std::span<const Contact> contacts, size_t first) {
  size_t end = first + 1;
  while (end < contacts.size() && contacts[end].a == contacts[first].a &&
         contacts[end].b == contacts[first].b) {
    ++end;
  }
  return contacts.subspan(first, end - first);
}

/// The manifold of one contact, 64 bytes: up to four points on the surface of A, spread as wide as
/// the area in which A and B overlap along the contact's normal, or are no further apart than the
/// contact distance. No point is deeper than the contact, up to rounding. Unused entries are zero.
/// There are no initialisers, since this is also scratch memory.
struct ManifoldPoints {
  std::array<std::array<float, 3>, 4> point;  ///< points on A; the owner says in which frame
  /// Point i is separation[i] * normal from B's surface, in metres. For a body with parts the
  /// normal is that of the pair of parts, up to 18 degrees from the contact's.
  std::array<float, 4> separation;
};
static_assert(sizeof(ManifoldPoints) == 64);

/// The names of the points of one contact: for each point of the manifold, in their order, which
/// vertex, edge or face of A it lies on (the upper 32 bits), and of B (the lower ones). A name
/// stays while the feature does, from call to call and whatever the pose is. Names of different
/// features of one pair of bodies differ, but for a chance of about 2^-30. Without a manifold there
/// is one point, the witness point. Unused entries are 0; no name is.
struct PointNames {
  std::array<uint64_t, 4> point;  ///< names
};

}  // namespace carom

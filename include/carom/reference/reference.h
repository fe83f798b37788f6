/// @file
/// All of Carom once more, as plain scalar C++ that can be read beside a textbook: bounds, brute
/// force pairs, one test a pair, contacts, events. The kernels give the same bits.
#pragma once

#include <span>
#include <vector>

#include "carom/bounds/bounds.h"
#include "carom/export.h"
#include "carom/results/contact.h"
#include "carom/results/event.h"
#include "carom/results/impact.h"
#include "carom/results/pair.h"
#include "carom/results/pair_predicate.h"
#include "carom/results/sweep.h"
#include "carom/shapes/body.h"
#include "carom/shapes/views.h"

/// The scalar reference (library carom_reference).
namespace carom::reference {

/// A box in world coordinates, metres; lower = +inf, upper = -inf is empty.
struct Box {
  Eigen::Vector3f lower;  ///< lower corner
  Eigen::Vector3f upper;  ///< upper corner
};

/// The result of one pair test; names and signs as in Contact.
struct PairResult {
  bool overlap;               ///< touching is overlap
  Status status;              ///< how the result came about
  float separation;           ///< metres; <= 0: overlap by that much
  Eigen::Vector3f normal;     ///< unit, world frame, from A to B
  Eigen::Vector3f arm_a;      ///< witness point of A, relative to its position, world axes
  Eigen::Vector3f arm_b;      ///< witness point of B, relative to its position, world axes
  uint8_t manifold_count;     ///< 0 for separate pairs
  ManifoldPoints manifold{};  ///< relative to the position of A
  uint32_t sub_a = 0;         ///< child or triangle of A; 0 for simple shapes
  uint32_t sub_b = 0;         ///< child or triangle of B; 0 for simple shapes
};

/// All contacts of a pair, as at Detail::regions: the first is that of its PairResult.
struct PairContacts {
  PairResult first;                ///< whether or not there is a contact
  std::vector<PairResult> others;  ///< the other contacts, the deepest first
  uint16_t left_out = 0;           ///< how many more there are, at most 65,535
};

/// A box that contains the body, for spheres and aabbs the smallest one of float32; empty if the
/// body is not valid, infinite for half-spaces. `positions` says in which type the position is
/// stored: for float32 the position is rounded first.
CAROM_EXPORT Box bounds(const Shape& shape, const Pose& pose, PositionType positions);

/// Whether the pose is finite, the size finite and not negative, and the geometry present. Only the
/// kinds that have an orientation need a non-zero quaternion.
CAROM_EXPORT bool is_valid(const Shape& shape, const Pose& pose, PositionType positions);

/// Whether two closed boxes overlap: touching is overlap.
CAROM_EXPORT bool overlap(const Box& a, const Box& b);

/// Whether the properties of two bodies let them meet.
CAROM_EXPORT bool may_meet(const BodyDesc& a, const BodyDesc& b,
                           FilterRule rule = FilterRule::both);

/// Tests A against B. carom::supports() must be true of their kinds. A pair that is separate by at
/// most `contact_distance` metres has manifold points, too.
CAROM_EXPORT PairResult collide(const Shape& shape_a, const Pose& pose_a, const Shape& shape_b,
                                const Pose& pose_b, PositionType positions,
                                float contact_distance = 0);

/// The same with all contacts.
CAROM_EXPORT PairContacts find_contacts(const Shape& shape_a, const Pose& pose_a,
                                        const Shape& shape_b, const Pose& pose_b,
                                        PositionType positions, float contact_distance,
                                        const RegionLimits& limits);

/// When two moving bodies meet, and the contact at that time; names and signs as in ImpactColumns.
struct Impact {
  float toi;               ///< in [0, 1]; +infinity: they do not meet; NaN: there is no answer
  Status status;           ///< ok, budget or invalid
  float separation;        ///< metres; about zero, or minus the depth of an overlap at the start
  Eigen::Vector3f normal;  ///< unit, world frame, from A to B
  Eigen::Vector3f arm_a;   ///< witness point of A, relative to its position at the time of impact
  Eigen::Vector3f arm_b;   ///< witness point of B, relative to its position at the time of impact
  uint32_t sub_a = 0;      ///< part of A that meets first
  uint32_t sub_b = 0;      ///< part of B that meets first
};

/// The first time at which the two bodies touch while they move as their sweeps say. Tests every
/// pair of parts. Kernels find the contact of a point with a face of a mesh from the face alone:
/// its separation, and at the start of the interval its normal and points, may differ in the last
/// bits.
CAROM_EXPORT Impact time_of_impact(const Shape& shape_a, const Pose& pose_a, const Sweep& sweep_a,
                                   const Shape& shape_b, const Pose& pose_b, const Sweep& sweep_b,
                                   PositionType positions);

/// A body as the world has it in one frame.
struct Body {
  BodyId id;      ///< its name
  BodyDesc desc;  ///< its shape, pose and properties in this frame
};

/// The results of one frame, as those of World after step().
struct Frame {
  std::vector<Pair> pairs;                ///< World::pairs()
  std::vector<uint8_t> overlaps;          ///< World::overlaps()
  std::vector<Contact> contacts;          ///< World::contacts()
  std::vector<ManifoldPoints> manifolds;  ///< at details with manifolds one a contact, else none
  std::vector<carom::Impact> impacts;     ///< World::impacts()
  std::vector<Contact> speculative;       ///< World::speculative_contacts()
  std::vector<Event> events;              ///< World::events(), persists included
  std::vector<BodyId> quarantined;        ///< World::quarantined()
  std::vector<Event> touching;            ///< the overlaps with ids, which the next frame needs
};

/// How a frame looks ahead: the settings of the same names in WorldSettings.
struct Ahead {
  double dt = 1.0 / 60;                 ///< seconds
  float fast_share = 0.5f;              ///< from which motion on Detection::automatic looks ahead
  Impacts impacts = Impacts::earliest;  ///< which impacts are kept
};

/// Which pairs a frame leaves out beside those that the properties of their bodies forbid.
struct Filters {
  FilterRule rule = FilterRule::both;   ///< WorldSettings::filter_rule
  std::span<const Pair> excluded = {};  ///< body indices a < b, sorted by (a, b)
  PairPredicate predicate = {};         ///< World::set_pair_predicate()
};

/// Which contacts a frame has: the settings of the same names in WorldSettings.
struct ContactRules {
  float contact_distance = 0;       ///< metres
  RegionLimits region_limits = {};  ///< at Detail::regions
};

/// What a frame computes, and from what. Names that WorldSettings has, too, mean the same there.
struct StepOptions {
  PositionType positions = PositionType::float32;  ///< how positions are stored
  Detail detail = Detail::contact;                 ///< how much of each pair is computed
  bool velocities = true;           ///< contacts carry normal velocities; false: those are 0
  const Frame* previous = nullptr;  ///< the frame before; nullptr: there was none
  Ahead ahead = {};                 ///< how the frame looks ahead
  Filters filters = {};             ///< which pairs are left out
  ContactRules contacts = {};       ///< which contacts there are
};

/// The results of World::step() for these bodies. Their indices must ascend, but bodies[i].id.index
/// need not be i. Compares every pair of boxes: O(n^2).
CAROM_EXPORT Frame step(std::span<const Body> bodies, const StepOptions& options = {});

/// The form of version 0.2.
[[deprecated("pass StepOptions")]] inline Frame step(std::span<const Body> bodies,
                                                     PositionType positions, Detail detail,
                                                     bool velocities, const Frame* previous,
                                                     const Ahead& ahead = {}) {
  return step(bodies, StepOptions{.positions = positions,
                                  .detail = detail,
                                  .velocities = velocities,
                                  .previous = previous,
                                  .ahead = ahead});
}

}  // namespace carom::reference

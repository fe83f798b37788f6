// The whole of Carom again, as plain scalar C++ that can be read beside a textbook: bounds, brute
// force pairs, one test a pair, contacts, events. The kernels give the same bits.
#pragma once

#include <span>
#include <vector>

#include "carom/bounds/bounds.h"
#include "carom/export.h"
#include "carom/results/contact.h"
#include "carom/results/event.h"
#include "carom/results/impact.h"
#include "carom/results/pair.h"
#include "carom/results/sweep.h"
#include "carom/shapes/body.h"
#include "carom/shapes/views.h"

namespace carom::reference {

// A box in world coordinates; lower = +inf, upper = -inf is empty.
struct Box {
  Eigen::Vector3f lower;
  Eigen::Vector3f upper;
};

// What one pair test yields; names and signs as in Contact.
struct PairResult {
  bool overlap;
  Status status;
  float separation;
  Eigen::Vector3f normal;
  Eigen::Vector3f arm_a;
  Eigen::Vector3f arm_b;
  uint8_t manifold_count;     // 0 for separate pairs
  ManifoldPoints manifold{};  // relative to the position of A
  uint32_t sub_a = 0;         // child or triangle; 0 for simple shapes
  uint32_t sub_b = 0;
};

// A box that contains the body, for spheres and aabbs the smallest one of float32; empty if the
// body is not valid, infinite for half-spaces. `positions` says in which type the position is
// stored: float32 positions are rounded first.
CAROM_EXPORT Box bounds(const Shape& shape, const Pose& pose, PositionType positions);

// Finite pose, finite and not negative size.
CAROM_EXPORT bool is_valid(const Shape& shape, const Pose& pose, PositionType positions);

// Closed boxes: touching is overlap.
CAROM_EXPORT bool overlap(const Box& a, const Box& b);

// Whether layers, masks, owners and motion let two bodies meet.
CAROM_EXPORT bool may_meet(const BodyDesc& a, const BodyDesc& b);

// Tests A against B, whatever their kinds; carom::supports() must be true of them.
CAROM_EXPORT PairResult collide(const Shape& shape_a, const Pose& pose_a, const Shape& shape_b,
                                const Pose& pose_b, PositionType positions);

// When two bodies that move meet, and the contact then; names and signs as in ImpactColumns, arms
// relative to the bodies' positions at that time.
struct Impact {
  float toi;
  Status status;
  float separation;
  Eigen::Vector3f normal;
  Eigen::Vector3f arm_a;
  Eigen::Vector3f arm_b;
  uint32_t sub_a = 0;
  uint32_t sub_b = 0;
};

// Every pair of parts is looked at.
CAROM_EXPORT Impact time_of_impact(const Shape& shape_a, const Pose& pose_a, const Sweep& sweep_a,
                                   const Shape& shape_b, const Pose& pose_b, const Sweep& sweep_b,
                                   PositionType positions);

// A body as the world sees it in one frame. bodies[i].id.index need not be i, but must ascend.
struct Body {
  BodyId id;
  BodyDesc desc;
};

// The results of one frame, as those of World after step().
struct Frame {
  std::vector<Pair> pairs;
  std::vector<uint8_t> overlaps;
  std::vector<Contact> contacts;
  std::vector<ManifoldPoints> manifolds;  // at Detail::manifold one a contact, else none
  std::vector<carom::Impact> impacts;
  std::vector<Contact> speculative;
  std::vector<Event> events;
  std::vector<BodyId> quarantined;
  std::vector<Event> touching;  // what the next frame needs of this one: the overlaps with ids
};

// What a frame looks ahead by: as WorldSettings say.
struct Ahead {
  double dt = 1.0 / 60;
  float fast_share = 0.5f;
  Impacts impacts = Impacts::earliest;
};

// `previous` is the frame before; nullptr: there was none. `velocities`: contacts carry normal
// velocities. Every pair of boxes is looked at: O(n^2).
CAROM_EXPORT Frame step(std::span<const Body> bodies, PositionType positions, Detail detail,
                        bool velocities, const Frame* previous, const Ahead& ahead = {});

}  // namespace carom::reference

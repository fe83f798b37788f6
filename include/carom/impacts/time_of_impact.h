/// @file
/// The time of impact: when moving bodies touch for the first time.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <span>

#include "carom/base/parallelism.h"
#include "carom/base/result.h"
#include "carom/export.h"
#include "carom/results/contact.h"
#include "carom/results/pair.h"
#include "carom/results/sweep.h"
#include "carom/shapes/views.h"

namespace carom {

/// Where time_of_impact() writes: dense columns with one entry a pair; a column that is nullptr is
/// not written. The columns after `status` hold the contact at the time of impact, with names and
/// signs as in Contact, NaN where the bodies do not meet.
struct ImpactColumns {
  /// In [0, 1]; 0: they touch or overlap at the start; +infinity: they do not meet; NaN: there is
  /// no answer.
  float* toi = nullptr;
  /// Status. ok; budget: the search ended early, and the bodies may meet later or not at all, but
  /// not sooner; invalid: a body is not valid, or its sweep is not finite.
  uint8_t* status = nullptr;
  float* separation = nullptr;      ///< about zero, or minus the depth of an overlap at the start
  std::array<float*, 3> normal{};   ///< unit, world frame, from A to B
  std::array<float*, 3> point_a{};  ///< witness point of A, in the frame that the call asks for
  std::array<float*, 3> point_b{};  ///< witness point of B, in the frame that the call asks for
  /// The part of A that meets first, of several the one with the lowest indices; 0 where the bodies
  /// do not meet.
  uint32_t* sub_a = nullptr;
  uint32_t* sub_b = nullptr;  ///< the part of B, likewise

  /// Whether a column of the contact is asked for.
  bool want_contacts() const { return separation || normal[0] || point_a[0] || point_b[0]; }
};

/// What time_of_impact() may be asked for beside its results.
struct ImpactOptions {
  WitnessFrame frame = WitnessFrame::world;     ///< of witness points
  Parallelism parallelism = Parallelism::none;  ///< which threads the call may use
};

/// For pair i = (a[pairs[i].a], b[pairs[i].b]) finds the first time in [0, 1] at which the bodies
/// touch, and the contact at that time, and writes row i of `out`. `a` and `b` may be the same set.
/// Row k of a sweep is the motion of body k of its set. Indices must lie inside their sets.
///
/// No impact is late, and none is missed: before `toi` the bodies, as they are stored, do not touch
/// (toi is rounded downwards to float32). At `toi`, before that rounding, their separation is at
/// most kImpactSlack x (size + travel); bodies that graze each other within that distance may be
/// reported as meeting. The size is the sum of the distances of both shapes' furthest points from
/// their bodies' positions (a half-space has none). The travel is the length of the relative
/// displacement plus, for bodies that turn, the angle times that distance (for a half-space: times
/// the greatest distance that the other body reaches from the half-space's position).
///
/// Witness points refer to the bodies at the time of impact, in the frame `options.frame`.
///
/// Meshes and compounds: only the parts that the swept bounds reach are tested. A one-sided
/// triangle stops a body if the body's middle is in front of the triangle's back (the plane
/// `thickness` behind its front) when the two first touch. The middle of a point is in that plane
/// then, and its way decides. A body that comes from behind passes through for the whole interval,
/// and so does a body that overlaps the triangle from behind at the start. Inner edges do not
/// change the time.
///
/// Results have the same bits on every instruction set and for any number of threads, and do not
/// depend on a pair's place in the list. Fails, and writes nothing, if no kernel exists for the
/// kinds of a pair (supports()).
CAROM_EXPORT Result<void> time_of_impact(const Collidables& a, const SweepView& sweep_a,
                                         const Collidables& b, const SweepView& sweep_b,
                                         std::span<const Pair> pairs, const ImpactColumns& out,
                                         const ImpactOptions& options = {});

/// The form of version 0.2. A template, so that `{}` in the last place is ImpactOptions.
template <std::same_as<WitnessFrame> Frame>
[[deprecated("pass ImpactOptions")]] Result<void> time_of_impact(
    const Collidables& a, const SweepView& sweep_a, const Collidables& b, const SweepView& sweep_b,
    std::span<const Pair> pairs, const ImpactColumns& out, Frame frame,
    Parallelism parallelism = Parallelism::none) {
  return time_of_impact(a, sweep_a, b, sweep_b, pairs, out,
                        ImpactOptions{.frame = frame, .parallelism = parallelism});
}

/// The greatest separation at a time of impact, relative to size and travel (time_of_impact()).
inline constexpr double kImpactSlack = 1e-11;

}  // namespace carom

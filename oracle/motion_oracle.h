// Finds and judges times of impact, with proof up to rounding. Directions with a positive gap prove
// that two shapes stay separate; points of both prove that they meet.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "oracle/moving_pair.h"

namespace carom::oracle {

enum class Meeting : uint8_t { none, found, unknown };

// The first time at which the separation is not above a floor.
template <class R>
struct MeetingTime {
  Meeting meeting;
  R time;  // the separation is above the floor before it, and at it if not found
};

// Advances from `from` to `to` in steps proven free (conservative advancement along the normal).
// For shapes that do not turn this is Newton's method on a convex function.
template <class R>
MeetingTime<R> first_meeting(const MovingPair<R>& pair, R from, const R& to, const R& floor);

// Brackets the first time of impact: certainly separate until `low`, certainly overlapping at
// `high`. Shapes that graze each other within rounding have no `high` (+infinity).
template <class R>
struct ImpactBracket {
  Meeting meeting;
  R low;
  R high;
};

template <class R>
ImpactBracket<R> bracket_impact(const MovingPair<R>& pair);

template <class R>
struct LeastSeparation {
  R time;
  R value;         // signed
  Vec3<R> normal;  // in the oracle's order, in which a half-space is B
};

// By golden section. This is the minimum for shapes that do not turn; for others a value hardly
// greater than its neighbours.
template <class R>
LeastSeparation<R> least_separation(const MovingPair<R>& pair, R from, R to);

enum class Fault : uint8_t {
  none,
  late,       // they overlap before the claimed time
  early,      // further apart than allowed from that time to the next float
  malformed,  // neither a time in [0, 1] nor "never" (+infinity)
  unknown,    // the oracle could not tell
};

const char* name(Fault fault);

// A fault, with its time and the separation then.
struct Judgement {
  Fault fault = Fault::none;
  double time = 0;
  double separation = 0;
};

inline constexpr double kAllowedGap = 1e-11;  // as a share of size plus travel

template <class R>
class ImpactJudge {
 public:
  // The pair must outlive the judge.
  explicit ImpactJudge(const MovingPair<R>& pair) : pair_(pair) {}

  // Faults a pair whose shapes overlap by more than rounding before `end`.
  Judgement late(const R& end) const;

  // Faults a pair whose separation is above the allowed gap during all of [from, to].
  Judgement early(const R& from, const R& to) const;

 private:
  static Judgement at(Fault fault, const MotionMoment<R>& moment);

  const MovingPair<R>& pair_;
};

// Judges a time that was rounded down to float32; +infinity means never. A touch within rounding of
// double precision may count as an impact or not.
template <class R>
Judgement judge_impact(const MovingPair<R>& pair, float toi);

// Judges in double precision first, which nearly always finds no fault; repeats the others in long
// double.
Judgement judge_impact(const Shape& shape_a, const Pose& pose_a, const Sweep& sweep_a,
                       const Shape& shape_b, const Pose& pose_b, const Sweep& sweep_b, float toi);

}  // namespace carom::oracle

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
MeetingTime<R> first_meeting(const MovingPair<R>& pair, R from, const R& to, const R& floor) {
  constexpr int kMostSteps = 1000;
  for (int step = 0; step < kMostSteps; ++step) {
    const MotionMoment<R> moment(pair, from, floor);
    if (moment.is_below(floor)) return {Meeting::found, from};
    const R next = from + moment.free_span(to - from, floor);
    if (next >= to) return {Meeting::none, to};
    if (!(next > from)) break;
    from = next;
  }
  return {Meeting::unknown, from};
}

// Brackets the first time of impact: certainly separate until `low`, certainly overlapping at
// `high`. Shapes that graze each other within rounding have no `high` (+infinity).
template <class R>
struct ImpactBracket {
  Meeting meeting;
  R low;
  R high;
};

template <class R>
ImpactBracket<R> bracket_impact(const MovingPair<R>& pair) {
  const R infinity = std::numeric_limits<R>::infinity();
  const MeetingTime<R> touch = first_meeting<R>(pair, R(0), R(1), pair.rounding());
  if (touch.meeting != Meeting::found) return {touch.meeting, touch.time, infinity};
  const MeetingTime<R> overlap = first_meeting<R>(pair, touch.time, R(1), -pair.rounding());
  const bool is_found = overlap.meeting == Meeting::found;
  return {touch.meeting, touch.time, is_found ? overlap.time : infinity};
}

template <class R>
struct LeastSeparation {
  R time;
  R value;         // signed
  Vec3<R> normal;  // in the oracle's order, in which a half-space is B
};

// By golden section. This is the minimum for shapes that do not turn; for others a value hardly
// greater than its neighbours.
template <class R>
LeastSeparation<R> least_separation(const MovingPair<R>& pair, R from, R to) {
  const R ratio = (std::sqrt(R(5)) - 1) / 2;
  const auto at = [&](const R& t) { return MotionMoment<R>(pair, t, -pair.rounding(), R(0)); };
  R left = to - (to - from) * ratio, right = from + (to - from) * ratio;
  R gap_left = at(left).upper(), gap_right = at(right).upper();
  for (int i = 0; i < 60 && to > from; ++i) {
    if (gap_left <= gap_right) {
      to = std::exchange(right, left);
      gap_right = gap_left;
      left = to - (to - from) * ratio;
      gap_left = at(left).upper();
    } else {
      from = std::exchange(left, right);
      gap_left = gap_right;
      right = from + (to - from) * ratio;
      gap_right = at(right).upper();
    }
  }
  const MotionMoment<R> best = at(gap_left <= gap_right ? left : right);
  return {best.time(), best.upper(), best.normal()};
}

enum class Fault : uint8_t {
  none,
  late,       // they overlap before the claimed time
  early,      // further apart than allowed from that time to the next float
  malformed,  // neither a time in [0, 1] nor "never" (+infinity)
  unknown,    // the oracle could not tell
};

inline const char* name(Fault fault) {
  constexpr const char* kNames[] = {"none", "late", "early", "malformed", "unknown"};
  return kNames[static_cast<size_t>(fault)];
}

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
  Judgement late(const R& end) const {
    const R floor = -pair_.rounding();
    const MotionMoment<R> last(pair_, end, floor);
    if (end > 0 && last.is_below(floor)) return at(Fault::late, last);
    const R rest = end + last.free_span(-end, floor);
    if (!(rest > 0)) return {};
    const MeetingTime<R> meeting = first_meeting<R>(pair_, R(0), rest, floor);
    if (meeting.meeting == Meeting::none) return {};
    const Fault fault = meeting.meeting == Meeting::found ? Fault::late : Fault::unknown;
    return at(fault, MotionMoment<R>(pair_, meeting.time, floor));
  }

  // Faults a pair whose separation is above the allowed gap during all of [from, to].
  Judgement early(const R& from, const R& to) const {
    const R allowed = R(kAllowedGap) * (pair_.size() + pair_.travel()) + pair_.rounding();
    const MotionMoment<R> last(pair_, to, allowed);
    if (last.is_below(allowed)) return {};
    const MeetingTime<R> meeting = first_meeting<R>(pair_, from, to, allowed);
    if (meeting.meeting == Meeting::found) return {};
    const Fault fault = meeting.meeting == Meeting::none ? Fault::early : Fault::unknown;
    return at(fault, last);
  }

 private:
  static Judgement at(Fault fault, const MotionMoment<R>& moment) {
    return {fault, static_cast<double>(moment.time()), static_cast<double>(moment.upper())};
  }

  const MovingPair<R>& pair_;
};

// Judges a time that was rounded down to float32; +infinity means never. A touch within rounding of
// double precision may count as an impact or not.
template <class R>
Judgement judge_impact(const MovingPair<R>& pair, float toi) {
  const bool is_never = toi == std::numeric_limits<float>::infinity();
  if (!is_never && !(toi >= 0 && toi <= 1)) return {Fault::malformed, toi, 0};
  const ImpactJudge<R> judge(pair);
  const Judgement late = judge.late(is_never ? R(1) : R(toi));
  if (is_never || late.fault != Fault::none) return late;
  return judge.early(R(toi), R(std::min(std::nextafter(toi, 2.0f), 1.0f)));
}

// Judges in double precision first, which nearly always finds no fault; repeats the others in long
// double.
inline Judgement judge_impact(const Shape& shape_a, const Pose& pose_a, const Sweep& sweep_a,
                              const Shape& shape_b, const Pose& pose_b, const Sweep& sweep_b,
                              float toi) {
  const MovingPair<double> quick(shape_a, pose_a, sweep_a, shape_b, pose_b, sweep_b);
  if (judge_impact(quick, toi).fault == Fault::none) return {};
  const MovingPair<long double> wide(shape_a, pose_a, sweep_a, shape_b, pose_b, sweep_b);
  return judge_impact(wide, toi);
}

}  // namespace carom::oracle

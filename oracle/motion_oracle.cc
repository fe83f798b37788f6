#include "oracle/motion_oracle.h"

namespace carom::oracle {

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

const char* name(Fault fault) {
  constexpr const char* kNames[] = {"none", "late", "early", "malformed", "unknown"};
  return kNames[static_cast<size_t>(fault)];
}

template <class R>
Judgement ImpactJudge<R>::late(const R& end) const {
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

template <class R>
Judgement ImpactJudge<R>::early(const R& from, const R& to) const {
  const R allowed = R(kAllowedGap) * (pair_.size() + pair_.travel()) + pair_.rounding();
  const MotionMoment<R> last(pair_, to, allowed);
  if (last.is_below(allowed)) return {};
  const MeetingTime<R> meeting = first_meeting<R>(pair_, from, to, allowed);
  if (meeting.meeting == Meeting::found) return {};
  const Fault fault = meeting.meeting == Meeting::none ? Fault::early : Fault::unknown;
  return at(fault, last);
}

template <class R>
Judgement ImpactJudge<R>::at(Fault fault, const MotionMoment<R>& moment) {
  return {fault, static_cast<double>(moment.time()), static_cast<double>(moment.upper())};
}

template <class R>
Judgement judge_impact(const MovingPair<R>& pair, float toi) {
  const bool is_never = toi == std::numeric_limits<float>::infinity();
  if (!is_never && !(toi >= 0 && toi <= 1)) return {Fault::malformed, toi, 0};
  const ImpactJudge<R> judge(pair);
  const Judgement late = judge.late(is_never ? R(1) : R(toi));
  if (is_never || late.fault != Fault::none) return late;
  return judge.early(R(toi), R(std::min(std::nextafter(toi, 2.0f), 1.0f)));
}

Judgement judge_impact(const Shape& shape_a, const Pose& pose_a, const Sweep& sweep_a,
                       const Shape& shape_b, const Pose& pose_b, const Sweep& sweep_b, float toi) {
  const MovingPair<double> quick(shape_a, pose_a, sweep_a, shape_b, pose_b, sweep_b);
  if (judge_impact(quick, toi).fault == Fault::none) return {};
  const MovingPair<long double> wide(shape_a, pose_a, sweep_a, shape_b, pose_b, sweep_b);
  return judge_impact(wide, toi);
}

// The real types that are used.
template MeetingTime<double> first_meeting(const MovingPair<double>& pair, double from,
                                           const double& to, const double& floor);
template ImpactBracket<double> bracket_impact(const MovingPair<double>& pair);
template LeastSeparation<double> least_separation(const MovingPair<double>& pair, double from,
                                                  double to);
template class ImpactJudge<double>;
template Judgement judge_impact(const MovingPair<double>& pair, float toi);
template MeetingTime<long double> first_meeting(const MovingPair<long double>& pair,
                                                long double from, const long double& to,
                                                const long double& floor);
template ImpactBracket<long double> bracket_impact(const MovingPair<long double>& pair);
template LeastSeparation<long double> least_separation(const MovingPair<long double>& pair,
                                                       long double from, long double to);
template class ImpactJudge<long double>;
template Judgement judge_impact(const MovingPair<long double>& pair, float toi);
}  // namespace carom::oracle

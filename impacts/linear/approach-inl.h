// How far two hulls certainly get that move without rotating, one pair per lane of doubles
// (impacts/approach.h is the scalar form and has the source). Points and searches lie in memory, so
// that a lane can leave its vector and go on in another one.
#if defined(CAROM_IMPACTS_LINEAR_APPROACH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_IMPACTS_LINEAR_APPROACH_INL_H_
#undef CAROM_IMPACTS_LINEAR_APPROACH_INL_H_
#else
#define CAROM_IMPACTS_LINEAR_APPROACH_INL_H_
#endif

#include <algorithm>
#include <array>

#include "base/tolerances.h"
#include "impacts/approach.h"
#include "impacts/linear/crossing-inl.h"
#include "narrowphase/doubles/plain_simplex-inl.h"
#include "narrowphase/doubles/point_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// A search in each lane, between two rounds.
struct ApproachLanes {
  HullPointLanes a, b;
  LaneVector from, way;
  LaneNumber tolerance;
  LaneNumber time;
  std::array<LaneVector, 3> corner;  // at no offset
  LaneNumber used;                   // Places
  LaneVector point;                  // nearest to zero
  LaneNumber squared;
  LaneNumber rounds;

  // Calls use(number) for every number but the points.
  template <class Lanes, class Use>
  static void for_each_number(Lanes& lanes, const Use& use) {
    const auto use3 = [&](auto& v) {
      for (auto& number : v) use(number);
    };
    use3(lanes.from);
    use3(lanes.way);
    use(lanes.tolerance);
    use(lanes.time);
    for (auto& v : lanes.corner) use3(v);
    use(lanes.used);
    use3(lanes.point);
    use(lanes.squared);
    use(lanes.rounds);
  }

  // The corner of B - A that is lowest along n, at no offset.
  HWY_INLINE D3 lowest(const D3& n) const { return b.furthest(-n) - a.furthest(n); }
};

// Copies lane `lane` of a search to lane `to` of another one.
template <class Lanes>
void copy_lane(const Lanes& source, size_t lane, Lanes& out, size_t to) {
  out.a.copy_lane(source.a, lane, to);
  out.b.copy_lane(source.b, lane, to);
  std::array<double, (sizeof(Lanes) - sizeof(out.a) - sizeof(out.b)) / sizeof(LaneNumber)> numbers;
  size_t count = 0;
  Lanes::for_each_number(source, [&](const LaneNumber& n) { numbers[count++] = n.lane[lane]; });
  count = 0;
  Lanes::for_each_number(out, [&](LaneNumber& n) { n.lane[to] = numbers[count++]; });
}

// Sets up the searches, of which points, ways, tolerances and times are there, and as the first
// corner the way from a point inside of A to one inside of B, at no offset.
HWY_INLINE void begin_approach(ApproachLanes& lanes) {
  const D3 at = get(lanes.from) + get(lanes.way) * lanes.time.get();
  const D3 first = lanes.lowest(get(lanes.corner[0]) + at);
  const D3 point = first + at;
  for (LaneVector& corner : lanes.corner) put(first, corner);
  lanes.used.put(hn::BitCast(DoubleTag(), places(0b001)));
  put(point, lanes.point);
  lanes.squared.put(dot(point, point));
  lanes.rounds.put(hn::Zero(DoubleTag()));
}

// Runs rounds until no more than `few` lanes are open. Writes the times of those that end, or
// kNoClosedForm.
HWY_INLINE void go_on(size_t few, DoubleMask& is_open, ApproachLanes& lanes, LaneNumber& times) {
  const DoubleTag tag;
  const D3 from = get(lanes.from), way = get(lanes.way);
  const D tolerance = lanes.tolerance.get();
  const D half = hn::Mul(tolerance, splat_double(0.5));
  const D quarter = hn::Mul(tolerance, splat_double(0.25));
  std::array<D3, 3> corner = {get(lanes.corner[0]), get(lanes.corner[1]), get(lanes.corner[2])};
  Places used = hn::BitCast(PlaceTag(), lanes.used.get());
  D3 point = get(lanes.point);
  D time = lanes.time.get(), squared = lanes.squared.get(), rounds = lanes.rounds.get();
  D result = splat_double(kNoClosedForm);
  DoubleMask is_around = no_lanes_of<D>(), is_unclear = no_lanes_of<D>();
  const auto end = [&](DoubleMask where, D its_result) HWY_ATTR {
    const DoubleMask ends = hn::And(is_open, where);
    result = hn::IfThenElse(ends, its_result, result);
    is_open = hn::AndNot(ends, is_open);
  };
  for (;;) {
    const D unsure =
        hn::IfThenElse(hn::Gt(time, splat_double(1)), never(), splat_double(kNoClosedForm));
    end(hn::Ge(rounds, splat_double(scalar::kMostApproachRounds)), unsure);
    const D distance = hn::Sqrt(squared);
    const D met = hn::IfThenElse(hn::Gt(time, splat_double(1)), never(), time);
    end(hn::Or(is_around, hn::AndNot(is_unclear, hn::Le(distance, tolerance))), met);
    end(is_unclear, unsure);
    if (hn::CountTrue(tag, is_open) <= few) break;

    const D3 n = point * hn::Div(splat_double(1), distance);
    const D3 next = lanes.lowest(n);
    D3 at = from + way * time;
    const D gap = dot(n, next + at);
    const DoubleMask steps = hn::Gt(gap, tolerance);
    const D closing = hn::Neg(dot(n, way)), to_close = hn::Sub(gap, half);
    const DoubleMask closes =
        hn::Ge(hn::Mul(closing, hn::Sub(splat_double(1), time)), hn::Sub(to_close, quarter));
    end(hn::AndNot(closes, steps), never());
    const D step = hn::IfThenElseZero(steps, hn::Div(to_close, closing));
    time = hn::IfThenElse(is_open, hn::Add(time, step), time);
    at = from + way * time;
    const PlainSearch search({corner[0] + at, corner[1] + at, corner[2] + at}, used, next + at);
    const PlainNearestLanes& nearer = search.nearest();
    const DoubleMask goes_on = hn::Or(hn::Gt(step, zero()), hn::Lt(nearer.squared, squared));
    end(hn::Not(goes_on),
        hn::IfThenElse(hn::Gt(time, splat_double(1)), never(), splat_double(kNoClosedForm)));
    const Places kept = nearer.kept;
    const Places taken = hn::AndNot(kept, hn::Add(kept, places(1)));
    for (size_t i = 0; i < 3; ++i) corner[i] = select(has_place(taken, i), next, corner[i]);
    used = hn::Or(kept, taken);
    point = nearer.point;
    squared = nearer.squared;
    is_around = nearer.is_around;
    is_unclear = nearer.is_unclear;
    rounds = hn::Add(rounds, splat_double(1));
  }
  times.put(result);
  for (size_t i = 0; i < 3; ++i) put(corner[i], lanes.corner[i]);
  lanes.used.put(hn::BitCast(tag, used));
  put(point, lanes.point);
  lanes.time.put(time);
  lanes.squared.put(squared);
  lanes.rounds.put(rounds);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_IMPACTS_LINEAR_APPROACH_INL_H_

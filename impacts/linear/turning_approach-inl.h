// How far two hulls certainly get that rotate, one pair per lane of doubles
// (impacts/turning_approach.h is the scalar form and has the sources).
#if defined(CAROM_IMPACTS_LINEAR_TURNING_APPROACH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_IMPACTS_LINEAR_TURNING_APPROACH_INL_H_
#undef CAROM_IMPACTS_LINEAR_TURNING_APPROACH_INL_H_
#else
#define CAROM_IMPACTS_LINEAR_TURNING_APPROACH_INL_H_
#endif

#include "impacts/linear/approach-inl.h"
#include "impacts/turning_approach.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// Bodies that turn further than this over the interval are left to the scalar form.
inline constexpr double kMostTurning = 12.5;

// sin_cos() of at most half of kMostTurning.
HWY_INLINE void sin_cos(D angle, D& sin, D& cos) {
  const D one = splat_double(1);
  const D x = hn::Mul(angle, splat_double(1.0 / 16));
  const D square = hn::Mul(x, x);
  sin = cos = hn::Zero(DoubleTag());
  for (size_t k = 8; k-- > 0;) {
    sin = hn::Mul(hn::Add(one, sin), hn::Mul(square, splat_double(scalar::kSinRatio[k])));
    cos = hn::Mul(hn::Add(one, cos), hn::Mul(square, splat_double(scalar::kCosRatio[k])));
  }
  sin = hn::Mul(x, hn::Add(one, sin));
  for (int i = 0; i < 4; ++i) {
    const D twice = hn::Mul(splat_double(2), hn::Mul(sin, hn::Add(one, cos)));
    cos = hn::Mul(splat_double(-2), hn::Mul(sin, sin));
    sin = twice;
  }
  cos = hn::Add(one, cos);
}

// How a body of each lane rotates.
struct TurningLanes {
  D3 rotation;
  D angle;  // over the interval
  D reach;

  HWY_INLINE TurningLanes(const D3& its_rotation, D its_reach)
      : rotation(its_rotation),
        angle(hn::Sqrt(dot(its_rotation, its_rotation))),
        reach(its_reach) {}

  HWY_INLINE D speed() const { return hn::Mul(angle, splat_double(scalar::kSpeedUpwards)); }

  HWY_INLINE RotationOf<D> turn(D time) const {
    D sin, cos;
    sin_cos(hn::Mul(hn::Mul(angle, time), splat_double(0.5)), sin, cos);
    const D share = hn::IfThenElseZero(hn::Gt(angle, zero()), hn::Div(sin, angle));
    return rotation_of(QuaternionOf<D>{rotation * share, cos});
  }
};

// A search in each lane, between two rounds.
struct TurningApproachLanes {
  HullPointLanes a, b;  // at the start
  LaneVector from, way;
  LaneVector rotation_a, rotation_b;
  LaneNumber reach_a, reach_b;
  LaneNumber tolerance;
  LaneNumber time;
  std::array<LaneVector, 3> on_a, on_b;    // the points of the corners, at the start
  std::array<LaneVector, 3> corner, rate;  // the corners and their velocities
  LaneNumber used;                         // Places
  LaneVector point;                        // nearest to zero
  LaneNumber squared;
  LaneNumber rounds;

  // Calls use(number) for every number but the points.
  template <class Lanes, class Use>
  static void for_each_number(Lanes& lanes, const Use& use) {
    const auto use3 = [&](auto& v) {
      for (auto& number : v) use(number);
    };
    for (auto* v : {&lanes.from, &lanes.way, &lanes.rotation_a, &lanes.rotation_b, &lanes.point}) {
      use3(*v);
    }
    for (size_t i = 0; i < 3; ++i) {
      use3(lanes.on_a[i]);
      use3(lanes.on_b[i]);
      use3(lanes.corner[i]);
      use3(lanes.rate[i]);
    }
    for (auto* number : {&lanes.reach_a, &lanes.reach_b, &lanes.tolerance, &lanes.time, &lanes.used,
                         &lanes.squared, &lanes.rounds}) {
      use(*number);
    }
  }
};

// The pairs of a vector at one time.
class TurningMoment {
 public:
  HWY_INLINE TurningMoment(const TurningApproachLanes& lanes, const TurningLanes& a,
                           const TurningLanes& b, D time)
      : lanes_(lanes),
        a_(a),
        b_(b),
        turn_a_(a.turn(time)),
        turn_b_(b.turn(time)),
        way_(get(lanes.way)),
        between_(get(lanes.from) + way_ * time) {}

  HWY_INLINE void lowest(const D3& n, D3& on_a, D3& on_b) const {
    on_a = lanes_.a.furthest(rotate_back(turn_a_, n));
    on_b = lanes_.b.furthest(rotate_back(turn_b_, -n));
  }
  HWY_INLINE void place(const D3& on_a, const D3& on_b, D3& corner) const {
    corner = (rotate(turn_b_, on_b) + between_) - rotate(turn_a_, on_a);
  }
  HWY_INLINE void place(const D3& on_a, const D3& on_b, D3& corner, D3& rate) const {
    const D3 at_a = rotate(turn_a_, on_a), at_b = rotate(turn_b_, on_b);
    corner = (at_b + between_) - at_a;
    rate = (way_ + cross(b_.rotation, at_b)) - cross(a_.rotation, at_a);
  }

 private:
  const TurningApproachLanes& lanes_;
  const TurningLanes &a_, &b_;
  const RotationOf<D> turn_a_, turn_b_;
  const D3 way_, between_;
};

// Sets up the searches. The first places of the corners hold a point inside of each body.
HWY_INLINE void begin_approach(TurningApproachLanes& lanes) {
  const TurningLanes a(get(lanes.rotation_a), lanes.reach_a.get());
  const TurningLanes b(get(lanes.rotation_b), lanes.reach_b.get());
  const TurningMoment now(lanes, a, b, lanes.time.get());
  D3 middles, on_a, on_b, corner, rate;
  now.place(get(lanes.on_a[0]), get(lanes.on_b[0]), middles);
  now.lowest(middles, on_a, on_b);
  now.place(on_a, on_b, corner, rate);
  for (size_t i = 0; i < 3; ++i) {
    put(on_a, lanes.on_a[i]);
    put(on_b, lanes.on_b[i]);
    put(corner, lanes.corner[i]);
    put(rate, lanes.rate[i]);
  }
  lanes.used.put(hn::BitCast(DoubleTag(), places(0b001)));
  put(corner, lanes.point);
  lanes.squared.put(dot(corner, corner));
  lanes.rounds.put(hn::Zero(DoubleTag()));
}

// How fast the direction changes that stays perpendicular to the sides of the simplex.
HWY_INLINE D3 tilt(const TurningApproachLanes& lanes, const D3& n, Places used) {
  const D3 corner = get(lanes.corner[0]), rate = get(lanes.rate[0]);
  const DoubleMask has_u = has_place(used, 1), has_v = has_place(used, 2);
  const D3 u = zero_unless(has_u, get(lanes.corner[1]) - corner);
  const D3 v = zero_unless(has_v, get(lanes.corner[2]) - corner);
  const D rise_u = hn::IfThenElseZero(has_u, dot(n, get(lanes.rate[1]) - rate));
  const D rise_v = hn::IfThenElseZero(has_v, dot(n, get(lanes.rate[2]) - rate));
  const D area = dot(n, cross(u, v));
  const D3 of_face =
      (cross(v, n) * rise_u + cross(n, u) * rise_v) * hn::Div(splat_double(-1), area);
  const D3 edge = u + v;
  const D3 of_edge = edge * hn::Div(hn::Neg(hn::Add(rise_u, rise_v)), dot(edge, edge));
  return zero_unless(hn::Or(has_u, has_v), select(hn::And(has_u, has_v), of_face, of_edge));
}

// Runs rounds until no more than `few` lanes are open. Writes the times of those that end, or
// kNoClosedForm.
HWY_INLINE void go_on(size_t few, DoubleMask& is_open, TurningApproachLanes& lanes,
                      LaneNumber& times) {
  const DoubleTag tag;
  const D one = splat_double(1), unsure = splat_double(kNoClosedForm);
  const TurningLanes a(get(lanes.rotation_a), lanes.reach_a.get());
  const TurningLanes b(get(lanes.rotation_b), lanes.reach_b.get());
  const D3 way = get(lanes.way);
  const D tolerance = lanes.tolerance.get();
  const D aim = hn::Mul(tolerance, splat_double(0.5));
  const D least = hn::Mul(tolerance, splat_double(0.25));
  const D speed_a = a.speed(), speed_b = b.speed();
  const D fastest = hn::Mul(hn::Add(hn::Add(hn::Sqrt(dot(way, way)), hn::Mul(speed_a, a.reach)),
                                    hn::Mul(speed_b, b.reach)),
                            splat_double(scalar::kSpeedUpwards));
  const D curved_fixed = hn::Add(hn::Mul(hn::Mul(speed_a, speed_a), a.reach),
                                 hn::Mul(hn::Mul(speed_b, speed_b), b.reach));
  Places used = hn::BitCast(PlaceTag(), lanes.used.get());
  D3 point = get(lanes.point);
  D time = lanes.time.get(), squared = lanes.squared.get(), rounds = lanes.rounds.get();
  D result = unsure;
  DoubleMask is_around = no_lanes_of<D>(), is_unclear = no_lanes_of<D>();
  const auto end = [&](DoubleMask where, D its_result) HWY_ATTR {
    const DoubleMask ends = hn::And(is_open, where);
    result = hn::IfThenElse(ends, its_result, result);
    is_open = hn::AndNot(ends, is_open);
  };
  const auto length = [](const D3& v) HWY_ATTR { return hn::Sqrt(dot(v, v)); };
  for (;;) {
    end(hn::Ge(rounds, splat_double(scalar::kMostTurningRounds)), unsure);
    const D distance = hn::Sqrt(squared);
    end(hn::Or(is_around, hn::AndNot(is_unclear, hn::Le(distance, tolerance))), time);
    end(is_unclear, unsure);
    if (hn::CountTrue(tag, is_open) <= few) break;

    const D3 n = point * hn::Div(one, distance);
    D3 on_a, on_b, low, low_rate;
    {
      const TurningMoment now(lanes, a, b, time);
      now.lowest(n, on_a, on_b);
      now.place(on_a, on_b, low, low_rate);
    }
    const D gap = dot(n, low);
    const DoubleMask goes = hn::Gt(gap, tolerance);
    const D left = hn::Sub(one, time), to_close = hn::Sub(gap, aim);
    const D closing = hn::Sub(hn::Add(hn::Mul(length(cross(n, a.rotation)), a.reach),
                                      hn::Mul(length(cross(n, b.rotation)), b.reach)),
                              dot(n, way));
    const D sure = hn::IfThenElse(hn::Gt(closing, zero()), hn::Div(to_close, closing), never());
    end(hn::And(goes, hn::Ge(sure, left)), never());
    D step = zero();
    if (!hn::AllFalse(tag, hn::And(is_open, goes))) {
      const auto time_to_close = [&](D rate) HWY_ATTR {
        return hn::IfThenElse(hn::Lt(rate, zero()), min(hn::Div(to_close, hn::Neg(rate)), left),
                              left);
      };
      const D rate = dot(n, low_rate);
      D3 tilting = tilt(lanes, n, used);
      const D speed = length(tilting);
      D curved = hn::Add(hn::Mul(hn::Mul(splat_double(2), speed), fastest),
                         hn::Mul(hn::Add(one, hn::Mul(speed, left)), curved_fixed));
      D s = time_to_close(hn::Add(rate, dot(tilting, low)));
      const DoubleMask tilts = hn::Le(hn::Mul(curved, hn::Mul(s, s)), gap);
      tilting = zero_unless(tilts, tilting);
      curved = hn::IfThenElse(tilts, curved, curved_fixed);
      s = hn::IfThenElse(tilts, s, time_to_close(rate));
      const D chord = hn::Sqrt(hn::Div(hn::Mul(splat_double(8), gap), curved));
      s = hn::IfThenElse(hn::Gt(curved, zero()), min(s, chord), s);
      s = max(s, sure);

      const D3 then_n = n + tilting * s;
      D3 then_a, then_b, then_low;
      {
        const TurningMoment then(lanes, a, b, hn::Add(time, s));
        then.lowest(then_n, then_a, then_b);
        then.place(then_a, then_b, then_low);
      }
      const D then_gap = dot(then_n, then_low);
      const D sag = hn::Mul(hn::Mul(curved, hn::Mul(s, s)), splat_double(0.5));
      const D room = hn::Sub(gap, least);
      const D falls = hn::Add(hn::Sub(gap, then_gap), sag);
      const D root = hn::Sub(hn::Mul(falls, falls), hn::Mul(hn::Mul(splat_double(4), sag), room));
      const DoubleMask closes = hn::And(hn::Gt(falls, zero()), hn::Ge(root, zero()));
      const D share = hn::IfThenElse(
          closes, min(hn::Div(hn::Mul(splat_double(2), room), hn::Add(falls, hn::Sqrt(root))), one),
          one);
      step = max(hn::Mul(s, share), sure);
      end(hn::And(goes, hn::Ge(step, left)), never());
      const DoubleMask is_there = hn::And(goes, hn::Gt(share, splat_double(0.5)));
      on_a = select(is_there, then_a, on_a);
      on_b = select(is_there, then_b, on_b);
      end(hn::AndNot(hn::Gt(hn::Add(time, step), time), goes), unsure);
      step = hn::IfThenElseZero(goes, step);
      time = hn::IfThenElse(is_open, hn::Add(time, step), time);
    }

    const TurningMoment now(lanes, a, b, time);
    std::array<D3, 3> corner;
    for (size_t i = 0; i < 3; ++i) {
      D3 rate;
      now.place(get(lanes.on_a[i]), get(lanes.on_b[i]), corner[i], rate);
      put(rate, lanes.rate[i]);
    }
    D3 last, last_rate;
    now.place(on_a, on_b, last, last_rate);
    const PlainSearch search(corner, used, last);
    const PlainNearestLanes& nearer = search.nearest();
    end(hn::Not(hn::Or(hn::Gt(step, zero()), hn::Lt(nearer.squared, squared))), unsure);
    const Places kept = nearer.kept;
    const Places taken = hn::AndNot(kept, hn::Add(kept, places(1)));
    for (size_t i = 0; i < 3; ++i) {
      const DoubleMask is_taken = has_place(taken, i);
      put(select(is_taken, last, corner[i]), lanes.corner[i]);
      put(select(is_taken, last_rate, get(lanes.rate[i])), lanes.rate[i]);
      put(select(is_taken, on_a, get(lanes.on_a[i])), lanes.on_a[i]);
      put(select(is_taken, on_b, get(lanes.on_b[i])), lanes.on_b[i]);
    }
    used = hn::Or(kept, taken);
    point = nearer.point;
    squared = nearer.squared;
    is_around = nearer.is_around;
    is_unclear = nearer.is_unclear;
    rounds = hn::Add(rounds, one);
  }
  times.put(result);
  lanes.used.put(hn::BitCast(tag, used));
  put(point, lanes.point);
  lanes.time.put(time);
  lanes.squared.put(squared);
  lanes.rounds.put(rounds);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_IMPACTS_LINEAR_TURNING_APPROACH_INL_H_

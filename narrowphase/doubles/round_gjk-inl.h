// GJK for pairs of cores of which one is round, in each lane of doubles (round_gjk.h is the scalar
// form).
#if defined(CAROM_NARROWPHASE_DOUBLES_ROUND_GJK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_DOUBLES_ROUND_GJK_INL_H_
#undef CAROM_NARROWPHASE_DOUBLES_ROUND_GJK_INL_H_
#else
#define CAROM_NARROWPHASE_DOUBLES_ROUND_GJK_INL_H_
#endif

#include <array>

#include "base/tolerances.h"
#include "narrowphase/doubles/plain_gap-inl.h"
#include "narrowphase/doubles/round_gjk.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// A core in each lane, all of them round, or none. Round ones have one or two points, and an
// ellipsoid about each, as CoreRoundness says.
struct RoundCoreLanes {
  const HullPointLanes* points;
  bool is_round;
  std::array<D3, 3> axis;
  std::array<D, 2> share;

  // The support point along `way`.
  HWY_INLINE D3 furthest(const D3& way) const {
    if (!is_round) return points->furthest(way);
    const auto& [x, y, z] = axis;
    const D3 along{dot(x, way), dot(y, way), dot(z, way)};
    const D reach = hn::Sqrt(dot(along, along));
    D3 middle = get(points->point[0]);
    D of_middle = share[0];
    if (points->count > 1) {
      const D3 other = get(points->point[1]);
      const DoubleMask is_higher = hn::Gt(hn::Add(dot(way, other), hn::Mul(share[1], reach)),
                                          hn::Add(dot(way, middle), hn::Mul(share[0], reach)));
      middle = select(is_higher, other, middle);
      of_middle = hn::IfThenElse(is_higher, share[1], of_middle);
    }
    const D3 out =
        (x * hn::Div(along.x, reach) + y * hn::Div(along.y, reach)) + z * hn::Div(along.z, reach);
    const DoubleMask has_way = hn::Gt(reach, hn::Zero(DoubleTag()));
    return select(has_way, middle + out * of_middle, middle);
  }
};

struct RoundPairLanes {
  RoundCoreLanes a, b;
  D radius;  // of both together
};

struct RoundGapLanes {
  D size;
  D3 normal, of_a;
  DoubleMask is_found, is_proven;
};

// As scalar::is_as_near().
HWY_INLINE DoubleMask is_as_near(D gap, D squared) {
  const D less = hn::Sub(squared, gap);
  const auto share = [&](double s) HWY_ATTR { return hn::Mul(splat_double(s), squared); };
  const DoubleMask is_short = hn::Le(less, share(kSameRoundWay / 4));
  const DoubleMask is_good = hn::Le(hn::Mul(less, less), share(kSameRoundGap * kSameRoundGap));
  return hn::Or(hn::Le(less, share(scalar::kRoundedSquare)), hn::And(is_short, is_good));
}

// As scalar::RoundGjk.
class RoundGjkLanes {
 public:
  PlainSimplexLanes simplex, of_a;
  D3 point, last;
  D squared, gap;
  DoubleMask is_nearest = no_lanes_of<D>(), is_apart = no_lanes_of<D>(),
             is_within = no_lanes_of<D>(), is_around = no_lanes_of<D>();

  HWY_INLINE RoundGjkLanes(const RoundPairLanes& cores, const D3& between,
                           const scalar::RoundGoal& goal)
      : RoundGjkLanes(cores, lowest(cores, between + off_plane()), goal) {}

  // As scalar::RoundGjk::point_of_a().
  HWY_INLINE D3 point_of_a() const {
    const DoubleMask has_p = has_place(simplex.used, 0), has_q = has_place(simplex.used, 1),
                     has_r = has_place(simplex.used, 2);
    const auto first_of = [&](const std::array<D3, 3>& v)
                              HWY_ATTR { return select(has_p, v[0], select(has_q, v[1], v[2])); };
    const auto second_of = [&](const std::array<D3, 3>& v)
                               HWY_ATTR { return select(hn::And(has_p, has_q), v[1], v[2]); };
    const D3 p = first_of(simplex.corner), on_a = first_of(of_a.corner);
    const D3 u = second_of(simplex.corner) - p, way = point - p,
             along = second_of(of_a.corner) - on_a;
    const D3 beside = on_a + along * hn::Div(dot(way, u), dot(u, u));
    const D3 v = simplex.corner[2] - p, n = cross(u, v);
    const D each = hn::Div(splat_double(1), dot(n, n));
    const D of_u = hn::Mul(dot(n, cross(way, v)), each);
    const D of_v = hn::Mul(dot(n, cross(u, way)), each);
    const D3 over = (on_a + along * of_u) + (of_a.corner[2] - on_a) * of_v;
    const DoubleMask has_two = hn::Or(hn::And(has_p, has_q), hn::And(hn::Or(has_p, has_q), has_r));
    const DoubleMask has_three = hn::And(hn::And(has_p, has_q), has_r);
    return select(has_three, over, select(has_two, beside, on_a));
  }

 private:
  struct Corner {
    D3 point, of_a;
  };

  static HWY_INLINE D3 off_plane() {
    constexpr CoreVector kOff = scalar::kOffPlane;
    return {splat_double(kOff.x), splat_double(kOff.y), splat_double(kOff.z)};
  }
  // The corner of B - A that is lowest along `way`.
  static HWY_INLINE Corner lowest(const RoundPairLanes& cores, const D3& way) {
    const D3 of_a = cores.a.furthest(way);
    return {cores.b.furthest(-way) - of_a, of_a};
  }

  HWY_INLINE RoundGjkLanes(const RoundPairLanes& cores, const Corner& first,
                           const scalar::RoundGoal& goal)
      : simplex(first.point), of_a(first.of_a), point(first.point), last(first.point) {
    const DoubleTag tag;
    const D least = splat_double(scalar::kClearRoundGap), zero = hn::Zero(tag);
    const D clear = hn::Add(cores.radius, least);
    const D within = max(hn::Sub(cores.radius, least), zero);
    clear_squared_ = goal.decides_separate ? hn::Mul(clear, clear) : splat_double(HUGE_VAL);
    within_squared_ = goal.decides_overlapping ? hn::Mul(within, within) : zero;
    squared = dot(point, point);
    gap = hn::Zero(tag);
    DoubleMask is_open = hn::Gt(squared, splat_double(kTouchingSquared));
    run_round<1>(cores, is_open);
    run_round<2>(cores, is_open);
    for (int round = 2; round < scalar::kMostRoundRounds && !hn::AllFalse(tag, is_open); ++round) {
      run_round<3>(cores, is_open);
    }
  }

  // The simplex has no more than `kPlaces` corners.
  template <size_t kPlaces>
  HWY_INLINE void run_round(const RoundPairLanes& cores, DoubleMask& is_open) {
    const auto [next, next_of_a] = lowest(cores, point);
    const D product = dot(point, next);
    const DoubleMask ends =
        hn::And(is_open, hn::Or(is_as_near(product, squared), simplex.holds<kPlaces>(next)));
    gap = hn::IfThenElse(ends, product, gap);
    is_nearest = hn::Or(is_nearest, ends);
    is_open = hn::AndNot(ends, is_open);
    const DoubleMask parts = hn::And(is_open, hn::Gt(product, hn::Zero(DoubleTag())));
    const auto is_beyond = [&](D square) HWY_ATTR {
      return hn::And(parts, hn::Gt(hn::Mul(product, product), hn::Mul(square, squared)));
    };
    const DoubleMask is_clear = is_beyond(clear_squared_);
    constexpr double kLeast = scalar::kClearRoundGap;
    const DoubleMask is_near = hn::AndNot(
        is_clear,
        hn::And(is_beyond(splat_double(kLeast * kLeast)), hn::Lt(squared, within_squared_)));
    const DoubleMask is_decided = hn::Or(is_clear, is_near);
    gap = hn::IfThenElse(is_decided, product, gap);
    is_apart = hn::Or(is_apart, is_clear);
    is_within = hn::Or(is_within, is_near);
    is_open = hn::AndNot(is_decided, is_open);
    const PlainSearch<kPlaces> search(simplex.corner, simplex.used, next, scalar::kRoundSliver);
    const PlainNearestLanes& nearer = search.nearest();
    const DoubleMask is_in = hn::And(is_open, nearer.is_around);
    last = select(is_in, next, last);
    is_around = hn::Or(is_around, is_in);
    is_open = hn::AndNot(hn::Or(nearer.is_around, nearer.is_unclear), is_open);
    is_open = hn::And(is_open, hn::Lt(nearer.squared, squared));
    simplex.replace(is_open, nearer.kept, next);
    of_a.replace(is_open, nearer.kept, next_of_a);
    point = select(is_open, nearer.point, point);
    squared = hn::IfThenElse(is_open, nearer.squared, squared);
    is_open = hn::And(is_open, hn::Gt(squared, splat_double(kTouchingSquared)));
  }

  D clear_squared_, within_squared_;
};

// As scalar::find_plain_round_gap(). `between`: from a point inside of A to one inside of B.
HWY_INLINE RoundGapLanes find_plain_round_gap(const RoundPairLanes& cores, const D3& between,
                                              const scalar::RoundGoal& goal) {
  const RoundGjkLanes gjk(cores, between, goal);
  const D distance = hn::Sqrt(gjk.squared), parted = hn::Div(gjk.gap, distance);
  const D slack =
      min(splat_double(kSameRoundWayOut), hn::Mul(splat_double(kSameRoundWay), distance));
  const DoubleMask is_distance =
      hn::And(hn::And(gjk.is_nearest, hn::Gt(distance, splat_double(kTouchingRound))),
              hn::Le(hn::Sub(distance, parted), slack));
  RoundGapLanes gap{hn::IfThenElse(gjk.is_apart, parted, distance),
                    gjk.point * hn::Div(splat_double(1), distance), gjk.point_of_a(),
                    hn::Or(hn::Or(gjk.is_apart, gjk.is_within), is_distance),
                    hn::Or(hn::Le(distance, cores.radius),
                           hn::Gt(parted, hn::Add(cores.radius, splat_double(kProvenGap))))};
  if (goal.decides_overlapping && !hn::AllFalse(DoubleTag(), gjk.is_around)) {
    const auto& [p, q, r] = gjk.simplex.corner;
    const PortalLanes portal({p, q, r, gjk.last});
    const D height = portal.squared_height();
    const DoubleMask is_deep =
        hn::And(gjk.is_around, hn::Gt(height, splat_double(kProvenGap * kProvenGap)));
    gap.size = hn::IfThenElse(is_deep, hn::Neg(hn::Sqrt(height)), gap.size);
    gap.is_found = hn::Or(gap.is_found, is_deep);
    gap.is_proven = hn::Or(gap.is_proven, is_deep);
  }
  return gap;
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_DOUBLES_ROUND_GJK_INL_H_

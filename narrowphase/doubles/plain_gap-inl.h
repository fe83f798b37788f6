// The gap of two cores in each lane of doubles (plain_gjk.h and plain_gap.h are the scalar form and
// have the sources).
#if defined(CAROM_NARROWPHASE_DOUBLES_PLAIN_GAP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_DOUBLES_PLAIN_GAP_INL_H_
#undef CAROM_NARROWPHASE_DOUBLES_PLAIN_GAP_INL_H_
#else
#define CAROM_NARROWPHASE_DOUBLES_PLAIN_GAP_INL_H_
#endif

#include <array>

#include "base/tolerances.h"
#include "narrowphase/doubles/plain_gap.h"
#include "narrowphase/doubles/plain_simplex-inl.h"
#include "narrowphase/doubles/point_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

struct CorePairLanes {
  HullPointLanes a, b;
  LaneNumber count_a, count_b;  // of the points of each lane

  // The corner of B - A that is lowest along `way`.
  HWY_INLINE D3 lowest(const D3& way) const { return b.furthest(-way) - a.furthest(way); }
};

struct CoreGapLanes {
  D size;
  D3 normal;
  DoubleMask is_found, is_proven, is_at_corners;
};

// As scalar::PlainGjk.
class PlainGjkLanes {
 public:
  D3 point, last;
  PlainSimplexLanes simplex;
  D squared, gap;
  DoubleMask is_nearest = no_lanes_of<D>(), is_around = no_lanes_of<D>();

  HWY_INLINE PlainGjkLanes(const CorePairLanes& cores, const D3& between)
      : point(cores.lowest(between)), last(point), simplex(point) {
    const DoubleTag tag;
    squared = dot(point, point);
    gap = hn::Zero(tag);
    DoubleMask is_open = hn::Gt(squared, splat_double(kTouchingSquared));
    run_round<1>(cores.lowest(point), is_open);
    run_round<2>(cores.lowest(point), is_open);
    for (int round = 2; round < scalar::kMostPlainRounds && !hn::AllFalse(tag, is_open); ++round) {
      run_round<3>(cores.lowest(point), is_open);
    }
  }

 private:
  // The simplex has no more than `kPlaces` corners.
  template <size_t kPlaces>
  HWY_INLINE void run_round(const D3& next, DoubleMask& is_open) {
    const D product = dot(point, next);
    const DoubleMask ends =
        hn::And(is_open, hn::Or(hn::Ge(product, squared), simplex.holds<kPlaces>(next)));
    gap = hn::IfThenElse(ends, product, gap);
    is_nearest = hn::Or(is_nearest, ends);
    is_open = hn::AndNot(ends, is_open);
    const PlainSearch<kPlaces> search(simplex.corner, simplex.used, next);
    const PlainNearestLanes& nearer = search.nearest();
    const DoubleMask is_in = hn::And(is_open, nearer.is_around);
    last = select(is_in, next, last);
    is_around = hn::Or(is_around, is_in);
    is_open = hn::AndNot(hn::Or(nearer.is_around, nearer.is_unclear), is_open);
    is_open = hn::And(is_open, hn::Lt(nearer.squared, squared));
    simplex.replace(is_open, nearer.kept, next);
    point = select(is_open, nearer.point, point);
    squared = hn::IfThenElse(is_open, nearer.squared, squared);
    is_open = hn::And(is_open, hn::Gt(squared, splat_double(kTouchingSquared)));
  }
};

// As scalar::CoreFace.
struct CoreFaceLanes {
  D3 normal;
  D squared;
  DoubleMask is_sliver, is_under_zero;

  HWY_INLINE CoreFaceLanes(const D3& p, const D3& q, const D3& r) {
    const D3 u = q - p, v = r - p;
    normal = cross(u, v);
    squared = dot(normal, normal);
    is_sliver = hn::Not(
        hn::Gt(squared, hn::Mul(splat_double(kSliverSquared), hn::Mul(dot(u, u), dot(v, v)))));
    const D3 across = cross(normal, p);
    const D of_q = hn::Neg(dot(across, v)), of_r = dot(across, u);
    const D least = min(min(of_q, of_r), hn::Sub(squared, hn::Add(of_q, of_r)));
    is_under_zero = hn::Gt(least, hn::Mul(squared, splat_double(scalar::kWellInside)));
  }
};

// As scalar::find_nearest_gap().
HWY_INLINE void find_nearest_gap(const PlainGjkLanes& gjk, CoreGapLanes& out) {
  const auto& [p, q, r] = gjk.simplex.corner;
  const CoreFaceLanes face(p, q, r);
  const DoubleMask has_three = hn::RebindMask(DoubleTag(), hn::Eq(gjk.simplex.used, places(0b111)));
  const DoubleMask has_face = hn::AndNot(face.is_sliver, has_three);
  const D distance = hn::Sqrt(gjk.squared), parted = hn::Div(gjk.gap, distance);
  out.size = distance;
  out.normal = gjk.point * hn::Div(splat_double(1), distance);
  out.is_proven = hn::Gt(parted, splat_double(kProvenGap));
  out.is_at_corners = hn::Or(hn::Gt(distance, splat_double(kFarFromTouching)),
                             hn::And(has_face, face.is_under_zero));
  const DoubleMask is_clear =
      hn::Or(hn::Gt(distance, splat_double(kTouchingWay)),
             hn::And(hn::Gt(distance, splat_double(kTouchingCores)), has_face));
  const DoubleMask is_distance = hn::Le(hn::Sub(distance, parted), splat_double(kSameGap));
  out.is_found = hn::And(gjk.is_nearest, hn::And(is_clear, is_distance));
}

// As scalar::Portal.
class PortalLanes {
 public:
  HWY_INLINE explicit PortalLanes(const std::array<D3, 4>& corner) {
    squared_ = splat_double(HUGE_VAL);
    behind_ = p_ = q_ = r_ = corner[3];
    for (size_t i = 0; i < 4; ++i) {
      const D3 &a = corner[(i + 1) % 4], &b = corner[(i + 2) % 4], &c = corner[(i + 3) % 4];
      const D3 n = cross(b - a, c - a);
      const D height = dot(n, a), squared = hn::Div(hn::Mul(height, height), dot(n, n));
      const DoubleMask is_nearer = hn::Lt(squared, squared_);
      const DoubleMask is_front = hn::Gt(height, hn::Zero(DoubleTag()));
      squared_ = hn::IfThenElse(is_nearer, squared, squared_);
      behind_ = select(is_nearer, corner[i], behind_);
      p_ = select(is_nearer, a, p_);
      q_ = select(is_nearer, select(is_front, b, c), q_);
      r_ = select(is_nearer, select(is_front, c, b), r_);
    }
  }

  HWY_INLINE D squared_height() const { return squared_; }

  // Finds the gaps of the lanes in `is_open`.
  HWY_INLINE void find_gap(const CorePairLanes& cores, DoubleMask is_open, CoreGapLanes& out) {
    const DoubleTag tag;
    const D zero = hn::Zero(tag);
    for (int round = 0; round < scalar::kMostPortals && !hn::AllFalse(tag, is_open); ++round) {
      const CoreFaceLanes face(p_, q_, r_);
      const D3 n = face.normal * hn::Div(splat_double(1), hn::Sqrt(face.squared));
      const D height = dot(n, p_);
      is_open = hn::And(hn::AndNot(face.is_sliver, is_open), hn::Gt(height, zero));
      const D3 next = cores.lowest(-n);
      const D reach = dot(n, next);
      const DoubleMask ends =
          hn::And(is_open, hn::Le(hn::Sub(reach, height), splat_double(kSameWayOut)));
      out.size = hn::IfThenElse(ends, hn::Neg(reach), out.size);
      out.normal = select(ends, -n, out.normal);
      const DoubleMask is_proven = hn::Gt(reach, splat_double(kProvenGap));
      out.is_proven = hn::Or(hn::AndNot(ends, out.is_proven), hn::And(ends, is_proven));
      out.is_at_corners =
          hn::Or(hn::AndNot(ends, out.is_at_corners), hn::And(ends, face.is_under_zero));
      const DoubleMask is_least = hn::And(
          is_beyond(p_, q_, reach), hn::And(is_beyond(q_, r_, reach), is_beyond(r_, p_, reach)));
      out.is_found = hn::Or(out.is_found, hn::And(ends, is_least));
      is_open = hn::AndNot(ends, is_open);
      move_to(next, is_open);
    }
  }

 private:
  HWY_INLINE DoubleMask is_beyond(const D3& p, const D3& q, D reach) const {
    const D3 n = cross(p - behind_, q - behind_);
    const D height = hn::Neg(dot(n, behind_));
    return hn::And(hn::Gt(height, hn::Zero(DoubleTag())),
                   hn::Ge(hn::Mul(height, height), hn::Mul(hn::Mul(reach, reach), dot(n, n))));
  }

  HWY_INLINE void move_to(const D3& next, DoubleMask& is_open) {
    const D zero = hn::Zero(DoubleTag());
    const D3 across = cross(next, behind_);
    const DoubleMask p = hn::Gt(dot(across, p_), zero), q = hn::Gt(dot(across, q_), zero),
                     r = hn::Gt(dot(across, r_), zero);
    const DoubleMask at_p = hn::AndNot(r, q);
    const DoubleMask at_q = hn::AndNot(at_p, hn::AndNot(p, r));
    const DoubleMask at_r = hn::AndNot(hn::Or(at_p, at_q), hn::AndNot(q, p));
    p_ = select(at_p, next, p_);
    q_ = select(at_q, next, q_);
    r_ = select(at_r, next, r_);
    is_open = hn::And(is_open, hn::Or(at_p, hn::Or(at_q, at_r)));
  }

  D3 behind_, p_, q_, r_;
  D squared_;
};

// As scalar::find_plain_gap(). `between`: from a point inside of A to one inside of B.
HWY_INLINE void find_plain_gap(const CorePairLanes& cores, const D3& between, bool decides_only,
                               CoreGapLanes& out) {
  const PlainGjkLanes gjk(cores, between);
  find_nearest_gap(gjk, out);
  if (hn::AllFalse(DoubleTag(), gjk.is_around)) return;
  const auto& [p, q, r] = gjk.simplex.corner;
  PortalLanes portal({p, q, r, gjk.last});
  DoubleMask is_open = gjk.is_around;
  if (decides_only) {
    const D squared = portal.squared_height();
    const DoubleMask is_deep =
        hn::And(is_open, hn::Gt(squared, splat_double(kProvenGap * kProvenGap)));
    out.size = hn::IfThenElse(is_deep, hn::Neg(hn::Sqrt(squared)), out.size);
    out.is_proven = hn::Or(out.is_proven, is_deep);
    out.is_found = hn::Or(out.is_found, is_deep);
    is_open = hn::AndNot(is_deep, is_open);
  }
  portal.find_gap(cores, is_open, out);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_DOUBLES_PLAIN_GAP_INL_H_

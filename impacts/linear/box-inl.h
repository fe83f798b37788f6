// Times at which balls and capsules that move in a straight line meet boxes, in the frame of the
// box, one pair per lane (box_scalar.h is the scalar form).
#if defined(CAROM_IMPACTS_LINEAR_BOX_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_IMPACTS_LINEAR_BOX_INL_H_
#undef CAROM_IMPACTS_LINEAR_BOX_INL_H_
#else
#define CAROM_IMPACTS_LINEAR_BOX_INL_H_
#endif

#include "impacts/linear/crossing-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

struct SlabPassage {
  D enters, leaves;
  D before, after;

  HWY_INLINE SlabPassage(D from, D way, D half) {
    const DoubleMask stands = hn::Eq(way, zero()), is_inside = hn::Le(hn::Abs(from), half);
    const DoubleMask backwards = hn::Lt(way, zero());
    const D inverse = hn::IfThenZeroElse(stands, hn::Div(splat_double(1), way));
    const D first = hn::Mul(hn::Sub(hn::Neg(half), from), inverse);
    const D second = hn::Mul(hn::Sub(half, from), inverse);
    const D standing = hn::IfThenElse(is_inside, hn::Neg(never()), never());
    enters = hn::IfThenElse(stands, standing, min(first, second));
    leaves = hn::IfThenElse(stands, never(), max(first, second));
    const D below = hn::Add(from, half), above = hn::Sub(from, half);
    const DoubleMask comes_from_below =
        hn::Or(hn::And(stands, hn::Lt(from, zero())), hn::AndNot(stands, hn::Not(backwards)));
    before = hn::IfThenElse(comes_from_below, below, above);
    after = hn::IfThenElse(backwards, below, above);
  }

  HWY_INLINE DoubleMask is_inside(D t) const {
    return hn::And(hn::Ge(t, enters), hn::Lt(t, leaves));
  }
  HWY_INLINE D beyond(D t) const {
    return hn::IfThenElse(hn::Lt(t, enters), before, hn::IfThenZeroElse(hn::Lt(t, leaves), after));
  }
  HWY_INLINE D next(D t) const {
    return hn::IfThenElse(hn::Lt(t, enters), enters,
                          hn::IfThenElse(hn::Lt(t, leaves), leaves, never()));
  }
};

HWY_INLINE D meets_box(const MovingPoint& point, const D3& half, D reach) {
  const D one = splat_double(1);
  const SlabPassage x(point.from.x, point.way.x, half.x), y(point.from.y, point.way.y, half.y),
      z(point.from.z, point.way.z, half.z);
  D t = zero(), found = never();
  DoubleMask open = hn::Le(t, one);
  while (!hn::AllFalse(DoubleTag(), open)) {
    const D3 way = {hn::IfThenZeroElse(x.is_inside(t), point.way.x),
                    hn::IfThenZeroElse(y.is_inside(t), point.way.y),
                    hn::IfThenZeroElse(z.is_inside(t), point.way.z)};
    const Crossing crossing(moving_point({x.beyond(t), y.beyond(t), z.beyond(t)}, way), reach);
    const D next = min(min(x.next(t), y.next(t)), z.next(t));
    const D first = max(crossing.entry, t);
    const DoubleMask in_piece = hn::And(hn::Le(first, crossing.exit), hn::Le(first, next));
    const DoubleMask meets = hn::And(open, hn::And(crossing.meets, in_piece));
    found = hn::IfThenElse(hn::And(meets, hn::Le(first, one)), first, found);
    t = next;
    open = hn::And(hn::AndNot(meets, open), hn::Le(t, one));
  }
  return found;
}

HWY_INLINE DoubleMask passes_through_box(const D3& from, const D3& edge, const D3& half) {
  const SlabPassage x(from.x, edge.x, half.x), y(from.y, edge.y, half.y), z(from.z, edge.z, half.z);
  const D enters = max(max(x.enters, y.enters), max(z.enters, zero()));
  const D leaves = min(min(x.leaves, y.leaves), min(z.leaves, splat_double(1)));
  return hn::Le(enters, leaves);
}

HWY_INLINE D with_sign(D half, bool positive) { return positive ? half : hn::Neg(half); }

// Corner number `corner` of a box: bit k puts it at the upper end of axis k.
HWY_INLINE D3 corner_of_box(const D3& half, int corner) {
  return {with_sign(half.x, corner & 1), with_sign(half.y, corner & 2),
          with_sign(half.z, corner & 4)};
}

HWY_INLINE D meets_swept_edges(const MovingPoint& point, const D3& half, const Face& face, int axis,
                               D reach, D slack) {
  D first = never();
  for (int corner = 0; corner < 4; ++corner) {
    const int next = corner & 1 ? 1 << (axis + 1) % 3 : 0;
    const int last = corner & 2 ? 1 << (axis + 2) % 3 : 0;
    const MovingPoint from = seen_from(point, corner_of_box(half, next | last));
    first = min(first, meets_face<FaceKind::parallelogram>(from, face, reach, slack));
  }
  return first;
}

HWY_INLINE D meets_swept_corners(const MovingPoint& point, const D3& half, const D3& depth,
                                 D reach) {
  D first = never();
  for (int corner = 0; corner < 8; ++corner) {
    first = min(first, meets_edge(seen_from(point, corner_of_box(half, corner)), depth, reach));
  }
  return first;
}

HWY_INLINE D meets_box(const MovingPoint& point, const D3& edge, const D3& half, D reach, D slack) {
  const D two = splat_double(2);
  const D3 depth = -edge;
  const Face along_x({hn::Mul(two, half.x), zero(), zero()}, depth);
  const Face along_y({zero(), hn::Mul(two, half.y), zero()}, depth);
  const Face along_z({zero(), zero(), hn::Mul(two, half.z)}, depth);
  const D width = max(max(along_x.width(), along_y.width()), along_z.width());
  const D edge_reach = hn::Add(reach, width);
  const D ends =
      min(meets_box(point, half, edge_reach), meets_box(seen_from(point, depth), half, edge_reach));
  const D faces = min(meets_swept_edges(point, half, along_x, 0, reach, slack),
                      min(meets_swept_edges(point, half, along_y, 1, reach, slack),
                          meets_swept_edges(point, half, along_z, 2, reach, slack)));
  const D corners = meets_swept_corners(point, half, depth, edge_reach);
  const D first = min(ends, min(faces, corners));
  const D time = hn::IfThenZeroElse(passes_through_box(point.from, edge, half), first);
  return unless_slanted(hn::Or(along_x.is_slanted, hn::Or(along_y.is_slanted, along_z.is_slanted)),
                        time);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_IMPACTS_LINEAR_BOX_INL_H_

// Separating axes of convex polytopes that move in a straight line, one pair per lane
// (axes_scalar.h is the scalar form).
#if defined(CAROM_IMPACTS_LINEAR_AXES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_IMPACTS_LINEAR_AXES_INL_H_
#undef CAROM_IMPACTS_LINEAR_AXES_INL_H_
#else
#define CAROM_IMPACTS_LINEAR_AXES_INL_H_
#endif

#include "impacts/linear/crossing-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

class AxisTimes {
 public:
  HWY_INLINE AxisTimes()
      : entry_(hn::Neg(never())), exit_(never()), apart_(hn::Lt(zero(), zero())) {}

  HWY_INLINE void add(D middle, D rate, D reach) {
    const DoubleMask stands = hn::Eq(rate, zero());
    const D inverse = hn::IfThenZeroElse(stands, hn::Div(splat_double(1), rate));
    const D centre = hn::Neg(hn::Mul(middle, inverse));
    const D half = hn::IfThenElse(stands, never(), hn::Mul(reach, hn::Abs(inverse)));
    apart_ = hn::Or(apart_, hn::And(stands, hn::Gt(hn::Abs(middle), reach)));
    entry_ = max(hn::Sub(centre, half), entry_);
    exit_ = min(hn::Add(centre, half), exit_);
  }

  HWY_INLINE D first() const {
    return first_time(entry_, exit_, hn::AndNot(apart_, hn::Le(entry_, exit_)));
  }

 private:
  D entry_, exit_;
  DoubleMask apart_;
};

HWY_INLINE D sum_of_magnitudes(const D3& v) {
  return hn::Add(hn::Add(hn::Abs(v.x), hn::Abs(v.y)), hn::Abs(v.z));
}

HWY_INLINE D reach_of_box(const D3& half, const D3& n) {
  return hn::Add(hn::Add(hn::Mul(half.x, hn::Abs(n.x)), hn::Mul(half.y, hn::Abs(n.y))),
                 hn::Mul(half.z, hn::Abs(n.z)));
}

template <int kAxis>
HWY_INLINE D3 axis_cross(const D3& v) {
  if constexpr (kAxis == 0) return {zero(), hn::Neg(v.z), v.y};
  if constexpr (kAxis == 1) return {v.z, zero(), hn::Neg(v.x)};
  return {hn::Neg(v.y), v.x, zero()};
}

// A box B that moves past a box A, in the frame of A.
struct PassingBox {
  D3 at, way;
  D3 half_a, half_b;
  RotationOf<D> turn;
  D slack;
};

HWY_INLINE void add_axis(const PassingBox& box, const D3& n, D reach, AxisTimes& times) {
  times.add(dot(box.at, n), dot(box.way, n),
            hn::Add(reach, hn::Mul(box.slack, sum_of_magnitudes(n))));
}

// Adds the cross product of axis kAxis of A and `axis` of B. The two other axes of B follow, with
// their half extents.
template <int kAxis>
HWY_INLINE void add_cross(const PassingBox& box, const D3& axis, const D3& next, D half_next,
                          const D3& last, D half_last, AxisTimes& times) {
  const D3 n = axis_cross<kAxis>(axis);
  const D across =
      hn::Add(hn::Mul(half_next, hn::Abs(dot(n, next))), hn::Mul(half_last, hn::Abs(dot(n, last))));
  add_axis(box, n, hn::Add(reach_of_box(box.half_a, n), across), times);
}

template <int kAxis>
HWY_INLINE void add_crosses(const PassingBox& box, AxisTimes& times) {
  const RotationOf<D>& b = box.turn;
  const D3& half = box.half_b;
  add_cross<kAxis>(box, b.x, b.y, half.y, b.z, half.z, times);
  add_cross<kAxis>(box, b.y, b.z, half.z, b.x, half.x, times);
  add_cross<kAxis>(box, b.z, b.x, half.x, b.y, half.y, times);
}

HWY_INLINE D boxes_meet(const PassingBox& box) {
  const RotationOf<D>& b = box.turn;
  const auto seen = [&](D x, D y, D z) HWY_ATTR -> D {
    return reach_of_box(box.half_b, D3{x, y, z});
  };
  AxisTimes times;
  times.add(box.at.x, box.way.x,
            hn::Add(hn::Add(box.half_a.x, seen(b.x.x, b.y.x, b.z.x)), box.slack));
  times.add(box.at.y, box.way.y,
            hn::Add(hn::Add(box.half_a.y, seen(b.x.y, b.y.y, b.z.y)), box.slack));
  times.add(box.at.z, box.way.z,
            hn::Add(hn::Add(box.half_a.z, seen(b.x.z, b.y.z, b.z.z)), box.slack));
  add_axis(box, b.x, hn::Add(reach_of_box(box.half_a, b.x), box.half_b.x), times);
  add_axis(box, b.y, hn::Add(reach_of_box(box.half_a, b.y), box.half_b.y), times);
  add_axis(box, b.z, hn::Add(reach_of_box(box.half_a, b.z), box.half_b.z), times);
  add_crosses<0>(box, times);
  add_crosses<1>(box, times);
  add_crosses<2>(box, times);
  return times.first();
}

// A triangle that moves past a box about zero.
struct PassingTriangle {
  D3 a, b, c;
  D3 way, half;
  D slack;
};

HWY_INLINE void add_axis(const PassingTriangle& triangle, const D3& n, AxisTimes& times) {
  const D p = dot(triangle.a, n), q = dot(triangle.b, n), r = dot(triangle.c, n);
  const D low = min(min(p, q), r), high = max(max(p, q), r), share = splat_double(0.5);
  const D reach = hn::Add(reach_of_box(triangle.half, n), hn::Mul(hn::Sub(high, low), share));
  times.add(hn::Mul(hn::Add(high, low), share), dot(triangle.way, n),
            hn::Add(reach, hn::Mul(triangle.slack, sum_of_magnitudes(n))));
}

HWY_INLINE void add_edge(const PassingTriangle& triangle, const D3& edge, AxisTimes& times) {
  add_axis(triangle, axis_cross<0>(edge), times);
  add_axis(triangle, axis_cross<1>(edge), times);
  add_axis(triangle, axis_cross<2>(edge), times);
}

HWY_INLINE D box_meets_triangle(const PassingTriangle& triangle) {
  const D one = splat_double(1);
  AxisTimes times;
  add_axis(triangle, D3{one, zero(), zero()}, times);
  add_axis(triangle, D3{zero(), one, zero()}, times);
  add_axis(triangle, D3{zero(), zero(), one}, times);
  const D3 first = triangle.b - triangle.a, second = triangle.c - triangle.b;
  add_axis(triangle, cross(first, second), times);
  add_edge(triangle, first, times);
  add_edge(triangle, second, times);
  add_edge(triangle, triangle.a - triangle.c, times);
  return times.first();
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_IMPACTS_LINEAR_AXES_INL_H_

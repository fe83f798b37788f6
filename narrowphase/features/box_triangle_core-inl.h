// Box against triangle in lanes. The box is centred at the origin, along the coordinate axes.
// Sources and reasons: box_triangle_core_scalar.h.
#if defined(CAROM_NARROWPHASE_FEATURES_BOX_TRIANGLE_CORE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_FEATURES_BOX_TRIANGLE_CORE_INL_H_
#undef CAROM_NARROWPHASE_FEATURES_BOX_TRIANGLE_CORE_INL_H_
#else
#define CAROM_NARROWPHASE_FEATURES_BOX_TRIANGLE_CORE_INL_H_
#endif

#include <type_traits>

#include "narrowphase/batch/shape_lanes-inl.h"
#include "narrowphase/features/rounded-inl.h"
#include "narrowphase/features/segment_box-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// The triangle in the frame of the box: three edges, each from its corner to the next.
template <class V>
struct PlacedTriangleOf {
  DirectedSegmentOf<V> ab, bc, ca;
  Lanes3<V> sizes;  // greatest components of the edges

  HWY_INLINE PlacedTriangleOf(const Lanes3<V>& a, const Lanes3<V>& a_to_b, const Lanes3<V>& b_to_c,
                              const Lanes3<V>& c_to_a)
      : ab(a, a_to_b),
        bc(a + a_to_b, b_to_c),
        ca(a - c_to_a, c_to_a),
        sizes{largest_component(a_to_b), largest_component(b_to_c), largest_component(c_to_a)} {}

  HWY_INLINE const Lanes3<V>& a() const { return ab.start; }
  HWY_INLINE const Lanes3<V>& b() const { return bc.start; }
  HWY_INLINE const Lanes3<V>& c() const { return ca.start; }

  HWY_INLINE void move_back(const Lanes3<V>& by) {
    ab.start = ab.start - by;
    bc.start = bc.start - by;
    ca.start = ca.start - by;
  }

  HWY_INLINE void extent(const Lanes3<V>& n, V& low, V& high) const {
    const V at_a = dot(n, a()), at_b = dot(n, b()), at_c = dot(n, c());
    low = min(min(at_a, at_b), at_c);
    high = max(max(at_a, at_b), at_c);
  }
};

// Takes differences before it moves the corners: so short edges keep their direction.
template <class V>
HWY_INLINE PlacedTriangleOf<V> place_triangle(const TriangleOf<V>& t, const RotationOf<V>& turn,
                                              const Lanes3<V>& position) {
  return {rotate(turn, t.a) + position, rotate(turn, t.b - t.a), rotate(turn, t.c - t.b),
          rotate(turn, t.a - t.c)};
}

// The normal of the plane, of any length and to either side; zero if the triangle is a segment.
template <class V>
HWY_INLINE Lanes3<V> plane_normal(const PlacedTriangleOf<V>& triangle) {
  const Lanes3<V>& size = triangle.sizes;
  const Lanes3<V>& ab = triangle.ab.direction;
  const Lanes3<V>& bc = triangle.bc.direction;
  const Lanes3<V>& ca = triangle.ca.direction;
  const AxisMasksOf<V> longest = greatest_axis(size);
  const Lanes3<V> base = select(longest.x, ab, select(longest.y, bc, ca));
  const Lanes3<V> next = select(longest.x, bc, select(longest.y, ca, ab));
  const Lanes3<V> last = select(longest.x, ca, select(longest.y, ab, bc));
  const V size_next = pick(longest, Lanes3<V>{size.y, size.z, size.x});
  const V size_last = pick(longest, Lanes3<V>{size.z, size.x, size.y});
  const Lanes3<V> side = select(hn::Le(size_next, size_last), next, last);
  const V squared = dot(base, base);
  const V share =
      hn::IfThenElseZero(hn::Gt(squared, splat_as<V>(0)), hn::Div(dot(side, base), squared));
  const Lanes3<V> height = side - base * share;
  V up, down;
  power_of_two(largest_component(height), up, down);
  return cross(base, height * down);
}

template <class V>
HWY_INLINE void separating_axis(const PlacedTriangleOf<V>& triangle, const Lanes3<V>& normal,
                                const Lanes3<V>& half, V& gap, Lanes3<V>& axis) {
  const Lanes3<V>& a = triangle.a();
  const Lanes3<V>& b = triangle.b();
  const Lanes3<V>& c = triangle.c();
  AxisSearchOf<V> search(half, min(min(a, b), c), max(max(a, b), c));
  V low, high;
  triangle.extent(normal, low, high);
  search.try_axis(normal, dot(normal, normal), reach(half, normal), low, high);
  search.try_crosses(triangle.ab.direction, a, c);
  search.try_crosses(triangle.bc.direction, b, a);
  search.try_crosses(triangle.ca.direction, c, b);
  search.best(gap, axis);
}

// The best pair of points of a box and a triangle so far.
template <class V>
class NearestPairOf {
 public:
  HWY_INLINE NearestPairOf(const PlacedTriangleOf<V>& triangle, const Lanes3<V>& half,
                           MaskOf<V> overlap)
      : triangle_(triangle), half_(half), overlap_(overlap) {
    rank_of_edge(triangle.ab, point_, way_, certain_, rank_);
  }

  HWY_INLINE void try_edge(const DirectedSegmentOf<V>& edge) {
    Lanes3<V> point, way;
    V certain, rank;
    rank_of_edge(edge, point, way, certain, rank);
    keep_if(hn::Gt(rank, rank_), point, way, certain, rank);
  }

  // Tries the corner of the box that is nearest to the plane, if it projects into the triangle.
  HWY_INLINE void try_face(const Lanes3<V>& normal) {
    const V zero = splat_as<V>(0);
    const V squared = dot(normal, normal);
    const MaskOf<V> is_face = hn::Gt(squared, zero);
    const V to_unit = hn::IfThenElseZero(is_face, hn::Div(splat_as<V>(1), hn::Sqrt(squared)));
    const MaskOf<V> is_below = hn::Lt(dot(normal, triangle_.a()), zero);
    const Lanes3<V> n = normal * hn::IfThenElse(is_below, hn::Neg(to_unit), to_unit);
    const Lanes3<V> corner = {hn::IfThenElse(hn::Lt(n.x, zero), hn::Neg(half_.x), half_.x),
                              hn::IfThenElse(hn::Lt(n.y, zero), hn::Neg(half_.y), half_.y),
                              hn::IfThenElse(hn::Lt(n.z, zero), hn::Neg(half_.z), half_.z)};
    V low, high;
    triangle_.extent(n, low, high);
    const V gap = hn::Sub(low, reach(half_, n));
    const V rank = rank_of(hn::Abs(gap), gap);
    const MaskOf<V> is_over = hn::And(is_face, is_over_face(corner, n));
    keep_if(hn::And(is_over, hn::Ge(rank, rank_)), corner + n * gap, n * gap, gap, rank);
  }

  const Lanes3<V>& point() const { return point_; }  // on the triangle
  const Lanes3<V>& way() const { return way_; }      // from the box
  V certain() const { return certain_; }             // the gap along its direction

 private:
  // The pair with the greatest rank is the best. Of separate shapes: the gap along the direction
  // less the distance, which is zero for the nearest points and less for all others, up to
  // rounding. Of overlapping shapes: minus the distance.
  HWY_INLINE V rank_of(V distance, V certain) const {
    return hn::IfThenElse(overlap_, hn::Neg(distance), hn::Sub(certain, distance));
  }

  HWY_INLINE void rank_of_edge(const DirectedSegmentOf<V>& edge, Lanes3<V>& point, Lanes3<V>& way,
                               V& certain, V& rank) const {
    nearest_to_box(edge, half_, point, way);
    V distance, low, high;
    const Lanes3<V> n = direction_of(way, distance);
    triangle_.extent(n, low, high);
    certain = hn::Sub(low, reach(half_, n));
    rank = rank_of(distance, certain);
  }

  HWY_INLINE void keep_if(MaskOf<V> is_better, const Lanes3<V>& point, const Lanes3<V>& way,
                          V certain, V rank) {
    point_ = select(is_better, point, point_);
    way_ = select(is_better, way, way_);
    certain_ = hn::IfThenElse(is_better, certain, certain_);
    rank_ = hn::IfThenElse(is_better, rank, rank_);
  }

  HWY_INLINE V side_of(const DirectedSegmentOf<V>& edge, const Lanes3<V>& corner,
                       const Lanes3<V>& n) const {
    return dot(cross(n, edge.direction), corner - edge.start);
  }

  HWY_INLINE MaskOf<V> is_over_face(const Lanes3<V>& corner, const Lanes3<V>& n) const {
    const V ab = side_of(triangle_.ab, corner, n);
    const V bc = side_of(triangle_.bc, corner, n);
    const V ca = side_of(triangle_.ca, corner, n);
    return hn::Or(hn::Ge(min(min(ab, bc), ca), splat_as<V>(0)),
                  hn::Le(max(max(ab, bc), ca), splat_as<V>(0)));
  }

  const PlacedTriangleOf<V>& triangle_;
  const Lanes3<V>& half_;
  MaskOf<V> overlap_;
  Lanes3<V> point_, way_;
  V certain_, rank_;
};

// Moves an overlapping triangle out of the box first; the nearest points are then the contact
// location.
template <class V>
HWY_INLINE void box_triangle_contact(PlacedTriangleOf<V>& triangle, const Lanes3<V>& half,
                                     BoxContactOf<V>& contact) {
  const Lanes3<V> plane = plane_normal(triangle);
  V gap;
  separating_axis(triangle, plane, half, gap, contact.normal);

  const Lanes3<V> inwards = contact.normal * min(gap, splat_as<V>(0));
  triangle.move_back(inwards);
  // The direction between points that nearly touch is only rounding. In floats such a pair is
  // unsure.
  constexpr bool kIsDouble = std::is_same_v<V, D>;
  NearestPairOf<V> best(triangle, half, hn::Le(gap, splat_as<V>(kIsDouble ? 0x1p-36 : 0)));
  best.try_edge(triangle.bc);
  best.try_edge(triangle.ca);
  best.try_face(plane);
  contact.on_box = best.point() - beyond(best.point(), half);
  contact.on_other = best.point() + inwards;

  const MaskOf<V> near_touch = is_near_touch(gap);
  const MaskOf<V> no_normal =
      choose_normal(best.way(), best.certain(), gap, contact.normal, contact.separation);
  contact.unsure = hn::Or(near_touch, no_normal);
}

// The greatest gap, which is the decision.
template <class V>
HWY_INLINE V gap_of(const PlacedTriangleOf<V>& triangle, const Lanes3<V>& half) {
  V gap;
  Lanes3<V> axis;
  separating_axis(triangle, plane_normal(triangle), half, gap, axis);
  return gap;
}

template <class V, class Report>
HWY_INLINE void report_decision(V gap, MaskOf<V> unsure, Report& report) {
  const V zero = splat_as<V>(0);
  const Lanes3<V> none = {zero, zero, zero};
  report(hn::Le(gap, splat_as<V>(0)), hn::Or(unsure, is_near_touch(gap)), no_lanes_of<V>(), gap,
         none, none, none);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_FEATURES_BOX_TRIANGLE_CORE_INL_H_

// Box against triangle in lanes. The box is centred at the origin, along the coordinate axes.
// Sources and reasons: box_triangle_core_scalar.h.
#if defined(CAROM_NARROWPHASE_FEATURES_BOX_TRIANGLE_CORE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_FEATURES_BOX_TRIANGLE_CORE_INL_H_
#undef CAROM_NARROWPHASE_FEATURES_BOX_TRIANGLE_CORE_INL_H_
#else
#define CAROM_NARROWPHASE_FEATURES_BOX_TRIANGLE_CORE_INL_H_
#endif

#include "narrowphase/batch/shape_lanes-inl.h"
#include "narrowphase/features/rounded-inl.h"
#include "narrowphase/features/segment_box-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// The triangle in the frame of the box: three edges, each from its corner to the next.
struct PlacedTriangle {
  DirectedSegment ab, bc, ca;
  F3 sizes;  // greatest components of the edges

  HWY_INLINE PlacedTriangle(const F3& a, const F3& a_to_b, const F3& b_to_c, const F3& c_to_a)
      : ab(a, a_to_b),
        bc(a + a_to_b, b_to_c),
        ca(a - c_to_a, c_to_a),
        sizes{largest_component(a_to_b), largest_component(b_to_c), largest_component(c_to_a)} {}

  HWY_INLINE const F3& a() const { return ab.start; }
  HWY_INLINE const F3& b() const { return bc.start; }
  HWY_INLINE const F3& c() const { return ca.start; }

  HWY_INLINE void move_back(const F3& by) {
    ab.start = ab.start - by;
    bc.start = bc.start - by;
    ca.start = ca.start - by;
  }

  HWY_INLINE void extent(const F3& n, F& low, F& high) const {
    const F at_a = dot(n, a()), at_b = dot(n, b()), at_c = dot(n, c());
    low = min(min(at_a, at_b), at_c);
    high = max(max(at_a, at_b), at_c);
  }
};

// Takes differences before it moves the corners: so short edges keep their direction.
HWY_INLINE PlacedTriangle place_triangle(const TriangleLanes& t, const Rotation& turn,
                                         const F3& position) {
  return {rotate(turn, t.a) + position, rotate(turn, t.b - t.a), rotate(turn, t.c - t.b),
          rotate(turn, t.a - t.c)};
}

// The normal of the plane, of any length and to either side; zero if the triangle is a segment.
HWY_INLINE F3 plane_normal(const PlacedTriangle& triangle) {
  const F3& size = triangle.sizes;
  const F3& ab = triangle.ab.direction;
  const F3& bc = triangle.bc.direction;
  const F3& ca = triangle.ca.direction;
  const AxisMasks longest = greatest_axis(size);
  const F3 base = select(longest.x, ab, select(longest.y, bc, ca));
  const F3 next = select(longest.x, bc, select(longest.y, ca, ab));
  const F3 last = select(longest.x, ca, select(longest.y, ab, bc));
  const F size_next = pick(longest, {size.y, size.z, size.x});
  const F size_last = pick(longest, {size.z, size.x, size.y});
  const F3 side = select(hn::Le(size_next, size_last), next, last);
  const F squared = dot(base, base);
  const F share = hn::IfThenElseZero(hn::Gt(squared, splat(0)), hn::Div(dot(side, base), squared));
  const F3 height = side - base * share;
  F up, down;
  power_of_two(largest_component(height), up, down);
  return cross(base, height * down);
}

HWY_INLINE void separating_axis(const PlacedTriangle& triangle, const F3& normal, const F3& half,
                                F& gap, F3& axis) {
  const F3& a = triangle.a();
  const F3& b = triangle.b();
  const F3& c = triangle.c();
  AxisSearch search(half, min(min(a, b), c), max(max(a, b), c));
  F low, high;
  triangle.extent(normal, low, high);
  search.try_axis(normal, dot(normal, normal), reach(half, normal), low, high);
  search.try_crosses(triangle.ab.direction, a, c);
  search.try_crosses(triangle.bc.direction, b, a);
  search.try_crosses(triangle.ca.direction, c, b);
  search.best(gap, axis);
}

// The best pair of points of a box and a triangle so far.
class NearestPair {
 public:
  HWY_INLINE NearestPair(const PlacedTriangle& triangle, const F3& half, Mask overlap)
      : triangle_(triangle), half_(half), overlap_(overlap) {
    rank_of_edge(triangle.ab, point_, way_, certain_, rank_);
  }

  HWY_INLINE void try_edge(const DirectedSegment& edge) {
    F3 point, way;
    F certain, rank;
    rank_of_edge(edge, point, way, certain, rank);
    keep_if(hn::Gt(rank, rank_), point, way, certain, rank);
  }

  // Tries the corner of the box that is nearest to the plane, if it projects into the triangle.
  HWY_INLINE void try_face(const F3& normal) {
    const F zero = splat(0);
    const F squared = dot(normal, normal);
    const Mask is_face = hn::Gt(squared, zero);
    const F to_unit = hn::IfThenElseZero(is_face, hn::Div(splat(1), hn::Sqrt(squared)));
    const Mask is_below = hn::Lt(dot(normal, triangle_.a()), zero);
    const F3 n = normal * hn::IfThenElse(is_below, hn::Neg(to_unit), to_unit);
    const F3 corner = {hn::IfThenElse(hn::Lt(n.x, zero), hn::Neg(half_.x), half_.x),
                       hn::IfThenElse(hn::Lt(n.y, zero), hn::Neg(half_.y), half_.y),
                       hn::IfThenElse(hn::Lt(n.z, zero), hn::Neg(half_.z), half_.z)};
    F low, high;
    triangle_.extent(n, low, high);
    const F gap = hn::Sub(low, reach(half_, n));
    const F rank = rank_of(hn::Abs(gap), gap);
    const Mask is_over = hn::And(is_face, is_over_face(corner, n));
    keep_if(hn::And(is_over, hn::Ge(rank, rank_)), corner + n * gap, n * gap, gap, rank);
  }

  const F3& point() const { return point_; }  // on the triangle
  const F3& way() const { return way_; }      // from the box
  F certain() const { return certain_; }      // the gap along its direction

 private:
  // The pair with the greatest rank is the best. Of separate shapes: the gap along the direction
  // less the distance, which is zero for the nearest points and less for all others, up to
  // rounding. Of overlapping shapes: minus the distance.
  HWY_INLINE F rank_of(F distance, F certain) const {
    return hn::IfThenElse(overlap_, hn::Neg(distance), hn::Sub(certain, distance));
  }

  HWY_INLINE void rank_of_edge(const DirectedSegment& edge, F3& point, F3& way, F& certain,
                               F& rank) const {
    nearest_to_box(edge, half_, point, way);
    F distance, low, high;
    const F3 n = direction_of(way, distance);
    triangle_.extent(n, low, high);
    certain = hn::Sub(low, reach(half_, n));
    rank = rank_of(distance, certain);
  }

  HWY_INLINE void keep_if(Mask is_better, const F3& point, const F3& way, F certain, F rank) {
    point_ = select(is_better, point, point_);
    way_ = select(is_better, way, way_);
    certain_ = hn::IfThenElse(is_better, certain, certain_);
    rank_ = hn::IfThenElse(is_better, rank, rank_);
  }

  HWY_INLINE F side_of(const DirectedSegment& edge, const F3& corner, const F3& n) const {
    return dot(cross(n, edge.direction), corner - edge.start);
  }

  HWY_INLINE Mask is_over_face(const F3& corner, const F3& n) const {
    const F ab = side_of(triangle_.ab, corner, n);
    const F bc = side_of(triangle_.bc, corner, n);
    const F ca = side_of(triangle_.ca, corner, n);
    return hn::Or(hn::Ge(min(min(ab, bc), ca), splat(0)), hn::Le(max(max(ab, bc), ca), splat(0)));
  }

  const PlacedTriangle& triangle_;
  const F3& half_;
  Mask overlap_;
  F3 point_, way_;
  F certain_, rank_;
};

// Moves an overlapping triangle out of the box first; the nearest points are then the contact
// location.
HWY_INLINE void box_triangle_contact(PlacedTriangle& triangle, const F3& half,
                                     BoxContact& contact) {
  const F3 plane = plane_normal(triangle);
  F gap;
  separating_axis(triangle, plane, half, gap, contact.normal);

  const F3 inwards = contact.normal * min(gap, splat(0));
  triangle.move_back(inwards);
  NearestPair best(triangle, half, hn::Le(gap, splat(0)));
  best.try_edge(triangle.bc);
  best.try_edge(triangle.ca);
  best.try_face(plane);
  contact.on_box = best.point() - beyond(best.point(), half);
  contact.on_other = best.point() + inwards;

  const Mask near_touch = is_near_touch(gap);
  const Mask no_normal =
      choose_normal(best.way(), best.certain(), gap, contact.normal, contact.separation);
  contact.unsure = hn::Or(near_touch, no_normal);
}

// The greatest gap, which is the decision.
HWY_INLINE F gap_of(const PlacedTriangle& triangle, const F3& half) {
  F gap;
  F3 axis;
  separating_axis(triangle, plane_normal(triangle), half, gap, axis);
  return gap;
}

template <class Report>
HWY_INLINE void report_decision(F gap, Mask unsure, Report& report) {
  const F3 none = splat3(0);
  report(hn::Le(gap, splat(0)), hn::Or(unsure, is_near_touch(gap)), no_lanes(), gap, none, none,
         none);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_FEATURES_BOX_TRIANGLE_CORE_INL_H_

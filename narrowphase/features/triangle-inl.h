// Triangles as cores, and the nearest point of a triangle to a point, in lanes. Sources and
// reasons: triangle_scalar.h.
#if defined(CAROM_NARROWPHASE_FEATURES_TRIANGLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_FEATURES_TRIANGLE_INL_H_
#undef CAROM_NARROWPHASE_FEATURES_TRIANGLE_INL_H_
#else
#define CAROM_NARROWPHASE_FEATURES_TRIANGLE_INL_H_
#endif

#include "narrowphase/features/segment-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// Corners in the order of the triangle, starting with its longest edge; edge i leads from corner i
// to the next. A triangle without a face (no area) is its longest edge: its third corner is set to
// the first.
template <class V>
struct TriangleCoreOf {
  Lanes3<V> corner[3];
  Lanes3<V> edge[3];
  V squared[3];      // of the edges
  Lanes3<V> normal;  // not a unit vector
  MaskOf<V> has_face;

  HWY_INLINE TriangleCoreOf(const Lanes3<V>& a, const Lanes3<V>& b, const Lanes3<V>& c)
      : corner{a, b, c} {
    start_with_longest();
    normal = cross(edge[1], edge[2]);
    // Rounding of a sliver's third corner may turn the normal about the longest edge; but the
    // normal must be perpendicular to that edge.
    const V share = hn::IfThenElseZero(hn::Gt(squared[0], splat_as<V>(0)),
                                       hn::Div(dot(normal, edge[0]), squared[0]));
    normal = normal - edge[0] * share;
    using Tolerance = CoreTolerance<hn::TFromV<V>>;
    has_face = hn::Gt(dot(normal, normal),
                      max(hn::Mul(splat_as<V>(Tolerance::kFlat), hn::Mul(squared[0], squared[0])),
                          splat_as<V>(Tolerance::kVanishing)));
    corner[2] = select(has_face, corner[2], corner[0]);
    measure_edge(1);
    measure_edge(2);
  }

 private:
  HWY_INLINE void start_with_longest() {
    for (size_t i = 0; i < 3; ++i) measure_edge(i);
    const MaskOf<V> second =
        hn::And(hn::Gt(squared[1], squared[0]), hn::Ge(squared[1], squared[2]));
    const MaskOf<V> third = hn::AndNot(second, hn::Gt(squared[2], squared[0]));
    const Lanes3<V> a = corner[0], b = corner[1], c = corner[2];
    corner[0] = select(second, b, select(third, c, a));
    corner[1] = select(second, c, select(third, a, b));
    corner[2] = select(second, a, select(third, b, c));
    for (size_t i = 0; i < 3; ++i) measure_edge(i);
  }

  HWY_INLINE void measure_edge(size_t i) {
    edge[i] = corner[(i + 1) % 3] - corner[i];
    squared[i] = dot(edge[i], edge[i]);
  }
};

using TriangleCore = TriangleCoreOf<F>;

// One edge as a point sees it.
template <class V>
struct EdgeViewOf {
  Lanes3<V> way;         // to the nearest point of the edge's line
  MaskOf<V> is_before;   // projects before the first end, or on it
  MaskOf<V> is_past;     // projects past the second end, or on it
  MaskOf<V> is_outside;  // the triangle lies on the far side of the edge

  // `from` and `past`: from the two ends to the point.
  HWY_INLINE EdgeViewOf(const Lanes3<V>& from, const Lanes3<V>& past,
                        const TriangleCoreOf<V>& triangle, size_t i) {
    const V zero = splat_as<V>(0);
    const Lanes3<V>& edge = triangle.edge[i];
    const V squared = triangle.squared[i];
    const V along = dot(from, edge);
    is_before = hn::Le(along, zero);
    is_past = hn::Ge(dot(past, edge), zero);
    way = edge * hn::IfThenElseZero(hn::Gt(squared, zero), hn::Div(along, squared)) - from;
    is_outside =
        hn::Or(hn::Not(triangle.has_face), hn::Gt(dot(way, cross(triangle.normal, edge)), zero));
  }

  HWY_INLINE MaskOf<V> is_nearest() const {
    return hn::AndNot(hn::Or(is_before, is_past), is_outside);
  }
};

// From a point to the nearest point of a triangle: the direction, not a unit vector, and the
// distance. Returns the lanes in which the nearest feature is the face: those whose point is in the
// region of no edge and no corner.
template <class V>
HWY_INLINE MaskOf<V> nearest_on_triangle(const Lanes3<V>& p, const TriangleCoreOf<V>& triangle,
                                         Lanes3<V>& way, V& distance) {
  const Lanes3<V> from[3] = {p - triangle.corner[0], p - triangle.corner[1],
                             p - triangle.corner[2]};
  const EdgeViewOf<V> views[3] = {{from[0], from[1], triangle, 0},
                                  {from[1], from[2], triangle, 1},
                                  {from[2], from[0], triangle, 2}};
  const MaskOf<V> is_outside =
      hn::Or(views[0].is_outside, hn::Or(views[1].is_outside, views[2].is_outside));
  const V height = dot(from[0], triangle.normal);
  way = negate_if(hn::Ge(height, splat_as<V>(0)), triangle.normal);
  MaskOf<V> is_face = hn::Not(no_lanes_of<V>());
  for (size_t i = 3; i-- > 0;) {
    const MaskOf<V> at_corner =
        hn::And(is_outside, hn::And(views[i].is_before, views[(i + 2) % 3].is_past));
    way = select(at_corner, -from[i], way);
    is_face = hn::AndNot(at_corner, is_face);
  }
  Lanes3<V> edge = triangle.edge[0];
  V squared = triangle.squared[0];
  MaskOf<V> is_edge = no_lanes_of<V>();
  for (size_t i = 3; i-- > 0;) {
    const MaskOf<V> nearest = views[i].is_nearest();
    way = select(nearest, views[i].way, way);
    edge = select(nearest, triangle.edge[i], edge);
    squared = hn::IfThenElse(nearest, triangle.squared[i], squared);
    is_edge = hn::Or(is_edge, nearest);
  }
  way = select(is_edge, way - edge * hn::Div(dot(way, edge), squared), way);
  is_face = hn::AndNot(is_edge, is_face);
  const V length = hn::Sqrt(dot(way, way));
  distance = hn::IfThenElse(is_face, hn::Div(hn::Abs(height), length), length);
  return is_face;
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_FEATURES_TRIANGLE_INL_H_

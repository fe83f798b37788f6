// Capsule against triangle: the capsule's segment against the triangle. Their Minkowski difference
// is a prism; the distance to its nearest side is the separation of the cores (Ericson 2005, 5.1.10
// and 5.3.4).
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/capsule/capsule_triangle.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/features/rounded-inl.h"
#include "narrowphase/features/triangle-inl.h"
#include "narrowphase/manifolds/manifold-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

// The edge of a triangle that is nearest to the segment d, and the edge that ends where that one
// starts (`last`).
template <class V>
struct NearestEdgeOf {
  V squared, s, ee;
  V t;
  Lanes3<V> delta, edge, last;

  HWY_INLINE void find(const Lanes3<V>& r, const Lanes3<V>& d, V dd,
                       const TriangleCoreOf<V>& triangle, size_t i) {
    edge = triangle.edge[i];
    ee = triangle.squared[i];
    last = triangle.edge[(i + 2) % 3];
    nearest_of_segments(r, d, dd, edge, ee, s, t, delta);
    squared = dot(delta, delta);
  }

  HWY_INLINE void replace_if_closer(const NearestEdgeOf& other) {
    const MaskOf<V> closer = hn::Lt(other.squared, squared);
    squared = hn::IfThenElse(closer, other.squared, squared);
    s = hn::IfThenElse(closer, other.s, s);
    t = hn::IfThenElse(closer, other.t, t);
    ee = hn::IfThenElse(closer, other.ee, ee);
    delta = select(closer, other.delta, delta);
    edge = select(closer, other.edge, edge);
    last = select(closer, other.last, last);
  }
};

struct CapsuleTriangle {
  using A = CapsuleLanes;
  using B = TriangleLanes;
  static constexpr Units kUnits = Units::scaled;
  static constexpr Unsure kUnsure = Unsure::in_lanes;

  template <class V, class Report>
  static HWY_INLINE void test(const PoseOf<V>& pose, const CapsuleOf<V>& capsule,
                              const TriangleOf<V>& triangle, Report& report) {
    const V zero = splat_as<V>(0);
    const RotationOf<V> turn_a = rotation_of(pose.a);
    const RotationOf<V> turn_b = rotation_of(pose.b);
    const TriangleCoreOf<V> core(rotate(turn_b, triangle.a) + pose.d,
                                 rotate(turn_b, triangle.b) + pose.d,
                                 rotate(turn_b, triangle.c) + pose.d);
    const Lanes3<V> p = rotate(turn_a, capsule.a);
    const Lanes3<V> d = rotate(turn_a, capsule.b - capsule.a);
    const V dd = dot(d, d);
    const Lanes3<V> r[3] = {core.corner[0] - p, core.corner[1] - p, core.corner[2] - p};

    NearestEdgeOf<V> nearest, other;
    nearest.find(r[0], d, dd, core, 0);
    other.find(r[1], d, dd, core, 1);
    nearest.replace_if_closer(other);
    other.find(r[2], d, dd, core, 2);
    nearest.replace_if_closer(other);

    const V scale = hn::Div(splat_as<V>(1), hn::Sqrt(dot(core.normal, core.normal)));
    const Lanes3<V> unit_normal = core.normal * hn::IfThenElseZero(core.has_face, scale);
    const V height_p = hn::Neg(dot(r[0], unit_normal));
    const V height_q = hn::Add(height_p, dot(d, unit_normal));
    const MaskOf<V> through = passes_through(r, d, core, height_p, height_q);

    // Takes the face if the end that is nearer to the plane is over it, and no edge is nearer.
    const MaskOf<V> starts_nearer = hn::Le(hn::Abs(height_p), hn::Abs(height_q));
    const V height = hn::IfThenElse(starts_nearer, height_p, height_q);
    const V far_height = hn::IfThenElse(starts_nearer, height_q, height_p);
    const V bound = hn::Mul(nearest.squared, splat_as<V>(CoreTolerance<hn::TFromV<V>>::kTie));
    const MaskOf<V> is_face = hn::And(hn::Le(hn::Mul(height, height), bound),
                                      is_over(r, zero_unless(hn::Not(starts_nearer), d), core));

    Lanes3<V> way;
    const MaskOf<V> is_across =
        way_between(d, dd, nearest.edge, nearest.ee, nearest.s, nearest.t, nearest.delta, way);
    // If `way` is perpendicular to the edge and the segment, its sign is that for which the third
    // corner of the triangle lies ahead.
    const Lanes3<V> ahead = negate_if(through, nearest.delta);
    const Lanes3<V> far = ahead - zero_unless(is_across, nearest.last);
    way = negate_if(hn::Lt(dot(way, far), zero), way);
    const V length = hn::Sqrt(dot(way, way));
    const V to_unit = hn::Div(splat_as<V>(1), length);
    const V gap =
        hn::IfThenElse(is_across, hn::Mul(hn::Abs(dot(nearest.delta, way)), to_unit), length);

    const V distance = hn::IfThenElse(is_face, hn::Abs(height), gap);
    const V core_separation = hn::IfThenElse(through, hn::Neg(distance), distance);
    const Lanes3<V> normal =
        select(is_face, negate_if(hn::Ge(far_height, zero), unit_normal), way * to_unit);
    const V end = hn::IfThenElse(starts_nearer, zero, splat_as<V>(1));
    const Lanes3<V> point = p + d * hn::IfThenElse(is_face, end, nearest.s);
    // So near to an edge, float32 cannot tell on which side of it the segment is.
    const MaskOf<V> near_edge = hn::AndNot(
        is_face, hn::Le(distance, splat_as<V>(CoreTolerance<hn::TFromV<V>>::kNearEdges)));
    const MaskOf<V> unsure =
        hn::Or(hn::Or(near_edge, is_tilted(normal, r, d, core_separation)), triangle.is_special);
    report_grown(point, point + normal * core_separation, normal, core_separation, capsule.radius,
                 zero, pose, unsure, no_lanes_of<V>(), report);
  }

 private:
  // Whether the ends are on both sides of the plane, and the line on the same side of all edges. A
  // segment that lies in the plane, up to rounding, does not pass through it.
  template <class V>
  static HWY_INLINE MaskOf<V> passes_through(const Lanes3<V>* r, const Lanes3<V>& d,
                                             const TriangleCoreOf<V>& core, V height_p,
                                             V height_q) {
    const V zero = splat_as<V>(0);
    const V rise = hn::Abs(hn::Sub(height_q, height_p));
    const MaskOf<V> crosses = hn::And(
        hn::Gt(rise, splat_as<V>(CoreTolerance<hn::TFromV<V>>::kShallow)),
        hn::And(hn::Le(min(height_p, height_q), zero), hn::Ge(max(height_p, height_q), zero)));
    const V side0 = dot(r[0], cross(d, core.edge[0]));
    const V side1 = dot(r[1], cross(d, core.edge[1]));
    const V side2 = dot(r[2], cross(d, core.edge[2]));
    const MaskOf<V> inside = hn::Or(hn::Ge(min(min(side0, side1), side2), zero),
                                    hn::Le(max(max(side0, side1), side2), zero));
    return hn::And(hn::And(core.has_face, crosses), inside);
  }

  // Whether the end of the segment is over the face; r: from the start of the segment to the
  // corners.
  template <class V>
  static HWY_INLINE MaskOf<V> is_over(const Lanes3<V>* r, const Lanes3<V>& end,
                                      const TriangleCoreOf<V>& core) {
    MaskOf<V> outside = hn::Not(core.has_face);
    for (size_t i = 0; i < 3; ++i) {
      const Lanes3<V> inwards = cross(core.normal, core.edge[i]);
      outside = hn::Or(outside, hn::Gt(dot(r[i] - end, inwards), splat_as<V>(0)));
    }
    return hn::Not(outside);
  }

  // Whether the gap between the projections on the normal is less than the separation.
  template <class V>
  static HWY_INLINE MaskOf<V> is_tilted(const Lanes3<V>& n, const Lanes3<V>* r, const Lanes3<V>& d,
                                        V separation) {
    const V low = min(min(dot(n, r[0]), dot(n, r[1])), dot(n, r[2]));
    const V gap = hn::Sub(low, max(dot(n, d), splat_as<V>(0)));
    return hn::Lt(gap, hn::Sub(separation, splat_as<V>(CoreTolerance<hn::TFromV<V>>::kTilt)));
  }
};

void capsule_triangle(const Batch& batch) {
  if (batch.pass == Pass::manifold) return run_manifold<CapsuleLanes, TriangleLanes>(batch);
  run_batch<CapsuleTriangle>(batch);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(capsule_triangle);

void run_capsule_triangle(const Batch& batch) { CAROM_DISPATCH(capsule_triangle)(batch); }

}  // namespace carom
#endif  // HWY_ONCE

// Triangle against triangle: separating axes tell whether they cross and how deep, features how far
// apart they are (Ericson 2005, 5.2.10 and 5.1.10). If they cross, B is moved out of A first: the
// nearest features are then the contact location.
#include <limits>
#include <type_traits>

#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/triangle/triangle_triangle.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "base/tolerances.h"
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/features/rounded-inl.h"
#include "narrowphase/features/triangle-inl.h"
#include "narrowphase/manifolds/manifold-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

template <class V>
HWY_INLINE Lanes3<V> zero3() {
  const V zero = splat_as<V>(0);
  return {zero, zero, zero};
}

// Zero if the triangle has no face.
template <class V>
HWY_INLINE Lanes3<V> unit_normal(const TriangleCoreOf<V>& triangle) {
  const V scale = hn::Div(splat_as<V>(1), hn::Sqrt(dot(triangle.normal, triangle.normal)));
  return triangle.normal * hn::IfThenElseZero(triangle.has_face, scale);
}

// The axis with the greatest gap between the projections of two triangles; ties go to the first
// axis.
template <class V>
class TriangleAxes {
 public:
  V gap = splat_as<V>(0);
  Lanes3<V> normal = zero3<V>();

  HWY_INLINE TriangleAxes(const TriangleCoreOf<V>& a, const TriangleCoreOf<V>& b)
      : a_(a), r_{b.corner[0] - a.corner[0], b.corner[1] - a.corner[0], b.corner[2] - a.corner[0]} {
    try_axis(a.normal, a.has_face);
    try_axis(b.normal, b.has_face);
    for (size_t i = 0; i < 3; ++i) {
      for (size_t j = 0; j < 3; ++j) {
        try_cross(a.edge[i], a.squared[i], b.edge[j], b.squared[j]);
      }
    }
  }

  HWY_INLINE MaskOf<V> exists() const { return exists_; }
  HWY_INLINE MaskOf<V> is_crossing() const {
    return hn::And(exists_, hn::Lt(gap, splat_as<V>(-CoreTolerance<hn::TFromV<V>>::kShallow)));
  }

  // The gap from A to B along the unit vector n.
  HWY_INLINE V gap_along(const Lanes3<V>& n) const {
    V low_a, high_a, low_b, high_b;
    project(n, low_a, high_a, low_b, high_b);
    return hn::Sub(low_b, high_a);
  }

 private:
  HWY_INLINE void try_cross(const Lanes3<V>& edge, V squared, const Lanes3<V>& other,
                            V other_squared) {
    const Lanes3<V> n = cross(edge, other);
    const V least = max(hn::Mul(splat_as<V>(CoreTolerance<hn::TFromV<V>>::kSameDirection),
                                hn::Mul(squared, other_squared)),
                        splat_as<V>(CoreTolerance<hn::TFromV<V>>::kVanishing));
    // Once perpendicular to this edge, n is perpendicular to the other up to rounding, however
    // nearly parallel they are.
    try_axis(n - edge * hn::Div(dot(n, edge), squared), hn::Gt(dot(n, n), least));
  }

  HWY_INLINE void try_axis(const Lanes3<V>& axis, MaskOf<V> is_axis) {
    const Lanes3<V> n = axis * hn::Div(splat_as<V>(1), hn::Sqrt(dot(axis, axis)));
    V low_a, high_a, low_b, high_b;
    project(n, low_a, high_a, low_b, high_b);
    const V above = hn::Sub(low_b, high_a);
    const V below = hn::Sub(low_a, high_b);
    const V new_gap = max(above, below);
    const MaskOf<V> better = hn::And(is_axis, hn::Or(hn::Not(exists_), hn::Gt(new_gap, gap)));
    gap = hn::IfThenElse(better, new_gap, gap);
    normal = select(better, negate_if(hn::Lt(above, below), n), normal);
    exists_ = hn::Or(exists_, is_axis);
  }

  HWY_INLINE void project(const Lanes3<V>& n, V& low_a, V& high_a, V& low_b, V& high_b) const {
    const V zero = splat_as<V>(0);
    const V along_first = dot(n, a_.edge[0]);
    const V along_last = hn::Neg(dot(n, a_.edge[2]));
    low_a = min(min(along_first, along_last), zero);
    high_a = max(max(along_first, along_last), zero);
    const V b[3] = {dot(n, r_[0]), dot(n, r_[1]), dot(n, r_[2])};
    low_b = min(min(b[0], b[1]), b[2]);
    high_b = max(max(b[0], b[1]), b[2]);
  }

  const TriangleCoreOf<V>& a_;
  Lanes3<V> r_[3];  // from the first corner of A to the corners of B
  MaskOf<V> exists_ = no_lanes_of<V>();
};

// The corner that is nearest to a face, among the corners that project into it.
template <class V>
struct CornerOverFace {
  MaskOf<V> found = no_lanes_of<V>();
  V height = splat_as<V>(0);
  Lanes3<V> corner = zero3<V>();
  Lanes3<V> normal;  // of the face, unit

  HWY_INLINE CornerOverFace(const TriangleCoreOf<V>& face, const Lanes3<V>* corners)
      : normal(unit_normal(face)) {
    for (size_t k = 0; k < 3; ++k) {
      const Lanes3<V>& x = corners[k];
      const V new_height = dot(x - face.corner[0], normal);
      MaskOf<V> outside = hn::Not(face.has_face);
      for (size_t i = 0; i < 3; ++i) {
        const Lanes3<V> inwards = cross(face.normal, face.edge[i]);
        outside = hn::Or(outside, hn::Lt(dot(x - face.corner[i], inwards), splat_as<V>(0)));
      }
      const MaskOf<V> nearer = hn::Or(hn::Not(found), hn::Lt(hn::Abs(new_height), hn::Abs(height)));
      const MaskOf<V> take = hn::AndNot(outside, nearer);
      height = hn::IfThenElse(take, new_height, height);
      corner = select(take, x, corner);
      found = hn::Or(found, take);
    }
  }

  HWY_INLINE V squared() const { return hn::Mul(height, height); }
};

// The nearest features of two triangles that do not cross.
template <class V>
struct NearestOfTriangles {
  V distance;
  Lanes3<V> normal;  // from A to B
  Lanes3<V> point;   // on A

  HWY_INLINE NearestOfTriangles(const TriangleCoreOf<V>& a, const TriangleCoreOf<V>& b) {
    // An edge below a corner is equally near, up to rounding: then it takes the face.
    V bound = hn::Mul(take_edges(a, b), splat_as<V>(CoreTolerance<hn::TFromV<V>>::kTie));
    const CornerOverFace over_a(a, b.corner);
    const MaskOf<V> at_a = hn::And(over_a.found, hn::Le(over_a.squared(), bound));
    bound = hn::IfThenElse(at_a, over_a.squared(), bound);
    distance = hn::IfThenElse(at_a, hn::Abs(over_a.height), distance);
    normal = select(at_a, negate_if(hn::Lt(over_a.height, splat_as<V>(0)), over_a.normal), normal);
    point = select(at_a, over_a.corner - over_a.normal * over_a.height, point);

    const CornerOverFace over_b(b, a.corner);
    const MaskOf<V> at_b = hn::And(over_b.found, hn::Le(over_b.squared(), bound));
    distance = hn::IfThenElse(at_b, hn::Abs(over_b.height), distance);
    normal = select(at_b, negate_if(hn::Ge(over_b.height, splat_as<V>(0)), over_b.normal), normal);
    point = select(at_b, over_b.corner, point);
  }

 private:
  // Sets the results to those of the nearest edges, and returns their squared distance.
  HWY_INLINE V take_edges(const TriangleCoreOf<V>& a, const TriangleCoreOf<V>& b) {
    V squared = splat_as<V>(std::numeric_limits<hn::TFromV<V>>::max()), s = splat_as<V>(0), t = s,
      aa = s, bb = s;
    Lanes3<V> delta = zero3<V>(), edge_a = delta, edge_b = delta;
    point = delta;
    for (size_t i = 0; i < 3; ++i) {
      for (size_t j = 0; j < 3; ++j) {
        V new_s, new_t;
        Lanes3<V> new_delta;
        nearest_of_segments(b.corner[j] - a.corner[i], a.edge[i], a.squared[i], b.edge[j],
                            b.squared[j], new_s, new_t, new_delta);
        const V new_squared = dot(new_delta, new_delta);
        const MaskOf<V> closer = hn::Lt(new_squared, squared);
        squared = hn::IfThenElse(closer, new_squared, squared);
        s = hn::IfThenElse(closer, new_s, s);
        t = hn::IfThenElse(closer, new_t, t);
        aa = hn::IfThenElse(closer, a.squared[i], aa);
        bb = hn::IfThenElse(closer, b.squared[j], bb);
        delta = select(closer, new_delta, delta);
        edge_a = select(closer, a.edge[i], edge_a);
        edge_b = select(closer, b.edge[j], edge_b);
        point = select(closer, a.corner[i] + a.edge[i] * new_s, point);
      }
    }
    Lanes3<V> way;
    const MaskOf<V> is_across = way_between(edge_a, aa, edge_b, bb, s, t, delta, way);
    const V height = dot(delta, way);
    way = negate_if(hn::And(is_across, hn::Lt(height, splat_as<V>(0))), way);
    const V length = hn::Sqrt(dot(way, way));
    const V to_unit = hn::Div(splat_as<V>(1), length);
    distance = hn::IfThenElse(is_across, hn::Mul(hn::Abs(height), to_unit), length);
    normal = way * to_unit;
    return squared;
  }
};

struct TriangleTriangle {
  using A = TriangleLanes;
  using B = TriangleLanes;
  static constexpr Units kUnits = Units::scaled;
  static constexpr Unsure kUnsure = Unsure::in_lanes;

  template <class V, class Report>
  static HWY_INLINE void test(const PoseOf<V>& pose, const TriangleOf<V>& a, const TriangleOf<V>& b,
                              Report& report) {
    using Tolerance = CoreTolerance<hn::TFromV<V>>;
    const V zero = splat_as<V>(0);
    const TriangleCoreOf<V> core_a = placed(a, pose.a, zero3<V>());
    TriangleCoreOf<V> core_b = placed(b, pose.b, pose.d);
    const TriangleAxes<V> axes(core_a, core_b);
    const MaskOf<V> is_crossing = axes.is_crossing();
    const Lanes3<V> way_out = axes.normal * hn::IfThenElseZero(is_crossing, hn::Neg(axes.gap));
    for (Lanes3<V>& corner : core_b.corner) corner = corner + way_out;
    const NearestOfTriangles<V> nearest(core_a, core_b);

    const V separation = hn::IfThenElse(is_crossing, axes.gap, nearest.distance);
    Lanes3<V> normal = select(is_crossing, axes.normal, nearest.normal);
    MaskOf<V> unsure = hn::Or(a.is_special, b.is_special);
    if constexpr (std::is_same_v<V, D>) {
      // Between triangles that touch there is no good direction: an axis gives the normal.
      const MaskOf<V> touching =
          hn::AndNot(is_crossing, hn::Le(nearest.distance, splat_as<V>(Tolerance::kNearEdges)));
      normal = select(touching, axes.normal, normal);
      unsure = hn::Or(unsure, hn::AndNot(axes.exists(), touching));
    } else {
      const V least = hn::Sub(separation, splat_as<V>(Tolerance::kTilt));
      const MaskOf<V> is_tilted = hn::AndNot(is_crossing, hn::Lt(axes.gap_along(normal), least));
      unsure = hn::Or(unsure, is_tilted);
    }
    report_grown(nearest.point, nearest.point + normal * separation, normal, separation, zero, zero,
                 pose, unsure, no_lanes_of<V>(), report);
  }

 private:
  template <class V>
  static HWY_INLINE TriangleCoreOf<V> placed(const TriangleOf<V>& triangle,
                                             const QuaternionOf<V>& q, const Lanes3<V>& position) {
    const RotationOf<V> turn = rotation_of(q);
    return {rotate(turn, triangle.a) + position, rotate(turn, triangle.b) + position,
            rotate(turn, triangle.c) + position};
  }
};

void triangle_triangle(const Batch& batch) {
  if (batch.pass == Pass::manifold) return run_manifold<TriangleLanes, TriangleLanes>(batch);
  run_batch<TriangleTriangle>(batch);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(triangle_triangle);

void run_triangle_triangle(const Batch& batch) { CAROM_DISPATCH(triangle_triangle)(batch); }

}  // namespace carom
#endif  // HWY_ONCE

// Triangle against triangle: separating axes tell whether they cross and how deep, features how far
// apart they are (Ericson 2005, 5.2.10 and 5.1.10). If they cross, B is moved out of A first: the
// nearest features are then the contact location.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/triangle/triangle_triangle.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/features/rounded-inl.h"
#include "narrowphase/features/triangle-inl.h"
#include "narrowphase/manifolds/manifold-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

using Tolerance = CoreTolerance<float>;

// Zero if the triangle has no face.
HWY_INLINE F3 unit_normal(const TriangleCore& triangle) {
  const F scale = hn::Div(splat(1), hn::Sqrt(dot(triangle.normal, triangle.normal)));
  return triangle.normal * hn::IfThenElseZero(triangle.has_face, scale);
}

// The axis with the greatest gap between the projections of two triangles; ties go to the first
// axis.
class TriangleAxes {
 public:
  F gap = splat(0);
  F3 normal = splat3(0);

  HWY_INLINE TriangleAxes(const TriangleCore& a, const TriangleCore& b)
      : a_(a), r_{b.corner[0] - a.corner[0], b.corner[1] - a.corner[0], b.corner[2] - a.corner[0]} {
    try_axis(a.normal, a.has_face);
    try_axis(b.normal, b.has_face);
    for (size_t i = 0; i < 3; ++i) {
      for (size_t j = 0; j < 3; ++j) {
        try_cross(a.edge[i], a.squared[i], b.edge[j], b.squared[j]);
      }
    }
  }

  HWY_INLINE Mask is_crossing() const {
    return hn::And(exists_, hn::Lt(gap, splat(-Tolerance::kShallow)));
  }

  // The gap from A to B along the unit vector n.
  HWY_INLINE F gap_along(const F3& n) const {
    F low_a, high_a, low_b, high_b;
    project(n, low_a, high_a, low_b, high_b);
    return hn::Sub(low_b, high_a);
  }

 private:
  HWY_INLINE void try_cross(const F3& edge, F squared, const F3& other, F other_squared) {
    const F3 n = cross(edge, other);
    const F least = max(hn::Mul(splat(Tolerance::kSameDirection), hn::Mul(squared, other_squared)),
                        splat(Tolerance::kVanishing));
    // Once perpendicular to this edge, n is perpendicular to the other up to rounding, however
    // nearly parallel they are.
    try_axis(n - edge * hn::Div(dot(n, edge), squared), hn::Gt(dot(n, n), least));
  }

  HWY_INLINE void try_axis(const F3& axis, Mask is_axis) {
    const F3 n = axis * hn::Div(splat(1), hn::Sqrt(dot(axis, axis)));
    F low_a, high_a, low_b, high_b;
    project(n, low_a, high_a, low_b, high_b);
    const F above = hn::Sub(low_b, high_a);
    const F below = hn::Sub(low_a, high_b);
    const F new_gap = max(above, below);
    const Mask better = hn::And(is_axis, hn::Or(hn::Not(exists_), hn::Gt(new_gap, gap)));
    gap = hn::IfThenElse(better, new_gap, gap);
    normal = select(better, negate_if(hn::Lt(above, below), n), normal);
    exists_ = hn::Or(exists_, is_axis);
  }

  HWY_INLINE void project(const F3& n, F& low_a, F& high_a, F& low_b, F& high_b) const {
    const F zero = splat(0);
    const F along_first = dot(n, a_.edge[0]);
    const F along_last = hn::Neg(dot(n, a_.edge[2]));
    low_a = min(min(along_first, along_last), zero);
    high_a = max(max(along_first, along_last), zero);
    const F b[3] = {dot(n, r_[0]), dot(n, r_[1]), dot(n, r_[2])};
    low_b = min(min(b[0], b[1]), b[2]);
    high_b = max(max(b[0], b[1]), b[2]);
  }

  const TriangleCore& a_;
  F3 r_[3];  // from the first corner of A to the corners of B
  Mask exists_ = no_lanes();
};

// The corner that is nearest to a face, among the corners that project into it.
struct CornerOverFace {
  Mask found = no_lanes();
  F height = splat(0);
  F3 corner = splat3(0);
  F3 normal;  // of the face, unit

  HWY_INLINE CornerOverFace(const TriangleCore& face, const F3* corners)
      : normal(unit_normal(face)) {
    for (size_t k = 0; k < 3; ++k) {
      const F3& x = corners[k];
      const F new_height = dot(x - face.corner[0], normal);
      Mask outside = hn::Not(face.has_face);
      for (size_t i = 0; i < 3; ++i) {
        const F3 inwards = cross(face.normal, face.edge[i]);
        outside = hn::Or(outside, hn::Lt(dot(x - face.corner[i], inwards), splat(0)));
      }
      const Mask nearer = hn::Or(hn::Not(found), hn::Lt(hn::Abs(new_height), hn::Abs(height)));
      const Mask take = hn::AndNot(outside, nearer);
      height = hn::IfThenElse(take, new_height, height);
      corner = select(take, x, corner);
      found = hn::Or(found, take);
    }
  }

  HWY_INLINE F squared() const { return hn::Mul(height, height); }
};

// The nearest features of two triangles that do not cross.
struct NearestOfTriangles {
  F distance;
  F3 normal;  // from A to B
  F3 point;   // on A

  HWY_INLINE NearestOfTriangles(const TriangleCore& a, const TriangleCore& b) {
    // An edge below a corner is equally near, up to rounding: then it takes the face.
    F bound = hn::Mul(take_edges(a, b), splat(Tolerance::kTie));
    const CornerOverFace over_a(a, b.corner);
    const Mask at_a = hn::And(over_a.found, hn::Le(over_a.squared(), bound));
    bound = hn::IfThenElse(at_a, over_a.squared(), bound);
    distance = hn::IfThenElse(at_a, hn::Abs(over_a.height), distance);
    normal = select(at_a, negate_if(hn::Lt(over_a.height, splat(0)), over_a.normal), normal);
    point = select(at_a, over_a.corner - over_a.normal * over_a.height, point);

    const CornerOverFace over_b(b, a.corner);
    const Mask at_b = hn::And(over_b.found, hn::Le(over_b.squared(), bound));
    distance = hn::IfThenElse(at_b, hn::Abs(over_b.height), distance);
    normal = select(at_b, negate_if(hn::Ge(over_b.height, splat(0)), over_b.normal), normal);
    point = select(at_b, over_b.corner, point);
  }

 private:
  // Sets the results to those of the nearest edges, and returns their squared distance.
  HWY_INLINE F take_edges(const TriangleCore& a, const TriangleCore& b) {
    F squared = splat(FLT_MAX), s = splat(0), t = s, aa = s, bb = s;
    F3 delta = splat3(0), edge_a = delta, edge_b = delta;
    point = delta;
    for (size_t i = 0; i < 3; ++i) {
      for (size_t j = 0; j < 3; ++j) {
        F new_s, new_t;
        F3 new_delta;
        nearest_of_segments(b.corner[j] - a.corner[i], a.edge[i], a.squared[i], b.edge[j],
                            b.squared[j], new_s, new_t, new_delta);
        const F new_squared = dot(new_delta, new_delta);
        const Mask closer = hn::Lt(new_squared, squared);
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
    F3 way;
    const Mask is_across = way_between(edge_a, aa, edge_b, bb, s, t, delta, way);
    const F height = dot(delta, way);
    way = negate_if(hn::And(is_across, hn::Lt(height, splat(0))), way);
    const F length = hn::Sqrt(dot(way, way));
    const F to_unit = hn::Div(splat(1), length);
    distance = hn::IfThenElse(is_across, hn::Mul(hn::Abs(height), to_unit), length);
    normal = way * to_unit;
    return squared;
  }
};

struct TriangleTriangle {
  using A = TriangleLanes;
  using B = TriangleLanes;
  static constexpr Units kUnits = Units::scaled;
  static constexpr Unsure kUnsure = Unsure::everything;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const A& a, const B& b, Report& report) {
    const TriangleCore core_a = placed(a, pose.a, splat3(0));
    TriangleCore core_b = placed(b, pose.b, pose.d);
    const TriangleAxes axes(core_a, core_b);
    const Mask is_crossing = axes.is_crossing();
    const F3 way_out = axes.normal * hn::IfThenElseZero(is_crossing, hn::Neg(axes.gap));
    for (F3& corner : core_b.corner) corner = corner + way_out;
    const NearestOfTriangles nearest(core_a, core_b);

    const F separation = hn::IfThenElse(is_crossing, axes.gap, nearest.distance);
    const F3 normal = select(is_crossing, axes.normal, nearest.normal);
    const Mask is_tilted = hn::AndNot(
        is_crossing, hn::Lt(axes.gap_along(normal), hn::Sub(separation, splat(Tolerance::kTilt))));
    const Mask is_special = hn::Or(a.is_special, b.is_special);
    report_grown(nearest.point, nearest.point + normal * separation, normal, separation, splat(0),
                 splat(0), pose, hn::Or(is_tilted, is_special), no_lanes(), report);
  }

 private:
  static HWY_INLINE TriangleCore placed(const TriangleLanes& triangle, const Quaternion& q,
                                        const F3& position) {
    const Rotation turn = rotation_of(q);
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

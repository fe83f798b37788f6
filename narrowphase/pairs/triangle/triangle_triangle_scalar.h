// Triangle against triangle: separating axes tell whether and how deep they cross, features how far
// they are apart.
//
// Source: C. Ericson, Real-Time Collision Detection, 2005, sections 5.2.10 (axes) and 5.1.10
// (distance). If they cross, B is moved out of A first: the nearest features are then the contact
// location.
#pragma once

#include "narrowphase/doubles/special_triangle.h"
#include "narrowphase/features/rounded_scalar.h"
#include "narrowphase/features/triangle_scalar.h"

namespace carom::scalar {

// Zero if the triangle has no face.
template <class Real>
Vector3<Real> unit_normal(const TriangleCore<Real>& triangle) {
  const Real squared = dot(triangle.normal, triangle.normal);
  return triangle.normal * (triangle.has_face ? 1 / std::sqrt(squared) : 0);
}

// The axis with the greatest gap between the projections of two triangles; ties go to the first
// axis.
template <class Real>
class TriangleAxes {
 public:
  using Vector = Vector3<Real>;
  using Tolerance = CoreTolerance<Real>;

  TriangleAxes(const TriangleCore<Real>& a, const TriangleCore<Real>& b) : a_(a), b_(b) {
    if (a.has_face) try_axis(a.normal);
    if (b.has_face) try_axis(b.normal);
    for (size_t i = 0; i < 3; ++i) {
      for (size_t j = 0; j < 3; ++j) try_cross(i, j);
    }
  }

  bool exists() const { return exists_; }
  Real gap() const { return gap_; }
  const Vector& normal() const { return normal_; }
  bool is_crossing() const { return exists_ && gap_ < -Tolerance::kShallow; }

  // The gap from A to B along the unit vector n.
  Real gap_along(const Vector& n) const { return low_b(n) - high_a(n); }

 private:
  Real high_a(const Vector& n) const {
    const Real zero = 0;
    return max(max(dot(n, a_.edge[0]), -dot(n, a_.edge[2])), zero);
  }
  Real low_a(const Vector& n) const {
    const Real zero = 0;
    return min(min(dot(n, a_.edge[0]), -dot(n, a_.edge[2])), zero);
  }
  Real b(const Vector& n, size_t i) const { return dot(n, Vector(b_.corner[i] - a_.corner[0])); }
  Real low_b(const Vector& n) const { return min(min(b(n, 0), b(n, 1)), b(n, 2)); }
  Real high_b(const Vector& n) const { return max(max(b(n, 0), b(n, 1)), b(n, 2)); }

  void try_cross(size_t i, size_t j) {
    const Vector& edge = a_.edge[i];
    const Vector n = cross(edge, b_.edge[j]);
    const Real sizes = a_.squared[i] * b_.squared[j];
    if (!(dot(n, n) > max(Tolerance::kSameDirection * sizes, Tolerance::kVanishing))) return;
    // Once perpendicular to this edge, n is perpendicular to the other up to rounding, however
    // nearly parallel they are.
    try_axis(n - edge * (dot(n, edge) / a_.squared[i]));
  }

  void try_axis(const Vector& axis) {
    const Vector n = axis * (1 / std::sqrt(dot(axis, axis)));
    const Real above = low_b(n) - high_a(n);
    const Real below = low_a(n) - high_b(n);
    const Real gap = max(above, below);
    if (exists_ && !(gap > gap_)) return;
    exists_ = true;
    gap_ = gap;
    normal_ = above >= below ? n : Vector(-n);
  }

  const TriangleCore<Real>& a_;
  const TriangleCore<Real>& b_;
  bool exists_ = false;
  Real gap_ = 0;
  Vector normal_ = Vector::Zero();
};

// The corner that is nearest to a face, among the corners that project into it.
template <class Real>
struct CornerOverFace {
  bool found = false;
  Real height = 0;
  Vector3<Real> corner = Vector3<Real>::Zero();
  Vector3<Real> unit_normal;

  CornerOverFace(const TriangleCore<Real>& face, const std::array<Vector3<Real>, 3>& corners)
      : unit_normal(scalar::unit_normal(face)) {
    if (!face.has_face) return;
    for (const Vector3<Real>& x : corners) {
      const Real new_height = dot(Vector3<Real>(x - face.corner[0]), unit_normal);
      const bool is_nearer = !found || std::fabs(new_height) < std::fabs(height);
      if (!is_nearer || !is_over(face, x)) continue;
      found = true;
      height = new_height;
      corner = x;
    }
  }

  Real squared() const { return height * height; }

 private:
  static bool is_over(const TriangleCore<Real>& face, const Vector3<Real>& x) {
    for (size_t i = 0; i < 3; ++i) {
      const Vector3<Real> inwards = cross(face.normal, face.edge[i]);
      if (dot(Vector3<Real>(x - face.corner[i]), inwards) < 0) return false;
    }
    return true;
  }
};

// The nearest features of two triangles that do not cross.
template <class Real>
struct NearestOfTriangles {
  using Vector = Vector3<Real>;

  Real distance;
  Vector normal;  // from A to B
  Vector point;   // on A

  NearestOfTriangles(const TriangleCore<Real>& a, const TriangleCore<Real>& b) {
    const Real edge_squared = take_edges(a, b);
    // An edge below a corner is equally near, up to rounding: then it takes the face.
    Real bound = edge_squared * CoreTolerance<Real>::kTie;
    const CornerOverFace<Real> over_a(a, b.corner);
    if (over_a.found && over_a.squared() <= bound) {
      bound = over_a.squared();
      distance = std::fabs(over_a.height);
      normal = over_a.height >= 0 ? over_a.unit_normal : Vector(-over_a.unit_normal);
      point = over_a.corner - over_a.unit_normal * over_a.height;
    }
    const CornerOverFace<Real> over_b(b, a.corner);
    if (over_b.found && over_b.squared() <= bound) {
      distance = std::fabs(over_b.height);
      normal = over_b.height >= 0 ? Vector(-over_b.unit_normal) : over_b.unit_normal;
      point = over_b.corner;
    }
  }

 private:
  Real take_edges(const TriangleCore<Real>& a, const TriangleCore<Real>& b) {
    NearestOfSegments<Real> nearest;
    Real squared = 0;
    for (size_t i = 0; i < 3; ++i) {
      for (size_t j = 0; j < 3; ++j) {
        const auto near =
            nearest_of_segments(Vector(b.corner[j] - a.corner[i]), a.edge[i], b.edge[j]);
        const Real new_squared = dot(near.delta, near.delta);
        if (i + j > 0 && !(new_squared < squared)) continue;
        squared = new_squared;
        nearest = near;
        point = a.corner[i] + a.edge[i] * near.s;
      }
    }
    auto [way, is_across] = way_between(nearest);
    const Real height = dot(nearest.delta, way);
    if (is_across && height < 0) way = -way;
    const Real length = std::sqrt(dot(way, way));
    const Real to_unit = 1 / length;
    distance = is_across ? std::fabs(height) * to_unit : length;
    normal = way * to_unit;
    return squared;
  }
};

template <class Real>
TriangleCore<Real> placed(const TriangleShape<Real>& triangle, const Quaternion<Real>& q,
                          const Vector3<Real>& position) {
  const Rotation<Real> turn = rotation_of(q);
  std::array<Vector3<Real>, 3> corners;
  for (size_t i = 0; i < 3; ++i) corners[i] = rotate(turn, triangle.corners[i]) + position;
  return TriangleCore<Real>(corners);
}

template <class Real>
TriangleCore<Real> moved(TriangleCore<Real> triangle, const Vector3<Real>& by) {
  for (Vector3<Real>& corner : triangle.corner) corner += by;
  return triangle;
}

template <class Real>
SeparationAs<Real> separation(const TriangleShape<Real>& a, const TriangleShape<Real>& b,
                              const PairPose<Real>& pose) {
  if (a.is_special() || b.is_special()) return special_triangle(a, b, pose);
  using Vector = Vector3<Real>;
  using Tolerance = CoreTolerance<Real>;
  const TriangleCore<Real> core_a = placed(a, pose.a, Vector(Vector::Zero()));
  const TriangleCore<Real> core_b = placed(b, pose.b, pose.d);
  const TriangleAxes<Real> axes(core_a, core_b);
  const bool is_crossing = axes.is_crossing();
  const Vector way_out = axes.normal() * (is_crossing ? -axes.gap() : 0);
  const NearestOfTriangles<Real> nearest(core_a, moved(core_b, way_out));

  const Real core_separation = is_crossing ? axes.gap() : nearest.distance;
  Vector normal = is_crossing ? axes.normal() : nearest.normal;
  bool is_degenerate = false;
  if constexpr (std::is_same_v<Real, double>) {
    // Between triangles that touch there is no good direction: an axis gives the normal.
    if (!is_crossing && nearest.distance <= Tolerance::kNearEdges) {
      is_degenerate = !axes.exists() && nearest.distance <= Real(kCoincident);
      if (axes.exists()) normal = axes.normal();
      if (is_degenerate) {
        const bool is_a = core_a.squared[0] >= core_b.squared[0];
        normal = any_perpendicular(is_a ? core_a.edge[0] : core_b.edge[0]);
      }
    }
  }
  SeparationAs<Real> result = grown<Real>(nearest.point, nearest.point + normal * core_separation,
                                          normal, core_separation, 0, 0, pose);
  const bool is_tilted =
      !is_crossing && axes.gap_along(normal) < core_separation - Tolerance::kTilt;
  result.is_unsure = result.is_unsure || is_tilted;
  if (is_degenerate) result.status = Status::degenerate;
  return result;
}

}  // namespace carom::scalar

// The nearest vector between the hulls of two point sets, approximately.
//
// Sources: E. G. Gilbert, D. W. Johnson, S. S. Keerthi, "A Fast Procedure for Computing the
// Distance between Complex Objects in Three-Dimensional Space", IEEE J. Robotics and Automation
// 4(2), 1988; C. Ericson, Real-Time Collision Detection, 2005, section 9.5.
#pragma once

#include "base/tolerances.h"
#include "narrowphase/scalar/polytope.h"

namespace carom::scalar {

// The point of the hull of up to four points that is nearest to zero, and the points that span it.
// The last point is always one of them: without it no point would be nearer than before.
class NearestOfSimplex {
 public:
  using Points = FewOf<Vector3d, 4>;

  explicit NearestOfSimplex(const Points& points) : last_(points[points.size() - 1]) {
    keep(last_, {last_});
    const size_t count = points.size() - 1;
    for (size_t i = 0; i < count; ++i) try_segment(points[i]);
    for (size_t i = 0; i < count; ++i) {
      for (size_t j = 0; j < i; ++j) try_triangle(points[i], points[j]);
    }
    if (count == 3) try_tetrahedron(points[0], points[1], points[2]);
  }

  const Vector3d& point() const { return point_; }
  double squared() const { return squared_; }
  const Points& points() const { return points_; }

 private:
  void keep(const Vector3d& point, const Points& points) {
    const double squared = dot(point, point);
    if (!(squared < squared_)) return;
    squared_ = squared;
    point_ = point;
    points_ = points;
  }

  void try_segment(const Vector3d& p) {
    const Vector3d way = p - last_;
    const double t = -dot(last_, way) / dot(way, way);
    if (t > 0 && t < 1) keep(last_ + way * t, {p, last_});
  }

  void try_triangle(const Vector3d& p, const Vector3d& q) {
    const Vector3d n = cross(Vector3d(p - last_), Vector3d(q - last_));
    const bool is_over =
        dot(n, cross(p, q)) > 0 && dot(n, cross(q, last_)) > 0 && dot(n, cross(last_, p)) > 0;
    if (is_over) keep(n * (dot(n, last_) / dot(n, n)), {p, q, last_});
  }

  // Zero is inside if, for every face, it is on the same side as the fourth corner.
  void try_tetrahedron(const Vector3d& p, const Vector3d& q, const Vector3d& r) {
    const bool is_inside = is_beside(p, q, r, last_) && is_beside(q, r, last_, p) &&
                           is_beside(r, last_, p, q) && is_beside(last_, p, q, r);
    if (is_inside) keep(Vector3d::Zero(), {p, q, r, last_});
  }
  static bool is_beside(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                        const Vector3d& fourth) {
    const Vector3d n = cross(Vector3d(b - a), Vector3d(c - a));
    return dot(n, Vector3d(fourth - a)) * -dot(n, a) > 0;
  }

  Vector3d last_;
  double squared_ = HUGE_VAL;
  Vector3d point_;
  Points points_;
};

// The nearest vector from A to B. It is never shorter than the distance, and about zero if the
// shapes touch or overlap.
inline Vector3d nearest_way(const Polytope& a, const Polytope& b) {
  constexpr int kMostSteps = 64;  // a dozen is usual
  const auto furthest = [](const Polytope& shape, const Vector3d& n) {
    const Vector3d* best = shape.points.begin();
    double most = -HUGE_VAL;
    for (const Vector3d& p : shape.points) {
      const double height = dot(n, p);
      if (height > most) {
        most = height;
        best = &p;
      }
    }
    return *best;
  };
  NearestOfSimplex nearest({b.points[0] - a.points[0]});
  for (int step = 0; step < kMostSteps; ++step) {
    const Vector3d& way = nearest.point();
    if (nearest.squared() <= kTouchingSquared || nearest.points().size() == 4) break;
    const Vector3d next = furthest(b, -way) - furthest(a, way);
    if (dot(way, next) >= nearest.squared() * kNoNearer) break;
    NearestOfSimplex::Points points = nearest.points();
    points.push_back(next);
    const NearestOfSimplex nearer(points);
    if (!(nearer.squared() < nearest.squared())) break;
    nearest = nearer;
  }
  return nearest.point();
}

}  // namespace carom::scalar

// The point that stands for where two convex shapes meet.
#pragma once

#include "narrowphase/polytope_ref.h"
#include "narrowphase/segment_ref.h"

namespace carom::reference {

// Of two flat convex sets that lie in planes across n, given by points: the middle of where they
// meet, seen along n, in the plane of the first. Of sets that do not meet, of the first's points
// that are nearest.
class Meeting {
 public:
  using Points = FewOf<Vector3d, DopPolytope::kMostPoints>;

  Meeting(const Points& a, const Points& b, const Vector3d& n)
      : normal_(n), height_(dot(n, a[0])), a_(seen_along(a)), b_(seen_along(b)) {
    points_and_edges();
    points_and_areas();
    crossing_edges();
  }

  Vector3d point() const { return sum_ / count_ + normal_ * height_; }

 private:
  Points seen_along(const Points& points) const {
    Points seen;
    for (const Vector3d& p : points) seen.push_back(p - normal_ * dot(normal_, p));
    return seen;
  }

  // Diagonals count as edges.
  template <class Visit>
  static void for_each_edge(const Points& points, const Visit& visit) {
    for (size_t i = 0; i < points.size(); ++i) {
      for (size_t j = 0; j <= i; ++j) visit(points[i], points[j]);
    }
  }

  void points_and_edges() {
    for (const Vector3d& p : a_) {
      for_each_edge(b_, [&](const Vector3d& u, const Vector3d& v) {
        keep(p, nearest_on_segment(p, u, v).point);
      });
    }
    for (const Vector3d& p : b_) {
      for_each_edge(a_, [&](const Vector3d& u, const Vector3d& v) {
        keep(nearest_on_segment(p, u, v).point, p);
      });
    }
  }

  void points_and_areas() {
    for (const Vector3d& p : a_) {
      if (is_inside(p, b_)) keep(p, p);
    }
    for (const Vector3d& p : b_) {
      if (is_inside(p, a_)) keep(p, p);
    }
  }

  bool is_inside(const Vector3d& p, const Points& points) const {
    for (size_t i = 0; i < points.size(); ++i) {
      for (size_t j = 0; j < i; ++j) {
        for (size_t k = 0; k < j; ++k) {
          if (is_inside(p, points[i], points[j], points[k])) return true;
        }
      }
    }
    return false;
  }

  bool is_inside(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) const {
    const double x = turn(b - a, p - a), y = turn(c - b, p - b), z = turn(a - c, p - c);
    return (x > 0 && y > 0 && z > 0) || (x < 0 && y < 0 && z < 0);
  }

  void crossing_edges() {
    for_each_edge(a_, [&](const Vector3d& p, const Vector3d& q) {
      for_each_edge(b_, [&](const Vector3d& u, const Vector3d& v) {
        const double slope = turn(q - p, v - u);
        const double t = turn(u - p, v - u) / slope, s = turn(u - p, q - p) / slope;
        if (!(t > 0 && t < 1 && s > 0 && s < 1)) return;  // nor if they are parallel
        const Vector3d crossing = p + (q - p) * t;
        keep(crossing, crossing);
      });
    });
  }

  double turn(const Vector3d& u, const Vector3d& v) const { return dot(normal_, cross(u, v)); }

  void keep(const Vector3d& on_a, const Vector3d& on_b) {
    const Vector3d way = on_b - on_a;
    const double distance = std::sqrt(dot(way, way));
    if (distance > least_ + kInPlane) return;
    if (distance < least_ - kInPlane) {
      least_ = distance;
      sum_ = Vector3d::Zero();
      count_ = 0;
    }
    sum_ += on_a;
    count_ += 1;
  }

  Vector3d normal_;
  double height_;
  Points a_, b_;
  double least_ = HUGE_VAL;
  Vector3d sum_;
  double count_ = 0;
};

// The points furthest along n.
inline Meeting::Points furthest(const Polytope& shape, const Vector3d& n) {
  double greatest = -HUGE_VAL;
  for (const Vector3d& p : shape.points) greatest = max(greatest, dot(n, p));
  Meeting::Points points;
  for (const Vector3d& p : shape.points) {
    if (dot(n, p) >= greatest - kInPlane) points.push_back(p);
  }
  return points;
}

}  // namespace carom::reference

// The contact location of two convex shapes: one point for the region in which they meet.
#pragma once

#include <algorithm>

#include "base/tolerances.h"
#include "narrowphase/features/segment_scalar.h"
#include "narrowphase/scalar/polytope.h"

namespace carom::scalar {

// The contact location of two flat convex sets of points, each in a plane perpendicular to the unit
// vector n. Seen along n, it is the mean of the corners of the region in which the sets meet; if
// they do not meet, the mean of the points of A nearest to B. It lies in the plane of A.
class Meeting {
 public:
  using Points = FewOf<Vector3d, DopPolytope::kMostPoints>;

  Meeting(const Points& a, const Points& b, const Vector3d& n)
      : normal_(n), height_(dot(n, a[0])), a_(outline_of(a)), b_(outline_of(b)) {
    points_and_edges();
    points_and_areas();
    crossing_edges();
  }

  // The distance of the two sets, seen along n: zero if they meet.
  double distance() const { return least_; }

  Vector3d point() const { return sum_ / count_ + normal_ * height_; }

 private:
  // Seen along n: the component along n is removed.
  struct Edge {
    Vector3d from, to;
  };
  struct Outline {
    Points points;
    FewOf<Edge, 4 * Points::kCapacity> edges;  // counter-clockwise; both ways if there is no area
  };

  Outline outline_of(const Points& points) const {
    Outline outline;
    for (const Vector3d& point : points) {
      const Vector3d p = point - normal_ * dot(normal_, point);
      if (!holds(outline.points, p)) outline.points.push_back(p);
    }
    for (const Vector3d& from : outline.points) {
      for (const Vector3d& to : outline.points) {
        const bool is_edge =
            &from != &to && !outline.edges.is_full() && are_to_the_left(outline.points, from, to);
        if (is_edge) outline.edges.push_back({from, to});
      }
    }
    return outline;
  }

  static bool holds(const Points& points, const Vector3d& p) {
    return std::any_of(points.begin(), points.end(), [&](const Vector3d& known) {
      return largest_component(Vector3d(known - p)) <= kInPlane;
    });
  }

  // Whether all points lie to the left of the line, up to rounding.
  bool are_to_the_left(const Points& points, const Vector3d& from, const Vector3d& to) const {
    const Vector3d along = to - from;
    const double least = -kInPlane * largest_component(along);
    for (const Vector3d& p : points) {
      if (turn(along, p - from) < least) return false;
    }
    return true;
  }

  void points_and_edges() {
    for (const Vector3d& p : a_.points) {
      if (b_.points.size() == 1) keep(p, b_.points[0]);
      for (const Edge& edge : b_.edges) keep(p, nearest_on_segment(p, edge.from, edge.to).point);
    }
    for (const Vector3d& p : b_.points) {
      for (const Edge& edge : a_.edges) keep(nearest_on_segment(p, edge.from, edge.to).point, p);
    }
  }

  void points_and_areas() {
    for (const Vector3d& p : a_.points) {
      if (is_inside(p, b_)) keep(p, p);
    }
    for (const Vector3d& p : b_.points) {
      if (is_inside(p, a_)) keep(p, p);
    }
  }

  // Whether p is inside by more than rounding; points_and_edges() finds the points on the edges.
  bool is_inside(const Vector3d& p, const Outline& outline) const {
    for (const Edge& edge : outline.edges) {
      const Vector3d along = edge.to - edge.from;
      if (!(turn(along, p - edge.from) > kInPlane * largest_component(along))) return false;
    }
    return !outline.edges.empty();
  }

  void crossing_edges() {
    for (const Edge& on_a : a_.edges) {
      for (const Edge& on_b : b_.edges) {
        const Vector3d u = on_a.to - on_a.from, v = on_b.to - on_b.from;
        const Vector3d between = on_b.from - on_a.from;
        const double slope = turn(u, v);
        if (!(slope * slope > kParallelEdges * (dot(u, u) * dot(v, v)))) continue;
        const double t = turn(between, v) / slope, s = turn(between, u) / slope;
        if (!(t > 0 && t < 1 && s > 0 && s < 1)) continue;
        const Vector3d crossing = on_a.from + u * t;
        keep(crossing, crossing);
      }
    }
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
  Outline a_, b_;
  double least_ = HUGE_VAL;
  Vector3d sum_ = Vector3d::Zero();
  double count_ = 0;
};

// All support points along n, up to rounding.
inline Meeting::Points furthest(const Polytope& shape, const Vector3d& n) {
  double greatest = -HUGE_VAL;
  for (const Vector3d& p : shape.points) greatest = max(greatest, dot(n, p));
  Meeting::Points points;
  for (const Vector3d& p : shape.points) {
    if (dot(n, p) >= greatest - kInPlane) points.push_back(p);
  }
  return points;
}

}  // namespace carom::scalar

// Definitions of the templates in convex_oracle.h, for the files that say for which numbers they
// are compiled.
#pragma once

#include "oracle/convex_oracle.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace carom::oracle {

// The coordinate axis that is furthest from parallel to u.
template <class R>
Vec3<R> least_axis(const Vec3<R>& u) {
  const R x = u.x * u.x, y = u.y * u.y, z = u.z * u.z;
  if (x <= y && x <= z) return {R(1), R(0), R(0)};
  return y <= z ? Vec3<R>{R(0), R(1), R(0)} : Vec3<R>{R(0), R(0), R(1)};
}

// The axis with the largest gap between two cores; if they overlap, the axis of least penetration.
template <class R>
class AxisSearch {
 public:
  using Vec = Vec3<R>;

  AxisSearch(const ConvexShape<R>& a, const ConvexShape<R>& b,
             const ConvexDirections<R>& directions)
      : a_(a), b_(b) {
    try_all(directions);
  }

  R gap() const { return gap_; }
  const Vec& axis() const { return axis_; }

  // Tries n and -n. n is a unit vector or zero.
  void try_axis(const Vec& n) {
    if (!(dot(n, n) > 0)) return;
    const auto [low_a, high_a] = extent(a_, n);
    const auto [low_b, high_b] = extent(b_, n);
    keep(low_b - high_a, n);
    keep(low_a - high_b, -n);
  }

 private:
  static std::pair<R, R> extent(const ConvexShape<R>& shape, const Vec& n) {
    R low = dot(shape.points[0], n), high = low;
    for (const Vec& p : shape.points) {
      const R x = dot(p, n);
      if (x < low) low = x;
      if (x > high) high = x;
    }
    return {low, high};
  }

  void keep(const R& gap, const Vec& n) {
    if (found_ && !(gap > gap_)) return;
    found_ = true;
    gap_ = gap;
    axis_ = n;
  }

  // Extra axes do no harm: each bounds the separation from below. Face normals and cross products
  // of edges suffice if the difference of the cores is solid; the other axes serve flat ones.
  void try_all(const ConvexDirections<R>& directions) {
    for (const Vec& n : directions.axes()) try_axis(n);
    const Vec between = b_.points[0] - a_.points[0];
    try_axis(normalized(between));
    size_t i = 0;
    for (const auto* edges : {&a_.directions, &b_.directions}) {
      for (const Vec& u : *edges) {
        try_axis(u);
        try_axis(directions.beside()[i++]);
        try_axis(normalized(across(normalized(across(between, u)), u)));
      }
    }
    try_axis(least_axis(between));
  }

  const ConvexShape<R>& a_;
  const ConvexShape<R>& b_;
  bool found_ = false;
  R gap_{0};
  Vec axis_;
};

// The least distance of two cores that do not overlap, and the vector from A to B, by trying all
// pairs of features.
template <class R>
class FeatureSearch {
 public:
  using Vec = Vec3<R>;

  FeatureSearch(const ConvexShape<R>& a, const ConvexShape<R>& b,
                const ConvexDirections<R>& directions) {
    auto normal = directions.edge_normals(a, b).begin();
    for (const auto& e : a.edges) {
      for (const auto& f : b.edges) edge_edge(e, f, *normal++);
    }
    points_to_faces(a.points, b, R(1));
    points_to_faces(b.points, a, R(-1));
    points_to_edges(a.points, b, R(1));
    points_to_edges(b.points, a, R(-1));
    for (const Vec& p : a.points) {
      for (const Vec& q : b.points) keep(q - p);
    }
  }

  const R& distance() const { return distance_; }
  const Vec& way() const { return way_; }

 private:
  // Vertices are tried last and win only by more than rounding. The vector to an edge is as exact
  // as the edge; the vector to a vertex beside it only as exact as the root of an epsilon.
  void keep(const Vec& way) {
    const R distance = length(way);
    const R enough = distance_ * (1 - 8 * std::numeric_limits<R>::epsilon());
    if (found_ && !(distance < enough)) return;
    found_ = true;
    distance_ = distance;
    way_ = way;
  }

  void points_to_faces(const std::vector<Vec>& points, const ConvexShape<R>& shape, const R& sign) {
    for (const Vec& p : points) {
      for (const auto& face : shape.faces) point_face(p, face, sign);
    }
  }

  void points_to_edges(const std::vector<Vec>& points, const ConvexShape<R>& shape, const R& sign) {
    for (const Vec& p : points) {
      for (const auto& edge : shape.edges) point_edge(p, edge, sign);
    }
  }

  void point_edge(const Vec& p, const ConvexEdge<R>& edge, const R& sign) {
    const Vec d = p - edge.start;
    const R t = dot(d, edge.direction);
    if (t > 0 && t < edge.size) keep((edge.direction * t - d) * sign);
  }

  // The distance to the face if the point projects onto it. Coordinates start at the longest edge,
  // because the normal of a sliver is uncertain but no point of it is far from that edge. The seam
  // makes a point over the common edge of two triangles count as over one of them in spite of
  // rounding.
  void point_face(const Vec& p, const ConvexFace<R>& face, const R& sign) {
    const Vec d = p - face.origin;
    const R y = dot(d, face.v);
    const R seam = 16 * std::numeric_limits<R>::epsilon() * (face.base + length(d));
    if (!(face.height > 0) || y < -seam || y > face.height + seam) return;
    const R x = dot(d, face.u);
    const R share = std::clamp<R>(y / face.height, 0, 1);
    const R left = face.apex_x * share;
    const R right = face.base + (face.apex_x - face.base) * share;
    if (x >= left - seam && x <= right + seam) keep(face.normal * (-dot(d, face.normal) * sign));
  }

  // The distance of two edges that cross, seen along their common normal. The end points cover
  // parallel edges.
  void edge_edge(const ConvexEdge<R>& e, const ConvexEdge<R>& f, const Vec& n) {
    const Vec across_e = cross(n, e.direction);
    const R slope = dot(f.direction, across_e);
    if (!(slope * slope > 0)) return;
    const Vec d = f.start - e.start;
    const R t = -dot(d, across_e) / slope;
    if (!(t >= 0 && t <= f.size)) return;
    const R s = dot(d, e.direction) + t * dot(f.direction, e.direction);
    if (s >= 0 && s <= e.size) keep(n * dot(d, n));
  }

  bool found_ = false;
  Vec way_;
  R distance_{0};
};

// The gap of A and a half-space B, along the normal of B.
template <class R>
R gap_to_halfspace(const ConvexShape<R>& a, const ConvexShape<R>& b) {
  return -a.support(-b.normal) - b.offset;
}

// Two half-spaces are separate only if their normals are exactly opposite.
template <class R>
R halfspace_gap(const ConvexShape<R>& a, const ConvexShape<R>& b) {
  const Vec3<R> sum = a.normal + b.normal;
  if (dot(sum, sum) > 0) return -std::numeric_limits<R>::infinity();
  return -a.offset - b.offset;
}

template <class R>
ConvexSeparation<R> halfspace_separation(const ConvexShape<R>& a, const ConvexShape<R>& b) {
  if (a.is_halfspace && b.is_halfspace) return {halfspace_gap(a, b), a.normal};
  if (a.is_halfspace) return {gap_to_halfspace(b, a), a.normal};
  return {gap_to_halfspace(a, b), -b.normal};
}

template <class R>
ConvexDirections<R>::ConvexDirections(const ConvexShape<R>& a, const ConvexShape<R>& b)
    : axes_(a.normals) {
  axes_.insert(axes_.end(), b.normals.begin(), b.normals.end());
  for (const Vec& u : a.directions) {
    for (const Vec& v : b.directions) add_cross(u, v, a.is_solid || b.is_solid);
  }
  for (const auto* edges : {&a.directions, &b.directions}) {
    for (const Vec& u : *edges) beside_.push_back(common_normal(u, least_axis(u)));
  }
}

template <class R>
void ConvexDirections<R>::add_cross(const Vec& u, const Vec& v, bool is_solid) {
  const Vec n = common_normal(u, v);
  axes_.push_back(n);
  if (is_solid) return;
  axes_.push_back(cross(n, u));
  axes_.push_back(common_normal(v, n));
}

template <class R>
const std::vector<Vec3<R>>& ConvexDirections<R>::edge_normals(const ConvexShape<R>& a,
                                                              const ConvexShape<R>& b) const {
  if (edge_normals_.empty()) {
    edge_normals_.reserve(a.edges.size() * b.edges.size());
    for (const auto& e : a.edges) {
      for (const auto& f : b.edges) {
        edge_normals_.push_back(common_normal(e.direction, f.direction));
      }
    }
  }
  return edge_normals_;
}

template <class R>
ConvexSeparation<R> separation_with_normal(const ConvexShape<R>& a, const ConvexShape<R>& b) {
  if (a.is_halfspace || b.is_halfspace) return halfspace_separation(a, b);
  return separation_with_normal(a, b, ConvexDirections<R>(a, b));
}

template <class R>
ConvexSeparation<R> separation_with_normal(const ConvexShape<R>& a, const ConvexShape<R>& b,
                                           const ConvexDirections<R>& directions) {
  if (a.is_halfspace || b.is_halfspace) return halfspace_separation(a, b);
  AxisSearch<R> axes(a, b, directions);
  const R radii = a.radius + b.radius;
  if (!(axes.gap() > 0)) return {axes.gap() - radii, axes.axis()};
  const FeatureSearch<R> features(a, b, directions);
  axes.try_axis(normalized(features.way()));
  return {features.distance() - radii, axes.axis()};
}

template <class R>
R gap_along(const ConvexShape<R>& a, const ConvexShape<R>& b, const Vec3<R>& n) {
  const Vec3<R> unit = normalized(n);
  if (!a.is_halfspace && !b.is_halfspace) return -b.support(-unit) - a.support(unit);
  const ConvexSeparation<R> true_one = halfspace_separation(a, b);
  const R share = dot(unit, true_one.normal);
  if (!(share > 0)) return -std::numeric_limits<R>::infinity();
  return true_one.value > 0 ? true_one.value * share : true_one.value / share;
}

template <class R>
R surface_distance(const ConvexShape<R>& shape, const Vec3<R>& point) {
  using std::abs;
  if (shape.is_halfspace) return abs(dot(shape.normal, point) - shape.offset);
  const ConvexShape<R> other(point);
  const FeatureSearch<R> features(shape, other, ConvexDirections<R>(shape, other));
  return abs(features.distance() - shape.radius);
}

template <class R>
R widest_gap(const ConvexShape<R>& a, const ConvexShape<R>& b) {
  return AxisSearch<R>(a, b, ConvexDirections<R>(a, b)).gap();
}

}  // namespace carom::oracle

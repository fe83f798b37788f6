// Shapes as the hull of a few points, grown by a radius: for tests in double precision that take
// any two of them, clear rather than fast.
#pragma once

#include <array>
#include <cstddef>

#include "narrowphase/shapes_ref.h"

namespace carom::reference {

// At most kMost elements, without the heap.
template <class T, size_t kMost>
class FewOf {
 public:
  void push_back(const T& value) { values_[size_++] = value; }
  size_t size() const { return size_; }
  const T& operator[](size_t i) const { return values_[i]; }
  const T* begin() const { return values_.data(); }
  const T* end() const { return values_.data() + size_; }
  T* begin() { return values_.data(); }
  T* end() { return values_.data() + size_; }

 private:
  std::array<T, kMost> values_;
  size_t size_ = 0;
};

using Eigen::Vector3d;

// Zero for a vector of zero.
inline Vector3d unit_or_zero(const Vector3d& v) {
  const double scale = largest_component(v);
  if (!(scale > 0)) return Vector3d::Zero();
  const Vector3d scaled = v / scale;  // squares of what is tiny would vanish
  return scaled / std::sqrt(dot(scaled, scaled));
}

struct PolytopeEdge {
  Vector3d start;
  Vector3d direction;  // unit, or zero
};

// Of a triangle: what its front and its inner edges exclude.
struct FrontRules {
  Vector3d front = Vector3d::Zero();   // unit; zero: there is no front, and no rule
  Vector3d corner = Vector3d::Zero();  // the first
  std::array<Vector3d, 2> sides;       // from there to the others
  double thickness = 0;
  bool one_sided = false;
  uint8_t inner_edges = 0;
};

// World axes. The points' hull grown by `radius` is the shape.
struct Polytope {
  FewOf<Vector3d, 8> points;
  FewOf<PolytopeEdge, 12> edges;
  FewOf<Vector3d, 4> directions;  // of the edges, each once
  FewOf<Vector3d, 4> normals;     // of the faces, each once
  double radius = 0;
  Vector3d middle = Vector3d::Zero();  // where one-sided triangles take the shape to be
  FrontRules rules;

  void add_edge(size_t i, size_t j) {
    edges.push_back({points[i], unit_or_zero(points[j] - points[i])});
  }

  void move(const Vector3d& by) {
    for (Vector3d& p : points) p += by;
    for (PolytopeEdge& edge : edges) edge.start += by;
    middle += by;
    rules.corner += by;
  }
};

inline Polytope polytope_of(const SphereShape<double>& sphere, const Quaternion<double>&) {
  Polytope p;
  p.points.push_back(Vector3d::Zero());
  p.radius = sphere.radius;
  return p;
}

inline Polytope polytope_of(const CapsuleShape<double>& capsule, const Quaternion<double>& q) {
  const Rotation<double> turn = rotation_of(q);
  Polytope p;
  p.points.push_back(rotate(turn, capsule.a));
  p.points.push_back(rotate(turn, capsule.b));
  p.add_edge(0, 1);
  p.directions.push_back(p.edges[0].direction);
  p.radius = capsule.radius;
  p.middle = (p.points[0] + p.points[1]) / 2;
  return p;
}

inline Polytope polytope_of_box(const Vector3d& lower, const Vector3d& upper,
                                const Rotation<double>& turn) {
  Polytope p;
  for (size_t i = 0; i < 8; ++i) {  // bit k of i: at the upper end of axis k
    const Vector3d corner((i & 1 ? upper : lower).x(), (i & 2 ? upper : lower).y(),
                          (i & 4 ? upper : lower).z());
    p.points.push_back(rotate(turn, corner));
  }
  for (const Vector3d& axis : {turn.x, turn.y, turn.z}) {
    p.directions.push_back(axis);
    p.normals.push_back(axis);
  }
  for (size_t i = 0; i < 8; ++i) {
    for (size_t axis = 0; axis < 3; ++axis) {
      if (!(i >> axis & 1)) p.edges.push_back({p.points[i], p.directions[axis]});
    }
  }
  p.middle = rotate(turn, Vector3d((lower + upper) / 2));
  return p;
}

inline Polytope polytope_of(const AabbShape<double>& box, const Quaternion<double>&) {
  const Rotation<double> unturned{Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
  return polytope_of_box(box.lower, box.upper, unturned);
}

inline Polytope polytope_of(const BoxShape<double>& box, const Quaternion<double>& q) {
  return polytope_of_box(-box.half, box.half, rotation_of(q));
}

// Unit, on the side from which the corners run counter-clockwise; zero if there is no area but what
// rounding may have made. Taken between the two shorter sides, where rounding counts least.
inline Vector3d front_of(const std::array<Vector3d, 3>& corners) {
  Vector3d best = Vector3d::Zero();
  double least = HUGE_VAL;
  for (size_t i = 0; i < 3; ++i) {
    const Vector3d next = corners[(i + 1) % 3] - corners[i];
    const Vector3d last = corners[(i + 2) % 3] - corners[i];
    const double product = std::sqrt(dot(next, next)) * std::sqrt(dot(last, last));
    const Vector3d normal = cross(next, last);
    if (product < least) {
      least = product;
      best = largest_component(normal) > 0x1p-48 * product ? normal : Vector3d::Zero();
    }
  }
  return unit_or_zero(best);
}

// Thickness makes it a prism: the corners, and behind them the same again.
inline Polytope polytope_of(const TriangleShape<double>& triangle, const Quaternion<double>& q) {
  const Rotation<double> turn = rotation_of(q);
  const Vector3d front = rotate(turn, front_of(triangle.corners));
  Polytope p;
  for (const Vector3d& corner : triangle.corners) p.points.push_back(rotate(turn, corner));
  for (size_t i = 0; i < 3; ++i) p.add_edge(i, (i + 1) % 3);
  for (const PolytopeEdge& edge : p.edges) p.directions.push_back(edge.direction);
  p.middle = (p.points[0] + p.points[1] + p.points[2]) / 3;
  if (front.isZero(0)) return p;

  p.normals.push_back(front);
  p.rules = {front,
             p.points[0],
             {p.points[1] - p.points[0], p.points[2] - p.points[0]},
             triangle.thickness,
             triangle.one_sided,
             triangle.inner_edges};
  if (!(triangle.thickness > 0)) return p;
  for (size_t i = 0; i < 3; ++i) {
    p.normals.push_back(unit_or_zero(cross(front, p.directions[i])));
    p.points.push_back(p.points[i] - front * triangle.thickness);
  }
  for (size_t i = 0; i < 3; ++i) {
    p.add_edge(i + 3, (i + 1) % 3 + 3);
    p.edges.push_back({p.points[i], front});
  }
  p.directions.push_back(front);
  return p;
}

}  // namespace carom::reference

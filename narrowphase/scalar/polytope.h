// Shapes as the convex hull of a few points, grown by a radius: for tests in double precision that
// take any two shapes, clear rather than fast.
#pragma once

#include <array>
#include <cstddef>

#include "base/few_of.h"
#include "base/tolerances.h"
#include "narrowphase/scalar/dop_corners.h"
#include "narrowphase/scalar/one_sided_rules.h"
#include "narrowphase/scalar/shapes.h"

namespace carom::scalar {

// v / |v|, or zero if v is zero.
inline Vector3d unit_or_zero(const Vector3d& v) {
  const double scale = largest_component(v);
  if (!(scale > 0)) return Vector3d::Zero();
  const Vector3d scaled = v / scale;  // squares of tiny components would vanish
  return scaled / std::sqrt(dot(scaled, scaled));
}

struct PolytopeEdge {
  Vector3d start;
  Vector3d direction;  // unit, or zero
};

// The shape is the convex hull of `points`, grown by `radius`; world axes.
struct Polytope {
  // Room for a k-DOP, which has the most.
  FewOf<Vector3d, DopPolytope::kMostPoints> points;
  FewOf<PolytopeEdge, DopPolytope::kMostEdges> edges;
  FewOf<Vector3d, 25> directions;       // of the edges, each once
  FewOf<Vector3d, kMostSlabs> normals;  // of the faces, each once
  double radius = 0;
  Vector3d middle = Vector3d::Zero();  // tells one-sided triangles on which side it is
  double inner_radius = 0;             // of a ball about `middle` inside the hull
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
  const Vector3d half = (upper - lower) / 2;
  p.inner_radius = min(min(half.x(), half.y()), half.z());
  return p;
}

inline Polytope polytope_of(const AabbShape<double>& box, const Quaternion<double>&) {
  const Rotation<double> unturned{Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
  return polytope_of_box(box.lower, box.upper, unturned);
}

inline Polytope polytope_of(const BoxShape<double>& box, const Quaternion<double>& q) {
  Polytope p = polytope_of_box(-box.half, box.half, rotation_of(q));
  p.radius = box.rounding;
  return p;
}

// The unit normal on the side from which the corners run counter-clockwise; zero if the area may be
// all rounding. Computed from the two shortest sides, where rounding counts least.
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
      best = largest_component(normal) > kWithoutArea * product ? normal : Vector3d::Zero();
    }
  }
  return unit_or_zero(best);
}

// A thick triangle is a prism: the corners, and the same again at `thickness` behind the front.
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

// Unit normals and edge directions of a turned k-DOP. An edge direction is a cross product of two
// slab directions, so there are few of them; the polytope gets each once.
class DopAxes {
 public:
  DopAxes(DopKind kind, const Rotation<double>& turn) : slabs_(slab_directions(kind)), turn_(turn) {
    known_.fill(-1);
  }

  // Unit, out of the polytope, in world axes.
  Vector3d normal(size_t plane) const {
    return rotate(turn_, unit_or_zero(slab(plane))) * sign_of_plane(plane);
  }

  // Unit, along the edge where the two planes meet. Adds it to p.directions if it is new.
  Vector3d edge(const std::array<uint8_t, 2>& planes, Polytope& p) {
    Vector3d way = cross(slab(planes[0]), slab(planes[1]));
    if (way.x() < 0 || (way.x() == 0 && (way.y() < 0 || (way.y() == 0 && way.z() < 0)))) way = -way;
    way /= largest_component(way);
    const Vector3d doubled = way * 2;  // integers from -2 to 2
    const auto place = static_cast<size_t>(62 + (doubled.x() * 25 + doubled.y() * 5) + doubled.z());
    if (known_[place] < 0) {
      known_[place] = static_cast<int8_t>(p.directions.size());
      p.directions.push_back(rotate(turn_, unit_or_zero(way)));
    }
    return p.directions[static_cast<size_t>(known_[place])];
  }

 private:
  Vector3d slab(size_t plane) const {
    const auto& d = slabs_[slab_of_plane(plane)];
    return Vector3d(d[0], d[1], d[2]);
  }

  const std::span<const std::array<int8_t, 3>> slabs_;
  const Rotation<double> turn_;
  std::array<int8_t, 125> known_;
};

inline Polytope polytope_of(const DopShape<double>& dop, const Quaternion<double>& q) {
  const Rotation<double> turn = rotation_of(q);
  const DopCorners corners(dop);
  const DopPolytope& shape = corners.polytope();
  DopAxes directions(dop.slabs.kind, turn);
  Polytope p;
  Vector3d sum = Vector3d::Zero();
  for (size_t i = 0; i < corners.size(); ++i) {
    p.points.push_back(rotate(turn, corners.point(i)));
    sum += p.points[i];
  }
  for (const DopEdge& edge : shape.edges()) {
    p.edges.push_back({p.points[edge.start], directions.edge(edge.planes, p)});
  }
  p.middle = sum / static_cast<double>(p.points.size());
  p.inner_radius = HUGE_VAL;
  unsigned known_slabs = 0;
  for (const DopFace& face : shape.faces()) {
    const Vector3d normal = directions.normal(face.plane);
    const Vector3d& corner = p.points[shape.corners(face)[0].point];
    const double depth = dot(normal, Vector3d(corner - p.middle));
    p.inner_radius = min(p.inner_radius, max(depth, 0.0));
    const unsigned slab = 1u << slab_of_plane(face.plane);
    if (face.count < 3 || (known_slabs & slab)) continue;
    p.normals.push_back(normal);
    known_slabs |= slab;
  }
  return p;
}

}  // namespace carom::scalar

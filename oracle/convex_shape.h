// Placed shapes for the oracle: the hull of a few points, grown by a radius, or a half-space. Works
// in any real type and shares nothing with the library.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <variant>
#include <vector>

#include "carom/shapes/body.h"
#include "oracle/convex_dop.h"
#include "oracle/hull_faces.h"
#include "oracle/vec3.h"

namespace carom::oracle {

template <class R>
struct Rotation {
  std::array<Vec3<R>, 3> column;

  // M(q) / |q|^2
  explicit Rotation(const Eigen::Quaternionf& q)
      : Rotation(R(q.x()), R(q.y()), R(q.z()), R(q.w())) {}
  Rotation(const R& x, const R& y, const R& z, const R& w) {
    const R s = 1 / (x * x + y * y + z * z + w * w);
    column[0] = Vec3<R>{w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)};
    column[1] = Vec3<R>{2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)};
    column[2] = Vec3<R>{2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z};
    for (Vec3<R>& c : column) c = c * s;
  }

  // Rotation by an angle about a unit axis; a zero axis gives the identity.
  Rotation(const Vec3<R>& axis, const R& angle) {
    using std::cos, std::sin;
    const R half_sine = sin(angle / 2), s = sin(angle), k = 2 * half_sine * half_sine;
    const Vec3<R> unit[3] = {{R(1), R(0), R(0)}, {R(0), R(1), R(0)}, {R(0), R(0), R(1)}};
    for (size_t i = 0; i < 3; ++i) {
      column[i] = unit[i] + cross(axis, unit[i]) * s + cross(axis, cross(axis, unit[i])) * k;
    }
  }

  // Applies the inverse rotation.
  Vec3<R> back(const Vec3<R>& v) const {
    return {dot(column[0], v), dot(column[1], v), dot(column[2], v)};
  }

  Vec3<R> operator()(const Vec3<R>& v) const {
    return column[0] * v.x + column[1] * v.y + column[2] * v.z;
  }
};

// An edge without length has a zero direction.
template <class R>
struct ConvexEdge {
  Vec3<R> start;
  Vec3<R> direction;  // unit
  R size;

  ConvexEdge(const Vec3<R>& from, const Vec3<R>& to)
      : start(from), direction(normalized(to - from)), size(length(to - from)) {}
};

// A triangle over its longest edge. In the frame (origin, u, v) its corners are (0, 0), (base, 0)
// and (apex_x, height), with height >= 0. Without area the normal is zero.
template <class R>
struct ConvexFace {
  Vec3<R> origin, u, v, normal;
  R base, apex_x, height;

  ConvexFace(Vec3<R> a, Vec3<R> b, Vec3<R> c) {
    const R ab = length(b - a), bc = length(c - b), ca = length(a - c);
    if (bc > ab && bc >= ca) {
      std::swap(a, c);
    } else if (ca > ab) {
      std::swap(b, c);
    }
    origin = a;
    u = normalized(b - a);
    normal = common_normal(u, normalized(c - a));
    v = cross(normal, u);
    base = length(b - a);
    apex_x = dot(c - a, u);
    height = dot(c - a, v);
  }
};

// Coordinates are relative to a point that the caller chooses. One-sided triangles count as
// two-sided, and thick triangles without area as thin. Meshes and compounds are not supported
// because they are not convex.
template <class R = long double>
struct ConvexShape {
  using Vec = Vec3<R>;

  std::vector<Vec> points;  // the core's
  R radius{0};              // by which the core is grown
  R bounding_radius{0};     // about the body's origin; half-space: distance to its plane
  bool is_halfspace = false;
  bool is_solid = false;  // known not to be flat
  Vec normal;             // of a half-space: all x with normal . x <= offset; unit
  R offset{0};            // of a half-space
  std::vector<ConvexEdge<R>> edges;
  std::vector<ConvexFace<R>> faces;
  std::vector<Vec> directions;  // unit, of edges
  std::vector<Vec> normals;     // unit; of faces, and of a flat core's outline in its plane

  // A point.
  explicit ConvexShape(const Vec& point) : points{point} {}

  // The shape in its body frame.
  explicit ConvexShape(const Shape& shape) {
    std::visit([this](const auto& s) { this->build(s); }, shape);
    for (const Vec& p : points) bounding_radius = std::max<R>(bounding_radius, length(p));
    bounding_radius += radius;
  }

  ConvexShape(const Shape& shape, const Pose& pose,
              const Eigen::Vector3d& relative_to = Eigen::Vector3d::Zero())
      : ConvexShape(shape) {
    if (!std::holds_alternative<Sphere>(shape) && !std::holds_alternative<Aabb>(shape)) {
      rotate(Rotation<R>(pose.orientation));
    }
    translate(vec3_as<R>(pose.position) - vec3_as<R>(relative_to));
  }

  // Largest n . x for a unit vector n; not for half-spaces.
  R support(const Vec& n) const {
    R best = dot(points[0], n);
    for (const Vec& p : points) best = std::max<R>(best, dot(p, n));
    return best + radius;
  }

  Vec centroid() const {
    if (is_halfspace) return normal * offset;
    Vec sum;
    for (const Vec& p : points) sum = sum + p;
    return sum * (1 / R(points.size()));
  }

  void translate(const Vec& by) {
    for (Vec& p : points) p = p + by;
    for (auto& edge : edges) edge.start = edge.start + by;
    for (auto& face : faces) face.origin = face.origin + by;
    offset += dot(normal, by);
  }

  // Rotates about the origin. Edge directions are computed in the body frame and then turned, so
  // they are as exact as the body's own numbers.
  void rotate(const Rotation<R>& rotation) {
    const auto turn = [&](Vec& v) { v = rotation(v); };
    std::for_each(points.begin(), points.end(), turn);
    std::for_each(directions.begin(), directions.end(), turn);
    std::for_each(normals.begin(), normals.end(), turn);
    for (auto& edge : edges) {
      for (Vec* v : {&edge.start, &edge.direction}) turn(*v);
    }
    for (auto& face : faces) {
      for (Vec* v : {&face.origin, &face.u, &face.v, &face.normal}) turn(*v);
    }
    turn(normal);
  }

 private:
  void build(const Sphere& sphere) {
    points = {Vec{}};
    radius = R(sphere.radius);
  }

  void build(const Capsule& capsule) {
    points = {vec3_as<R>(capsule.a), vec3_as<R>(capsule.b)};
    radius = R(capsule.radius);
    add_edge(0, 1);
    directions = {edges[0].direction};
  }

  void build(const Aabb& box) { build_box(vec3_as<R>(box.lower), vec3_as<R>(box.upper)); }
  void build(const carom::Box& box) { build_box(-vec3_as<R>(box.half), vec3_as<R>(box.half)); }

  // Point i is at the upper end of axis k if bit k of i is set.
  void build_box(const Vec& lower, const Vec& upper) {
    for (int i = 0; i < 8; ++i) {
      points.push_back(
          {i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z});
    }
    directions = {{R(1), R(0), R(0)}, {R(0), R(1), R(0)}, {R(0), R(0), R(1)}};
    normals = directions;
    for (int k = 0; k < 3; ++k) {
      const size_t along = 1u << k, next = 1u << (k + 1) % 3, last = 1u << (k + 2) % 3;
      for (size_t corner : {size_t{0}, next, last, next | last}) add_edge(corner, corner | along);
      for (size_t corner : {size_t{0}, along}) {
        add_quad(corner, corner | next, corner | next | last, corner | last);
      }
    }
  }

  void build(const Triangle& triangle) {
    for (const Eigen::Vector3f& corner : triangle.corners) points.push_back(vec3_as<R>(corner));
    for (size_t i = 0; i < 3; ++i) add_edge(i, (i + 1) % 3);
    for (const auto& edge : edges) directions.push_back(edge.direction);
    add_face(0, 1, 2);
    const Vec front = front_normal();
    if (!(dot(front, front) > 0)) return;
    normals.push_back(front);
    for (const auto& edge : edges) {
      normals.push_back(normalized(across(cross(front, edge.direction), edge.direction)));
    }
    if (triangle.thickness > 0) extrude(front * -R(triangle.thickness), front);
  }

  Vec front_normal() const {
    const Vec n = faces[0].normal;
    return dot(n, cross(points[1] - points[0], points[2] - points[0])) < 0 ? -n : n;
  }

  void extrude(const Vec& depth, const Vec& front) {
    for (size_t i = 0; i < 3; ++i) points.push_back(points[i] + depth);
    add_face(3, 4, 5);
    for (size_t i = 0; i < 3; ++i) {
      const size_t j = (i + 1) % 3;
      add_edge(i + 3, j + 3);
      add_edge(i, i + 3);
      add_quad(i, j, j + 3, i + 3);
    }
    directions.push_back(front);
  }

  void build(const Dop& dop) {
    const ConvexDop<R> polytope(dop);
    points = polytope.points();
    normals = polytope.normals();
    for (const auto& edge : polytope.edges()) {
      edges.emplace_back(edge.from, edge.to);
      const Vec& way = edges.back().direction;
      const bool is_known = std::any_of(directions.begin(), directions.end(), [&](const Vec& u) {
        const Vec n = cross(u, way);
        return dot(n, n) < R(1e-20);
      });
      if (!is_known) directions.push_back(way);
    }
    for (const std::vector<Vec>& face : polytope.faces()) {
      for (size_t i = 2; i < face.size(); ++i) faces.emplace_back(face[0], face[i - 1], face[i]);
    }
  }

  // Finds corners and faces from the points alone and ignores those in the geometry.
  void build(const Hull& hull) {
    const auto all = hull.geometry->points();
    const HullFaces found(all);
    std::vector<size_t> place(all.size());
    for (const uint32_t corner : found.corners()) {
      place[corner] = points.size();
      points.push_back(vec3_as<R>(all[corner]));
    }
    is_solid = found.dimension() == 3;
    if (found.dimension() == 1) add_outline({0, 1});
    for (const HullFaces::Outline& outline : found.faces()) {
      std::vector<size_t> corners;
      for (const uint32_t corner : outline) corners.push_back(place[corner]);
      add_outline(corners);
      if (is_solid || faces.empty()) add_polygon(corners);
    }
    if (found.dimension() != 2) return;
    for (const auto& edge : edges) normals.push_back(cross(normals[0], edge.direction));
  }

  // Every edge is in two outlines, once in each direction; this adds it once.
  void add_outline(const std::vector<size_t>& corners) {
    for (size_t i = 0; i < corners.size(); ++i) {
      const size_t from = corners[i], to = corners[(i + 1) % corners.size()];
      if (from >= to) continue;
      add_edge(from, to);
      add_direction(points[to] - points[from]);
    }
  }

  // Compares unnormalized differences of points, because their cross products hardly round.
  void add_direction(const Vec& way) {
    const bool is_known = std::any_of(ways_.begin(), ways_.end(), [&](const Vec& known) {
      const Vec n = cross(known, way);
      return dot(n, n) == 0;
    });
    if (is_known) return;
    ways_.push_back(way);
    directions.push_back(normalized(way));
  }

  void add_polygon(const std::vector<size_t>& corners) {
    const Vec& origin = points[corners[0]];
    Vec widest;
    for (size_t i = 2; i < corners.size(); ++i) {
      add_face(corners[0], corners[i - 1], corners[i]);
      for (size_t j = 1; j < i; ++j) {
        const Vec n = cross(points[corners[j]] - origin, points[corners[i]] - origin);
        if (dot(n, n) > dot(widest, widest)) widest = n;
      }
    }
    normals.push_back(normalized(widest));
  }

  void build(const Mesh& /*not convex*/) { std::abort(); }
  void build(const Compound& /*not convex*/) { std::abort(); }

  void build(const Halfspace& halfspace) {
    is_halfspace = true;
    const Vec n = vec3_as<R>(halfspace.normal);
    normal = normalized(n);
    offset = R(halfspace.offset) / length(n);
    bounding_radius = offset < 0 ? -offset : offset;
  }

  void add_edge(size_t i, size_t j) { edges.emplace_back(points[i], points[j]); }
  void add_face(size_t i, size_t j, size_t k) {
    faces.emplace_back(points[i], points[j], points[k]);
  }
  void add_quad(size_t i, size_t j, size_t k, size_t l) {
    add_face(i, j, k);
    add_face(i, k, l);
  }

  std::vector<Vec> ways_;  // of a hull: edge directions as unnormalized differences
};

}  // namespace carom::oracle

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
  Rotation(const R& x, const R& y, const R& z, const R& w);

  // Rotation by an angle about a unit axis; a zero axis gives the identity.
  Rotation(const Vec3<R>& axis, const R& angle);

  // Applies the inverse rotation.
  Vec3<R> back(const Vec3<R>& v) const;

  Vec3<R> operator()(const Vec3<R>& v) const;
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

  ConvexFace(Vec3<R> a, Vec3<R> b, Vec3<R> c);
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
  explicit ConvexShape(const Shape& shape);

  ConvexShape(const Shape& shape, const Pose& pose,
              const Eigen::Vector3d& relative_to = Eigen::Vector3d::Zero());

  // Largest n . x for a unit vector n; not for half-spaces.
  R support(const Vec& n) const;

  Vec centroid() const;

  void translate(const Vec& by);

  // Rotates about the origin. Edge directions are computed in the body frame and then turned, so
  // they are as exact as the body's own numbers.
  void rotate(const Rotation<R>& rotation);

 private:
  void build(const Sphere& sphere);

  void build(const Capsule& capsule);

  void build(const Aabb& box) { build_box(vec3_as<R>(box.lower), vec3_as<R>(box.upper)); }
  void build(const carom::Box& box) {
    build_box(-vec3_as<R>(box.half), vec3_as<R>(box.half));
    radius = box.rounding;
  }

  // Point i is at the upper end of axis k if bit k of i is set.
  void build_box(const Vec& lower, const Vec& upper);

  void build(const Triangle& triangle);

  Vec front_normal() const;

  void extrude(const Vec& depth, const Vec& front);

  void build(const Dop& dop);

  // Round shapes have no features: support_oracle.h is for them.
  void build(const Cylinder&) { std::abort(); }
  void build(const Cone&) { std::abort(); }
  void build(const Ellipsoid&) { std::abort(); }

  // Finds corners and faces from the points alone and ignores those in the geometry.
  void build(const Hull& hull);

  // Every edge is in two outlines, once in each direction; this adds it once.
  void add_outline(const std::vector<size_t>& corners);

  // Compares unnormalized differences of points, because their cross products hardly round.
  void add_direction(const Vec& way);

  void add_polygon(const std::vector<size_t>& corners);

  void build(const Mesh& /*not convex*/) { std::abort(); }
  void build(const HeightField& /*not convex*/) { std::abort(); }
  void build(const Compound& /*not convex*/) { std::abort(); }

  void build(const Halfspace& halfspace);

  void add_edge(size_t i, size_t j) { edges.emplace_back(points[i], points[j]); }
  void add_face(size_t i, size_t j, size_t k);
  void add_quad(size_t i, size_t j, size_t k, size_t l);

  std::vector<Vec> ways_;  // of a hull: edge directions as unnormalized differences
};

}  // namespace carom::oracle

// How deep two solids overlap, and which way out is the shortest, in float32 and scaled units:
// every separating axis that could be that way is tried.
//
// The axes are the normals of faces, and the directions across two edges whose arcs on the sphere
// of normals cross. No axis between the faces at an edge can be better than what one point of the
// other solid says of both faces: most edges need no other.
//
// Sources: S. Gottschalk, M. C. Lin, D. Manocha, "OBBTree", SIGGRAPH 1996 (the axes); D. Gregorius,
// "The Separating Axis Test between Convex Polyhedra", Game Developers Conference, 2013 (the arcs).
#pragma once

#include <array>
#include <cstdint>

#include "narrowphase/hulls/solid.h"
#include "narrowphase/scalar/separation.h"

namespace carom {

// Points of one solid in the frame of another, in columns, as many as fill whole vectors: places
// behind the last repeat the first.
struct HullPoints {
  size_t count, padded;
  std::array<float, kMostLanePoints> x, y, z;

  Vector3f operator[](size_t i) const { return {x[i], y[i], z[i]}; }
};

// Of points seen along a way the first of those furthest.
struct FurthestOfHull {
  size_t index;
  float height;
};

struct FacingPoints {
  FurthestOfHull furthest;
  size_t count;
};

// A part of the other solid: one of its points, or a ball inside of it.
struct Ball {
  Vector3f middle;
  float radius;
};

// Of the faces of one solid: what balls say of the gaps of their axes. An axis between two faces
// has no more than the greater of what a ball says of both, if its middle is below both; `between`
// is above zero of faces that it is above.
struct FaceBounds {
  static constexpr size_t kMost = Solid::kMostFaces;
  static constexpr size_t kMostBalls = 32;

  size_t count;                                              // of balls
  std::array<std::array<float, kMost>, kMostBalls> between;  // by each
  std::array<float, kMost> gap;         // the least of all; -kLargest if the face was tried
  std::array<uint32_t, kMost> settled;  // a bit for each ball: whether `between` is low enough
};

struct BestFace {
  float gap = -scalar::kLargest;
  size_t face = 0;
};

// More edges than this beside which no axis is ruled out are for others to cross.
inline constexpr size_t kMostCrossed = 64;

// Edges of one solid, in columns: where they begin, their directions, and the normals of the faces
// beside them.
struct EdgeColumns {
  using Column3 = std::array<std::array<float, kMostCrossed>, 3>;

  size_t count;
  Column3 from, direction, left, right;
};

// The best axis across two edges, if it `exists`. `gap`: along it.
struct Crossing {
  float gap;
  size_t of_a = 0, of_b = 0;
  bool exists = false;
  bool is_doubtful = false;  // some edges that cross are along each other
};

// What runs in lanes; scalar::kHullSteps has the same, scalar.
struct HullSteps {
  // turn * (point * scale) + offset.
  void (*place)(const Solid& solid, const scalar::Rotation<float>& turn, const Vector3f& offset,
                HullPoints& out);
  // By one more ball. Of the faces that were not tried the first with the greatest bound.
  BestFace (*bound)(const Solid& solid, const Ball& ball, FaceBounds& bounds);
  // By all points, which are few: of all faces the first with the greatest gap.
  BestFace (*try_all)(const Solid& solid, const HullPoints& points, FaceBounds& bounds);
  // Which of the balls leave an axis beside a face no more than `gap`, below zero.
  void (*settle)(const Solid& solid, float gap, FaceBounds& bounds);
  FurthestOfHull (*furthest)(const HullPoints& points, const Vector3f& way);
  // The best axis across an edge of A and one of B of which the arcs cross, if its gap is more than
  // `gap`; of equals the first.
  // `turn`: of the directions and normals of B to the frame of the rest.
  Crossing (*cross)(const EdgeColumns& a, const EdgeColumns& b, const scalar::Rotation<float>& turn,
                    float gap);
  // The furthest, and how many points reach as far up to kFacingSlack.
  FacingPoints (*facing)(const HullPoints& points, const Vector3f& way);
};

// The contact of two solids that surely overlap; unsure if their features do not tell it, or if
// they meet in more than one place.
scalar::Separation solid_depth(const Solid& a, const Solid& b, const scalar::PairPose<float>& pose,
                               const HullSteps& steps);

// The same of shapes: hulls, boxes and triangles.
template <class A, class B>
scalar::Separation shape_depth(const A& a, const B& b, const scalar::PairPose<float>& pose,
                               const HullSteps& steps) {
  const auto solid_a = solid_of(a);
  const auto solid_b = solid_of(b);
  return solid_depth(solid_a.view(), solid_b.view(), pose, steps);
}

}  // namespace carom

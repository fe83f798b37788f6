// The penetration depth and direction of two solids, in float32 and scaled units. The search tries
// every separating axis that could give the least depth.
//
// The axes are the normals of faces, and the cross products of two edges whose arcs on the sphere
// of normals cross. An axis between the two faces at an edge has no greater gap than one point of
// the other solid allows for both faces. So most edges need no test of their own.
//
// Sources: S. Gottschalk, M. C. Lin, D. Manocha, "OBBTree", SIGGRAPH 1996 (the axes); D. Gregorius,
// "The Separating Axis Test between Convex Polyhedra", Game Developers Conference, 2013 (the arcs).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "narrowphase/hulls/deep_frames.h"
#include "narrowphase/hulls/shell.h"
#include "narrowphase/hulls/solid.h"
#include "narrowphase/scalar/separation.h"

namespace carom {

// Points of one solid in the frame of another, in columns. Whole vectors are filled: the places
// after the last point repeat the first.
struct HullPoints {
  alignas(64) std::array<float, 3 * kMostLanePoints> numbers;  // a column follows the other
  size_t count, padded;

  const float* column(size_t axis) const { return numbers.data() + axis * padded; }
  float* column(size_t axis) { return numbers.data() + axis * padded; }
  Vector3f operator[](size_t i) const { return {column(0)[i], column(1)[i], column(2)[i]}; }
  PointView view() const { return {{column(0), column(1), column(2)}, count, padded}; }
};

// The first of the furthest points along a direction.
struct FurthestOfHull {
  size_t index;
  float height;
};

struct FacingPoints {
  FurthestOfHull furthest;
  size_t count;
};

// One point of the other solid (radius 0), or a ball inside it.
struct Ball {
  Vector3f middle;
  float radius;
};

// Upper bounds of the gaps of the face axes of one solid, from balls in the other solid. If the
// middle of a ball is below both faces of an edge, no axis between the two has a greater gap than
// the greater of the two bounds.
class FaceBounds {
 public:
  static constexpr size_t kMost = Solid::kMostFaces;
  static constexpr size_t kMostBalls = 32;

  size_t count;  // of balls so far
  // The least bound of all balls.
  alignas(64) std::array<float, kMost> gap;
  // A bit per ball, in rows of eight balls: `between` is low enough.
  alignas(64) std::array<std::array<uint8_t, kMost>, kMostBalls / 8> settled;

  void begin(const Solid& solid) {
    count = 0;
    padded_ = padded_count(solid.face_count);
  }
  // The bounds of one ball for axes between faces. Above zero: its middle is above the face.
  float* between(size_t ball) { return between_.data() + ball * padded_; }
  const float* between(size_t ball) const { return between_.data() + ball * padded_; }
  size_t settled_rows() const { return (count + 7) / 8; }

 private:
  size_t padded_;
  // A row follows the other: rows a power of two apart would share few lines of the nearest cache.
  alignas(64) std::array<float, kMostBalls * kMost> between_;
};

struct BestFace {
  float gap = -scalar::kLargest;
  size_t face = 0;
};

// What the support point of a face gives: the gap of the face's axis, and the face to try next.
struct TriedFace {
  float gap;
  BestFace next;
};

// With more open edges than this on one solid, the pair is unsure and goes to double precision.
inline constexpr size_t kMostCrossed = 64;

// The edges of a solid that may have an axis better than those of the faces.
struct OpenEdges {
  static constexpr size_t kAtOnce = 4;  // so many are written at a time

  size_t count;
  std::array<uint16_t, Solid::kMostEdges + kAtOnce> index;
};

struct CrossedEdges {
  const Solid& solid;
  const OpenEdges& open;  // up to kMostCrossed, and at least one
  const Solid::Edge* edges;
  const std::array<float, 4>* points;

  // `of_dop` takes the edges of a k-DOP.
  CrossedEdges(const Solid& of, const OpenEdges& which, DopEdges& of_dop)
      : solid(of), open(which), edges(of.edges), points(of.point_record) {
    if (!of.dop) return;
    of_dop.put(*of.dop, {open.index.data(), open.count});
    edges = of_dop.edges.data();
    points = of_dop.points.data();
  }
  const Solid::Edge& edge(size_t k) const { return edges[open.index[k]]; }
};

// The best axis perpendicular to an edge of each solid, if it `exists`. `gap` is measured along it.
struct Crossing {
  float gap;
  size_t of_a = 0, of_b = 0;  // which of the open edges
  bool exists = false;
  bool is_doubtful = false;  // some edges with crossing arcs are nearly parallel
};

// The steps of the search that run in lanes; scalar::kHullSteps holds their scalar forms.
struct HullSteps {
  // Finds what the search needs of all poses, and at its end turns all contacts to world axes.
  void (*set_up)(DeepFrames& frames);
  void (*finish)(DeepFrames& frames);
  // Computes turn * (point * scale) + offset of all points.
  void (*place)(const Solid& solid, const scalar::Rotation<float>& turn, const Vector3f& offset,
                HullPoints& out);
  // Adds the bounds of one more ball. Returns the first face with the greatest bound.
  BestFace (*bound)(const Solid& solid, const Ball& ball, FaceBounds& bounds);
  // Finds the gap of a face's axis, and adds the bounds of the point that gives it.
  TriedFace (*try_face)(const Solid& solid, const HullPoints& points, size_t face,
                        FaceBounds& bounds);
  // Uses all points of the other solid, which are few. Returns the first face with the greatest
  // gap.
  BestFace (*try_all)(const Solid& solid, const HullPoints& points, FaceBounds& bounds);
  // Finds the edges between two faces that no ball settles together: none bounds the axes beside
  // both by `gap`, which is below zero.
  void (*find_open)(const Solid& solid, float gap, FaceBounds& bounds, OpenEdges& open);
  // The best axis perpendicular to an edge of A and one of B whose arcs cross, if its gap is
  // greater than `gap`; the first of equals. turn * p + offset takes B to the frame of A.
  Crossing (*cross)(const CrossedEdges& a, const CrossedEdges& b,
                    const scalar::Rotation<float>& turn, const Vector3f& offset, float gap);
  FurthestOfHull (*furthest)(const PointView& points, const Vector3f& way);
  // The furthest point, and the number of points that reach as far up to kFacingSlack.
  FacingPoints (*facing)(const HullPoints& points, const Vector3f& way);
  // Whether a point is inside, up to rounding; in the frame of the solid.
  bool (*is_inside)(const Solid& solid, const Vector3f& point);
  // Computes where the corners of a shell are: points of A less points of B, which are in scaled
  // units and the frame of A. Places that are not in use get anything.
  void (*place_corners)(const Shell& shell, const Solid& a, const PointView& b, ShellSpace& space);
  // How near the planes of a shell come to zero. Computes normals and volumes.
  ShellCheck (*check_planes)(const Shell& shell, ShellSpace& space);
  // How near its triangles come, which takes longer; where zero is inside.
  ShellCheck (*check_edges)(const Shell& shell, const ShellSpace& space);
  // A bit for each triangle that the point is in front of; after check_planes().
  uint64_t (*in_front)(const Shell& shell, const ShellSpace& space, const Vector3f& point);
};

// Two solids that surely overlap, in scaled units.
struct DeepPair {
  const Solid* a;
  const Solid* b;
  Vector3f d;  // position of B relative to A
  scalar::Quaternion<float> turn_a, turn_b;
  float slack = 0;         // by how much the depth that is found may exceed the least one
  Shell* shell = nullptr;  // for shell_depths(), which changes it; nullptr: there is to be none
};

// The contacts of up to kMostDeepPairs pairs. With a slack the search leaves out axes that are
// better by no more than it. Unsure if the features of two solids do not give it, or if the witness
// points are not unique. Poses are turned a pair a lane. Each step of the search is taken for all
// pairs before the next one.
void solid_depths(std::span<const DeepPair> pairs, const HullSteps& steps,
                  scalar::Separation* contacts);

// The same by shells alone, of hulls that may be apart: those of the last step, or new ones where
// there are none or they prove nothing. The depth that is found may be too small by the slack as
// well. Unsure, and the shell without triangles, where no shell proves a depth.
void shell_depths(std::span<const DeepPair> pairs, const HullSteps& steps,
                  scalar::Separation* contacts);

// Makes the contact of the cores of two shapes that of the shapes.
template <class A>
void grow(scalar::Separation& s, const A& a) {
  if constexpr (requires { a.radius; }) {
    s.separation -= a.radius;
    s.arm_a += s.normal * a.radius;
  }
}

// The contact of two shapes whose cores overlap.
template <class A, class B>
scalar::Separation shape_depth(const A& a, const B& b, const scalar::PairPose<float>& pose,
                               const HullSteps& steps) {
  const SolidOf<A> solid_a(a);
  const SolidOf<B> solid_b(b);
  const DeepPair pair{&solid_a.view(), &solid_b.view(), pose.d, pose.a, pose.b};
  scalar::Separation s;
  solid_depths({&pair, 1}, steps, &s);
  grow(s, a);
  return s;
}

}  // namespace carom

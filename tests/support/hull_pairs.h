// Pairs of hulls with hulls, boxes and triangles, many of them face on face: faces with three to
// very many corners, and hulls without features.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/tolerances.h"
#include "shapes/hull_features.h"
#include "tests/support/hulls.h"
#include "tests/support/kind_pairs.h"

namespace carom::test {

// --- Hulls, about one in size ---

Points bipyramid(size_t sides);

Points repeated(const Points& points, size_t times);

// Made with its known faces, since searching for those is slow.
Hull fine_prism(size_t sides);

// A cube with additional corners in the middle of all edges: faces have eight corners, some of them
// collinear.
Hull cube_with_corners_on_edges();

std::vector<Hull> solid_hulls();

// Hulls without features, or with more points than the kernels in lanes take.
std::vector<Hull> hulls_of_unknown_faces();

// --- Pairs ---

// Makes pairs of a hull with another shape, many of them face on face.
class HullPairMaker {
 public:
  HullPairMaker(KindPair kinds, PositionType positions, uint64_t seed)
      : kinds_(kinds), positions_(positions), random_(seed) {}

  TestPair next();

 private:
  Shape shape(ShapeKind kind, double size);

  Triangle triangle(float size);

  // A hull without features gets a normal across the points that it lies in.
  Eigen::Vector3d any_normal(const Shape& shape);

  static std::vector<Eigen::Vector3d> corners_of(const PlacedShape& body);
  static double reach(const PlacedShape& body, const Eigen::Vector3d& way);

  static Eigen::Vector3d middle(const PlacedShape& body);

  // A small angle, or zero.
  double tilt() { return random_.chance(0.3) ? 0 : random_.log_uniform(1e-7, 1e-2); }

  Eigen::Quaterniond any_rotation();

  // In three of four cases a face of `one` lies on a face of `hull`, or a little above or below it.
  void place(PlacedShape& one, PlacedShape& hull, double size);

  KindPair kinds_;
  PositionType positions_;
  Random random_;
};

std::vector<TestPair> make_hull_pairs(KindPair kinds, PositionType positions, size_t count,
                                      uint64_t seed);

}  // namespace carom::test

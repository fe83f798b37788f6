// Random shapes and orientations of the kinds that have a direct solution.
#pragma once

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "carom/shapes/body.h"
#include "oracle/hull_faces.h"
#include "oracle/random.h"

namespace carom::oracle {

// How the shapes of a family are drawn.
struct ConvexStyle {
  double aspect = 4;        // the greatest ratio of lengths, radii and half extents
  bool degenerate = false;  // zero radii, zero lengths, flat boxes, triangles without area
  bool lattice = false;     // small integers times the size
  bool aligned = false;     // edges along the axes of the body
};

class ConvexRandom {
 public:
  ConvexRandom(const ConvexStyle& style, Random& random) : style_(style), random_(random) {}

  Shape shape(ShapeKind kind, double size);

  // Uniform rotation; one quaternion in five is not a unit one.
  Eigen::Quaternionf orientation();

  // One of the 24 rotations that map axes to axes, exactly. The quaternion has integer components,
  // so it is seldom a unit one.
  Eigen::Quaternionf quarter_turns();

  int integer(int low, int high);

 private:
  // Between size / aspect and size; 0 sometimes in the degenerate style.
  double extent(double size);

  Eigen::Vector3d extents(double size);

  Eigen::Vector3f half(double size) { return extents(size).cast<float>(); }
  float length(double size) { return static_cast<float>(extent(size)); }

  // Above 0; in the degenerate style often small.
  float rounding(double size);

  // Offset of the shape's centre from the body's origin.
  Eigen::Vector3d shift(double size);

  Eigen::Vector3d vector(double size);

  Eigen::Vector3d lattice_point(double size, int largest);

  // A coordinate axis or a random direction.
  Eigen::Vector3d direction();

  Capsule capsule(double size);

  Aabb aabb(double size);

  Triangle triangle(double size);

  // Makes the triangle degenerate: a point, a segment or a sliver.
  void spoil(Triangle& triangle, double size);

  // The k-DOP of a few points or of a box's corners. Some slabs are then narrowed.
  Dop dop(double size);

  // Narrows random slabs so that all still contain the point.
  void narrow(Dop& dop, const Eigen::Vector3d& point);

  // Limits the size so that coordinates do not overflow float32.
  Hull hull(double size);

  // Corners of a box, on an ellipsoid, anywhere in a box, or (but for rounding) in one plane or on
  // one line.
  std::vector<Eigen::Vector3d> corners(double size);

  size_t corner_count();

  Halfspace halfspace(double size);

  ConvexStyle style_;
  Random& random_;
};

}  // namespace carom::oracle

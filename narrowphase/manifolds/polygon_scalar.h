// The facing faces of boxes and triangles: the scalar form.
#pragma once

#include <array>

#include "base/few_of.h"
#include "base/tolerances.h"
#include "narrowphase/scalar/shapes.h"

namespace carom::scalar {

// The pose of a body, relative to the position of A.
struct Placed {
  Rotation<float> turn;
  Vector3f origin;
};

// A plane with coordinates.
struct FaceFrame {
  Vector3f origin, u, v, n;  // u, v, n: unit vectors, perpendicular
  float height;              // of the plane along n

  Vector3f point(float x, float y) const { return ((origin + n * height) + u * x) + v * y; }
};

struct Point2 {
  float x, y;
};

// The face of a box.
struct Rectangle {
  FaceFrame frame;
  Point2 lower, upper;

  std::array<Point2, 4> corners() const {
    return {{lower, {upper.x, lower.y}, upper, {lower.x, upper.y}}};
  }
};

// A triangle with its longest edge along x. Without area all its numbers are zero.
struct TriangleFace {
  FaceFrame frame;
  std::array<Point2, 3> points;  // counter-clockwise

  const std::array<Point2, 3>& corners() const { return points; }
};

// The face of a k-DOP or hull. Without area it has no points, and its normal is zero.
struct PolygonFace {
  FaceFrame frame;
  FewOf<Point2, DopFace::kMostCorners> points;  // counter-clockwise

  const FewOf<Point2, DopFace::kMostCorners>& corners() const { return points; }
};

template <class Face>
concept AnyPolygon = requires(Face face) {
  face.points;
};

inline Vector3f lower_corner(const AabbShape<float>& box) { return box.lower; }
inline Vector3f upper_corner(const AabbShape<float>& box) { return box.upper; }
inline Vector3f lower_corner(const BoxShape<float>& box) { return -box.half; }
inline Vector3f upper_corner(const BoxShape<float>& box) { return box.half; }

template <class Shape>
inline constexpr bool kIsBox = false;
template <>
inline constexpr bool kIsBox<AabbShape<float>> = true;
template <>
inline constexpr bool kIsBox<BoxShape<float>> = true;

template <class Shape>
concept AnyBox = kIsBox<Shape>;

// The face whose normal is nearest to m; on a tie the face of the first axis.
template <AnyBox Box>
Rectangle face_towards(const Vector3f& m, const Box& box, const Placed& placed) {
  const Vector3f along = rotate_back(placed.turn, m);
  const float x = std::fabs(along.x()), y = std::fabs(along.y()), z = std::fabs(along.z());
  const int n = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  const int u = (n + 1) % 3, v = (n + 2) % 3;
  const Vector3f axes[3] = {placed.turn.x, placed.turn.y, placed.turn.z};
  const Vector3f lower = lower_corner(box), upper = upper_corner(box);
  return {{placed.origin, axes[u], axes[v], axes[n], along[n] > 0 ? upper[n] : lower[n]},
          {lower[u], lower[v]},
          {upper[u], upper[v]}};
}

inline std::array<Vector3f, 3> corners_of(const TriangleShape<float>& triangle,
                                          const Placed& placed) {
  std::array<Vector3f, 3> corners;
  for (size_t i = 0; i < 3; ++i) {
    corners[i] = rotate(placed.turn, triangle.corners[i]) + placed.origin;
  }
  return corners;
}

// The axes start from the longest edge. The normal of a sliver is uncertain only by a tilt about
// that edge, which moves no point far.
inline TriangleFace triangle_face(const std::array<Vector3f, 3>& corners) {
  std::array<Vector3f, 3> edges;
  std::array<float, 3> squares;
  for (size_t i = 0; i < 3; ++i) {
    edges[i] = corners[(i + 1) % 3] - corners[i];
    squares[i] = dot(edges[i], edges[i]);
  }
  const size_t first = squares[0] >= squares[1] && squares[0] >= squares[2] ? 0
                       : squares[1] >= squares[2]                           ? 1
                                                                            : 2;
  const Vector3f along = edges[first];
  const Vector3f back = edges[(first + 2) % 3];
  const float squared_length = squares[first];
  const Vector3f raw = cross<float>(back, along);
  // Any part along the longest edge is rounding.
  const Vector3f across = raw - along * (dot(raw, along) / squared_length);
  const float squared = dot(across, across);
  TriangleFace face;
  face.frame.origin = corners[first];
  face.frame.height = 0;
  if (!(squared > kSliver * (squared_length * squared_length))) {
    face.frame.u = face.frame.v = face.frame.n = Vector3f::Zero();
    face.points = {};
    return face;
  }
  face.frame.n = across * (1 / std::sqrt(squared));
  face.frame.u = along * (1 / std::sqrt(squared_length));
  face.frame.v = cross<float>(face.frame.n, face.frame.u);
  face.points = {{{0, 0},
                  {dot(face.frame.u, along), 0},
                  {-dot(face.frame.u, back), -dot(face.frame.v, back)}}};
  return face;
}

// Special triangles have a face on their front side only. `toward` leads to the other shape.
inline bool shows_face(const TriangleShape<float>& triangle, const Vector3f& normal,
                       const Vector3f& toward) {
  return !triangle.is_special() || dot(normal, toward) > kFront;
}

}  // namespace carom::scalar

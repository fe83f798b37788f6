// Closed forms of the time of impact of two shapes that move in a straight line without turning.
// Relative to one shape the position of the other moves, and the difference of their cores stands
// still.
#pragma once

#include "impacts/linear/axes_scalar.h"
#include "impacts/linear/box_scalar.h"
#include "impacts/linear/rounded_scalar.h"
#include "narrowphase/scalar/shapes.h"

namespace carom::scalar {

struct LinearPose {
  Vector3d from, way;       // of B relative to A, in world axes
  Quaternion<double> a, b;  // orientations
  double slack;             // error of all lengths
};

// The core of a capsule in world axes, relative to its position. PlacedFace is that of a triangle.
struct PlacedEdge {
  Vector3d start, edge;

  PlacedEdge(const CapsuleShape<double>& capsule, const Quaternion<double>& q) {
    const Rotation<double> turn = rotation_of(q);
    start = rotate(turn, capsule.a);
    edge = rotate(turn, capsule.b) - start;
  }
};

struct PlacedFace {
  Vector3d corner, u, v;

  PlacedFace(const TriangleShape<double>& triangle, const Quaternion<double>& q) {
    const Rotation<double> turn = rotation_of(q);
    corner = rotate(turn, triangle.corners[0]);
    u = rotate(turn, triangle.corners[1]) - corner;
    v = rotate(turn, triangle.corners[2]) - corner;
  }
};

inline double linear_time(const SphereShape<double>& a, const SphereShape<double>& b,
                          const LinearPose& pose) {
  return meets_ball({pose.from, pose.way}, (a.radius + b.radius) + pose.slack);
}

inline double linear_time(const SphereShape<double>& a, const CapsuleShape<double>& b,
                          const LinearPose& pose) {
  const PlacedEdge core(b, pose.b);
  const MovingPoint point(-(pose.from + core.start), -pose.way);
  return meets_segment(point, core.edge, (a.radius + b.radius) + pose.slack);
}

inline double linear_time(const CapsuleShape<double>& a, const CapsuleShape<double>& b,
                          const LinearPose& pose) {
  const PlacedEdge core_a(a, pose.a), core_b(b, pose.b);
  const MovingPoint point(core_a.start - (pose.from + core_b.start), -pose.way);
  return meets_parallelogram(point, core_b.edge, -core_a.edge, (a.radius + b.radius) + pose.slack,
                             pose.slack);
}

inline double linear_time(const SphereShape<double>& a, const BoxShape<double>& b,
                          const LinearPose& pose) {
  const Rotation<double> frame = rotation_of(pose.b);
  const MovingPoint point(rotate_back(frame, Vector3d(-pose.from)),
                          rotate_back(frame, Vector3d(-pose.way)));
  return meets_box(point, b.half, a.radius + pose.slack);
}

inline double linear_time(const CapsuleShape<double>& a, const BoxShape<double>& b,
                          const LinearPose& pose) {
  const PlacedEdge core(a, pose.a);
  const Rotation<double> frame = rotation_of(pose.b);
  const MovingPoint point(rotate_back(frame, Vector3d(core.start - pose.from)),
                          rotate_back(frame, Vector3d(-pose.way)));
  return meets_box(point, rotate_back(frame, core.edge), b.half, a.radius + pose.slack, pose.slack);
}

inline double linear_time(const BoxShape<double>& a, const BoxShape<double>& b,
                          const LinearPose& pose) {
  const Rotation<double> frame = rotation_of(pose.a), turn = rotation_of(pose.b);
  const Rotation<double> seen{rotate_back(frame, turn.x), rotate_back(frame, turn.y),
                              rotate_back(frame, turn.z)};
  return boxes_meet(rotate_back(frame, pose.from), rotate_back(frame, pose.way), a.half, b.half,
                    seen, pose.slack);
}

inline double linear_time(const SphereShape<double>& a, const TriangleShape<double>& b,
                          const LinearPose& pose) {
  const PlacedFace core(b, pose.b);
  const MovingPoint point(-(pose.from + core.corner), -pose.way);
  const Face face(core.u, core.v);
  const double reach = a.radius + pose.slack;
  const double time = meets_triangle(point, face, reach, reach + face.width(), pose.slack);
  return face.is_slanted ? kNoClosedForm : time;
}

inline double linear_time(const CapsuleShape<double>& a, const TriangleShape<double>& b,
                          const LinearPose& pose) {
  const PlacedEdge core_a(a, pose.a);
  const PlacedFace core_b(b, pose.b);
  const MovingPoint point(core_a.start - (pose.from + core_b.corner), -pose.way);
  return meets_prism(point, Face(core_b.u, core_b.v), -core_a.edge, a.radius + pose.slack,
                     pose.slack);
}

inline double linear_time(const BoxShape<double>& a, const TriangleShape<double>& b,
                          const LinearPose& pose) {
  const Rotation<double> frame = rotation_of(pose.a), turn = rotation_of(pose.b);
  std::array<Vector3d, 3> corners;
  for (size_t i = 0; i < 3; ++i) {
    corners[i] = rotate_back(frame, Vector3d(pose.from + rotate(turn, b.corners[i])));
  }
  return box_meets_triangle(corners, rotate_back(frame, pose.way), a.half, pose.slack);
}

// The plane of a half-space, and the height of the other body's position over it.
struct LinearPlane {
  Vector3d normal;
  double height, rate;

  LinearPlane(const HalfspaceShape<double>& b, const LinearPose& pose)
      : normal(rotate(rotation_of(pose.b), b.normal)),
        height(-dot(normal, pose.from) - b.offset),
        rate(-dot(normal, pose.way)) {}
};

// The height of a body's lowest point along a normal, relative to the body's position.
inline double lowest(const SphereShape<double>& sphere, const Quaternion<double>&,
                     const Vector3d&) {
  return -sphere.radius;
}
inline double lowest(const CapsuleShape<double>& capsule, const Quaternion<double>& q,
                     const Vector3d& n) {
  const PlacedEdge core(capsule, q);
  const double start = dot(n, core.start);
  return min(start, start + dot(n, core.edge)) - capsule.radius;
}
inline double lowest(const BoxShape<double>& box, const Quaternion<double>& q, const Vector3d& n) {
  return -reach_of_box(box.half, rotate_back(rotation_of(q), n));
}
inline double lowest(const TriangleShape<double>& triangle, const Quaternion<double>& q,
                     const Vector3d& n) {
  const Rotation<double> turn = rotation_of(q);
  const auto height = [&](size_t i) { return dot(n, rotate(turn, triangle.corners[i])); };
  return min(min(height(0), height(1)), height(2));
}

template <class A>
requires requires(A a, Quaternion<double> q, Vector3d n) { lowest(a, q, n); }
double linear_time(const A& a, const HalfspaceShape<double>& b, const LinearPose& pose) {
  const LinearPlane plane(b, pose);
  return meets_plane(plane.height + lowest(a, pose.a, plane.normal), plane.rate, pose.slack);
}

}  // namespace carom::scalar

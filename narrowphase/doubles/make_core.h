// Shapes as cores: points in world axes, relative to the body's position plus `offset`.
#pragma once

#include "narrowphase/doubles/core.h"
#include "narrowphase/scalar/polytope.h"

namespace carom::scalar {

inline CoreVector core_vector(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline Vector3d eigen_vector(const CoreVector& v) { return {v.x, v.y, v.z}; }

// `offset` is added to every point.
inline void make_core(const SphereShape<double>& sphere, const Quaternion<double>&,
                      const Vector3d& offset, Core& core) {
  core.resize(1);
  core.set(0, core_vector(offset));
  core.pad();
  core.radius = sphere.radius;
  core.middle = core_vector(offset);
}

inline void make_core(const CapsuleShape<double>& capsule, const Quaternion<double>& q,
                      const Vector3d& offset, Core& core) {
  const Rotation<double> turn = rotation_of(q);
  const Vector3d a = rotate(turn, capsule.a) + offset, b = rotate(turn, capsule.b) + offset;
  core.resize(2);
  core.set(0, core_vector(a));
  core.set(1, core_vector(b));
  core.pad();
  core.radius = capsule.radius;
  core.middle = core_vector(rotate(turn, Vector3d((capsule.a + capsule.b) / 2)) + offset);
}

// A round core in the frame of its shape: points at either end of the z axis, or one in the middle,
// and an ellipsoid with these half axes about each, times the share of the point. A half axis of
// zero makes it flat.
struct RoundNumbers {
  Vector3d half_axes;
  double half_length;
  std::array<double, 2> shares;  // of the lower point, and of the upper one
};

inline RoundNumbers round_numbers(const CylinderShape<double>& cylinder) {
  return {{cylinder.radius, cylinder.radius, 0}, cylinder.half_length, {1, 1}};
}
inline RoundNumbers round_numbers(const ConeShape<double>& cone) {
  return {{cone.radius, cone.radius, 0}, cone.half_length, {1, 0}};
}
inline RoundNumbers round_numbers(const EllipsoidShape<double>& ellipsoid) {
  return {ellipsoid.semi_axes, 0, {1, 1}};
}

template <RoundShape S>
void make_core(const S& shape, const Quaternion<double>& q, const Vector3d& offset, Core& core) {
  const RoundNumbers numbers = round_numbers(shape);
  const Rotation<double> turn = rotation_of(q);
  const auto turned = [&](const Vector3d& v) { return rotate(turn, v); };
  const Vector3d top(0, 0, numbers.half_length), &half = numbers.half_axes;
  core.resize(numbers.half_length > 0 ? 2 : 1);
  core.set(0, core_vector(turned(-top) + offset));
  if (numbers.half_length > 0) core.set(1, core_vector(turned(top) + offset));
  core.pad();
  core.make_round({{core_vector(turned(Vector3d(half.x(), 0, 0))),
                    core_vector(turned(Vector3d(0, half.y(), 0))),
                    core_vector(turned(Vector3d(0, 0, half.z())))},
                   numbers.shares});
  core.radius = shape.rounding;
  core.middle = core_vector(offset);
}

// As rotate(), without Eigen's loops, which compilers do not inline in long functions.
inline CoreVector rotated_core_vector(const Rotation<double>& turn, const Vector3d& v) {
  return (core_vector(turn.x) * v.x() + core_vector(turn.y) * v.y()) + core_vector(turn.z) * v.z();
}

inline void make_core_of_box(const Vector3d& lower, const Vector3d& upper,
                             const Rotation<double>& turn, const Vector3d& offset, Core& core) {
  core.resize(8);
  const CoreVector way = core_vector(offset);
  for (size_t i = 0; i < 8; ++i) {  // bit k of i: at the upper end of axis k
    const Vector3d corner((i & 1 ? upper : lower).x(), (i & 2 ? upper : lower).y(),
                          (i & 4 ? upper : lower).z());
    core.set(i, rotated_core_vector(turn, corner) + way);
  }
  core.radius = 0;
  core.middle = rotated_core_vector(turn, Vector3d((lower + upper) / 2)) + way;
}

inline void make_core(const AabbShape<double>& box, const Quaternion<double>&,
                      const Vector3d& offset, Core& core) {
  const Rotation<double> unturned{Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
  make_core_of_box(box.lower, box.upper, unturned, offset, core);
}

inline void make_core(const BoxShape<double>& box, const Quaternion<double>& q,
                      const Vector3d& offset, Core& core) {
  make_core_of_box(-box.half, box.half, rotation_of(q), offset, core);
  core.radius = box.rounding;
}

template <class Points>
Vector3d middle_of_points(const Points& points) {
  Vector3d sum = Vector3d::Zero();
  for (size_t i = 0; i < points.size(); ++i) sum += points[i];
  return sum / static_cast<double>(points.size());
}
inline Vector3d middle_of(const TriangleShape<double>& triangle) {
  return middle_of_points(triangle.corners);
}

template <class Points>
void make_core_of_points(const Points& points, const Vector3d& offset, Core& core) {
  core.resize(points.size());
  for (size_t i = 0; i < points.size(); ++i) core.set(i, core_vector(points[i] + offset));
  core.pad();
  core.radius = 0;
  core.middle = core_vector(middle_of_points(points) + offset);
}

inline void make_core(const TriangleShape<double>& triangle, const Quaternion<double>& q,
                      const Vector3d& offset, Core& core) {
  if (triangle.thickness > 0) {
    return make_core_of_points(polytope_of(triangle, q).points, offset, core);
  }
  const Rotation<double> turn = rotation_of(q);
  const CoreVector way = core_vector(offset);
  core.resize(3);
  for (size_t i = 0; i < 3; ++i) {
    core.set(i, rotated_core_vector(turn, triangle.corners[i]) + way);
  }
  core.pad();
  core.radius = 0;
  core.middle = rotated_core_vector(turn, middle_of(triangle)) + way;
}

inline void make_core(const DopShape<double>& dop, const Quaternion<double>& q,
                      const Vector3d& offset, Core& core) {
  const Rotation<double> turn = rotation_of(q);
  const DopCorners corners(dop);
  FewOf<Vector3d, DopPolytope::kMostPoints> points;
  for (size_t i = 0; i < corners.size(); ++i) points.push_back(rotate(turn, corners.point(i)));
  make_core_of_points(points, offset, core);
}

// Reads and writes columns, so that the compiler vectorizes the loop.
inline void make_core(const HullShape<double>& hull, const Quaternion<double>& q,
                      const Vector3d& offset, Core& core) {
  const Rotation<double> turn = rotation_of(q);
  const HullGeometry& geometry = *hull.geometry;
  const double s = hull.scale;
  const auto placed = [&](double x, double y, double z) -> CoreVector {
    return {((turn.x.x() * x + turn.y.x() * y) + turn.z.x() * z) + offset.x(),
            ((turn.x.y() * x + turn.y.y() * y) + turn.z.y() * z) + offset.y(),
            ((turn.x.z() * x + turn.y.z() * y) + turn.z.z() * z) + offset.z()};
  };
  core.resize(geometry.points().size());
  const float* const x = geometry.column(0);
  const float* const y = geometry.column(1);
  const float* const z = geometry.column(2);
  double* const to_x = core.x();
  double* const to_y = core.y();
  double* const to_z = core.z();
  for (size_t i = 0; i < core.padded_size(); ++i) {
    const CoreVector p = placed(x[i] * s, y[i] * s, z[i] * s);
    to_x[i] = p.x;
    to_y[i] = p.y;
    to_z[i] = p.z;
  }
  core.radius = hull.rounding;
  const Eigen::Vector3d& middle = geometry.middle();
  core.middle = placed(middle.x() * s, middle.y() * s, middle.z() * s);
}

}  // namespace carom::scalar

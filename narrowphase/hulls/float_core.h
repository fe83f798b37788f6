// Shapes as cores in float32. A core is the convex hull of points, grown by a radius.
#pragma once

#include "base/few_of.h"
#include "base/tolerances.h"
#include "narrowphase/scalar/shapes.h"
#include "narrowphase/scalar/vector.h"

namespace carom::scalar {

using Eigen::Vector3f;

// Points in world axes, relative to the position of A.
struct FloatCore {
  FewOf<Vector3f, kMostLanePoints> points;
  float radius = 0;
  Vector3f middle = Vector3f::Zero();
  bool has_space = true;  // the points fit, and the triangle is a plain one
};

inline FloatCore float_core(const SphereShape<float>& sphere, const Quaternion<float>&,
                            const Vector3f& offset) {
  return {{offset}, sphere.radius, offset};
}

inline FloatCore float_core(const CapsuleShape<float>& capsule, const Quaternion<float>& q,
                            const Vector3f& offset) {
  const Rotation<float> turn = rotation_of(q);
  const Vector3f a = rotate(turn, capsule.a) + offset, b = rotate(turn, capsule.b) + offset;
  return {{a, b}, capsule.radius, (a + b) * 0.5f};
}

inline FloatCore float_core_of_box(const Vector3f& lower, const Vector3f& upper,
                                   const Rotation<float>& turn, const Vector3f& offset) {
  FloatCore core;
  for (size_t i = 0; i < 8; ++i) {
    const Vector3f corner((i & 1 ? upper : lower).x(), (i & 2 ? upper : lower).y(),
                          (i & 4 ? upper : lower).z());
    core.points.push_back(rotate(turn, corner) + offset);
  }
  core.middle = rotate(turn, Vector3f((lower + upper) * 0.5f)) + offset;
  return core;
}

inline FloatCore float_core(const AabbShape<float>& box, const Quaternion<float>&,
                            const Vector3f& offset) {
  const Rotation<float> unturned{Vector3f::UnitX(), Vector3f::UnitY(), Vector3f::UnitZ()};
  return float_core_of_box(box.lower, box.upper, unturned, offset);
}

inline FloatCore float_core(const BoxShape<float>& box, const Quaternion<float>& q,
                            const Vector3f& offset) {
  return float_core_of_box(-box.half, box.half, rotation_of(q), offset);
}

inline FloatCore float_core(const TriangleShape<float>& triangle, const Quaternion<float>& q,
                            const Vector3f& offset) {
  const Rotation<float> turn = rotation_of(q);
  FloatCore core;
  for (const Vector3f& corner : triangle.corners) {
    core.points.push_back(rotate(turn, corner) + offset);
  }
  core.middle = core.points[0];
  core.has_space = !triangle.is_special();
  return core;
}

// A rotation that also scales. The scale is a power of two, so rounding is the same whichever
// factor takes it.
inline Rotation<float> placing_turn(const HullShape<float>& hull, const Quaternion<float>& q) {
  Rotation<float> turn = rotation_of(q);
  for (Vector3f* column : {&turn.x, &turn.y, &turn.z}) *column *= static_cast<float>(hull.scale);
  return turn;
}

inline FloatCore float_core(const HullShape<float>& hull, const Quaternion<float>& q,
                            const Vector3f& offset) {
  const Rotation<float> turn = placing_turn(hull, q);
  const auto placed = [&](const std::array<float, 4>& p) -> Vector3f {
    return rotate(turn, Vector3f(p[0], p[1], p[2])) + offset;
  };
  const size_t count = hull.geometry->points().size();
  FloatCore core;
  core.has_space = count <= kMostLanePoints;
  for (size_t i = 0; core.has_space && i < count; ++i) {
    core.points.push_back(placed(hull.geometry->records()[i]));
  }
  core.middle = placed(hull.geometry->records()[count]);
  return core;
}

}  // namespace carom::scalar

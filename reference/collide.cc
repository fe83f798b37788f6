// One pair of bodies -> decision, normal, separation, witness points.
#include <limits>
#include <variant>

#include "carom/reference/reference.h"
#include "kernel/float_environment.h"
#include "narrowphase/aabb_aabb_ref.h"
#include "narrowphase/sphere_aabb_ref.h"
#include "narrowphase/sphere_sphere_ref.h"

namespace carom::reference {
namespace {

// One overload a pair of kinds; `d` is the position of B relative to A's, rounded to float32 and
// not.
Separation separation_of(const Sphere& a, const Sphere& b, const Vector3f& d,
                         const Vector3d& exact_d) {
  return sphere_sphere(a.radius, b.radius, d, exact_d);
}

Separation separation_of(const Sphere& a, const Aabb& b, const Vector3f& d,
                         const Vector3d& exact_d) {
  return sphere_aabb(a.radius, b.lower, b.upper, d, exact_d);
}

Separation separation_of(const Aabb& a, const Aabb& b, const Vector3f& d, const Vector3d&) {
  return aabb_aabb(a.lower, a.upper, b.lower, b.upper, d);
}

PairResult result_of(const Separation& s) {
  return {s.separation <= 0, s.status, s.separation, s.normal, s.arm_a, s.arm_b};
}

PairResult no_answer() {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const Vector3f nan = Vector3f::Constant(kNan);
  return {false, Status::invalid, kNan, nan, nan, nan};
}

template <class Real>
Separation separation_at(const Shape& shape_a, const Eigen::Vector3<Real>& position_a,
                         const Shape& shape_b, const Eigen::Vector3<Real>& position_b) {
  const auto test = [&](const auto& a, const auto& b) {
    const Vector3d exact_d =
        position_b.template cast<double>() - position_a.template cast<double>();
    if constexpr (std::is_same_v<decltype(a), const Aabb&> &&
                  std::is_same_v<decltype(b), const Sphere&>) {
      return flipped(separation_of(b, a, relative_position(position_b, position_a), -exact_d));
    } else {
      return separation_of(a, b, relative_position(position_a, position_b), exact_d);
    }
  };
  return std::visit(test, shape_a, shape_b);
}

}  // namespace

PairResult collide(const Shape& shape_a, const Eigen::Vector3d& position_a, const Shape& shape_b,
                   const Eigen::Vector3d& position_b, PositionType positions) {
  const FloatEnvironment environment;
  if (!is_valid(shape_a, position_a, positions) || !is_valid(shape_b, position_b, positions)) {
    return no_answer();
  }
  if (positions == PositionType::float32) {
    return result_of(
        separation_at<float>(shape_a, position_a.cast<float>(), shape_b, position_b.cast<float>()));
  }
  return result_of(separation_at<double>(shape_a, position_a, shape_b, position_b));
}

}  // namespace carom::reference

// One pair of bodies -> decision, normal, separation, witness points, manifold.
#include <limits>
#include <variant>

#include "base/float_environment.h"
#include "carom/reference/reference.h"
#include "narrowphase/pairs/aabb/aabb_aabb_scalar.h"
#include "narrowphase/pairs/any_pair.h"
#include "narrowphase/pairs/rounded/rounded_scalar.h"
#include "narrowphase/pairs/sphere/sphere_aabb_scalar.h"
#include "narrowphase/pairs/sphere/sphere_sphere_scalar.h"
#include "narrowphase/scalar/near_touch.h"
#include "narrowphase/scalar/quaternion_as.h"
#include "narrowphase/scalar/scaled.h"
#include "reference/composite.h"
#include "reference/scalar.h"
#include "shapes/body_reader.h"

namespace carom::reference {
namespace {

// The poses of both bodies, in the two precisions of the tests.
struct Poses {
  PairPose<float> rounded;
  PairPose<double> exact;
};

Poses flipped(const Poses& poses) { return {flipped(poses.rounded), flipped(poses.exact)}; }

template <class Real>
Poses poses_of(const Pose& a, const Pose& b) {
  const Eigen::Vector3<Real> position_a = a.position.cast<Real>();
  const Eigen::Vector3<Real> position_b = b.position.cast<Real>();
  const Eigen::Vector4f q_a = a.orientation.coeffs();
  const Eigen::Vector4f q_b = b.orientation.coeffs();
  const Vector3d& exact_a = position_a.template cast<double>();
  const Vector3d& exact_b = position_b.template cast<double>();
  return {{relative_position(position_a, position_b), quaternion_as<float>(q_a),
           quaternion_as<float>(q_b), relative_position(position_b, position_a)},
          {exact_b - exact_a, quaternion_as<double>(q_a), quaternion_as<double>(q_b),
           exact_a - exact_b}};
}

// Shapes without an orientation have tests of their own.
Separation test(const Sphere& a, const Sphere& b, const Poses& poses) {
  return sphere_sphere(a.radius, b.radius, poses.rounded.d, poses.exact.d);
}
Separation test(const Sphere& a, const Aabb& b, const Poses& poses) {
  return sphere_aabb(a.radius, b.lower, b.upper, poses.rounded.d, poses.exact.d);
}
Separation test(const Aabb& a, const Sphere& b, const Poses& poses) {
  return flipped(test(b, a, flipped(poses)));
}
Separation test(const Aabb& a, const Aabb& b, const Poses& poses) {
  return aabb_aabb(a.lower, a.upper, b.lower, b.upper, poses.rounded.d);
}

Separation test(const Shape& a, const Shape& b, const Poses& poses);

// In the order of all tests.
Separation test_rounded(const Shape& a, const Shape& b, const Poses& poses) {
  if (comes_after(kind_of(a), kind_of(b))) return flipped(test_rounded(b, a, flipped(poses)));
  const auto of_cores = [&](const Shape& core_a, const Shape& core_b) {
    return test(core_a, core_b, poses);
  };
  const auto exact = [&] { return rounded(separation_of<double>(a, b, poses.exact)); };
  return scalar::rounded_answer(a, b, poses.rounded.d, of_cores, exact);
}

// All others: in float32, and again in double precision if the result is unsure.
Separation test(const Shape& a, const Shape& b, const Poses& poses) {
  if (scalar::is_rounded_pair(a, b)) return test_rounded(a, b, poses);
  const Separation result = separation_of<float>(a, b, poses.rounded);
  return result.is_unsure ? rounded(separation_of<double>(a, b, poses.exact)) : result;
}

template <class T>
inline constexpr bool kHasNoOrientation = std::is_same_v<T, Sphere> || std::is_same_v<T, Aabb>;

Separation test_any(const Shape& shape_a, const Shape& shape_b, const Poses& poses) {
  return std::visit(
      [&]<class A, class B>(const A& a, const B& b) {
        if constexpr (kHasNoOrientation<A> && kHasNoOrientation<B>) {
          return test(a, b, poses);
        } else {
          return test(shape_a, shape_b, poses);
        }
      },
      shape_a, shape_b);
}

PairResult no_answer() {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const Vector3f nan = Vector3f::Constant(kNan);
  return {false, Status::invalid, kNan, nan, nan, nan, 0, {}, 0, 0};
}

}  // namespace

PairResult collide(const Shape& shape_a, const Pose& pose_a, const Shape& shape_b,
                   const Pose& pose_b, PositionType positions, float contact_distance) {
  return find_contacts(shape_a, pose_a, shape_b, pose_b, positions, contact_distance, {}).first;
}

PairContacts find_contacts(const Shape& shape_a, const Pose& pose_a, const Shape& shape_b,
                           const Pose& pose_b, PositionType positions, float contact_distance,
                           const RegionLimits& limits) {
  const FloatEnvironment environment;
  if (!is_valid(shape_a, pose_a, positions) || !is_valid(shape_b, pose_b, positions)) {
    return {no_answer(), {}};
  }
  if (is_composite(kind_of(shape_a)) || is_composite(kind_of(shape_b))) {
    return collide_parts(shape_a, pose_a, shape_b, pose_b, positions, contact_distance, limits);
  }
  const Poses poses = positions == PositionType::float32 ? poses_of<float>(pose_a, pose_b)
                                                         : poses_of<double>(pose_a, pose_b);
  const Separation s = test_any(shape_a, shape_b, poses);
  const bool overlap = s.separation <= 0;
  const bool touches = has_contact(overlap, s.separation, contact_distance);
  const Manifold manifold =
      touches ? manifold_of(shape_a, shape_b, poses.rounded, s, contact_distance) : Manifold{};
  const PairResult result = {overlap, s.status,       s.separation,    s.normal, s.arm_a,
                             s.arm_b, manifold.count, manifold.points, 0,        0};
  return {result, {}};
}

}  // namespace carom::reference

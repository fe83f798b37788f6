// Linear times of impact of spheres, capsules and triangles (linear.h is the scalar form).
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "impacts/linear/rounded_kernels.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "impacts/linear/linear_load-inl.h"
#include "impacts/linear/rounded-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

HWY_INLINE D sum(D a, D b, D c) { return hn::Add(hn::Add(a, b), c); }

struct SphereSphere {
  using A = LinearSphere;
  using B = LinearSphere;
  static constexpr LinearKind kKindA = LinearKind::sphere;

  static HWY_INLINE D time(const LinearPair& pair, const A& a, const B& b) {
    return meets_ball(moving_point(pair.from, pair.way), sum(a.radius, b.radius, pair.slack));
  }
};

struct SphereCapsule {
  using A = LinearSphere;
  using B = LinearCapsule;
  static constexpr LinearKind kKindA = LinearKind::sphere;

  static HWY_INLINE D time(const LinearPair& pair, const A& a, const B& b) {
    const MovingPoint point = moving_point(-(pair.from + b.start), -pair.way);
    return meets_segment(point, b.edge, sum(a.radius, b.radius, pair.slack));
  }
};

struct CapsuleCapsule {
  using A = LinearCapsule;
  using B = LinearCapsule;
  static constexpr LinearKind kKindA = LinearKind::capsule;

  static HWY_INLINE D time(const LinearPair& pair, const A& a, const B& b) {
    const MovingPoint point = moving_point(a.start - (pair.from + b.start), -pair.way);
    return meets_parallelogram(point, b.edge, -a.edge, sum(a.radius, b.radius, pair.slack),
                               pair.slack);
  }
};

struct SphereTriangle {
  using A = LinearSphere;
  using B = LinearTriangle;
  static constexpr LinearKind kKindA = LinearKind::sphere;

  static HWY_INLINE D time(const LinearPair& pair, const A& a, const B& b) {
    const MovingPoint point = moving_point(-(pair.from + b.corner[0]), -pair.way);
    const Face face(b.corner[1] - b.corner[0], b.corner[2] - b.corner[0]);
    const D reach = hn::Add(a.radius, pair.slack);
    const D time = meets_triangle(point, face, reach, hn::Add(reach, face.width()), pair.slack);
    return unless_slanted(face.is_slanted, time);
  }
};

struct CapsuleTriangle {
  using A = LinearCapsule;
  using B = LinearTriangle;
  static constexpr LinearKind kKindA = LinearKind::capsule;

  static HWY_INLINE D time(const LinearPair& pair, const A& a, const B& b) {
    const MovingPoint point = moving_point(a.start - (pair.from + b.corner[0]), -pair.way);
    const Face face(b.corner[1] - b.corner[0], b.corner[2] - b.corner[0]);
    return meets_prism(point, face, -a.edge, hn::Add(a.radius, pair.slack), pair.slack);
  }
};

void sphere_sphere(LinearRows& rows, size_t count) { run_rows<SphereSphere>(rows, count); }
void sphere_capsule(LinearRows& rows, size_t count) { run_rows<SphereCapsule>(rows, count); }
void capsule_capsule(LinearRows& rows, size_t count) { run_rows<CapsuleCapsule>(rows, count); }
void sphere_triangle(LinearRows& rows, size_t count) { run_rows<SphereTriangle>(rows, count); }
void capsule_triangle(LinearRows& rows, size_t count) { run_rows<CapsuleTriangle>(rows, count); }

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(sphere_sphere);
HWY_EXPORT(sphere_capsule);
HWY_EXPORT(capsule_capsule);
HWY_EXPORT(sphere_triangle);
HWY_EXPORT(capsule_triangle);

}  // namespace

LinearKernel rounded_kernel(LinearKind a, LinearKind b) {
  using enum LinearKind;
  if (a == sphere && b == sphere) return CAROM_DISPATCH(sphere_sphere);
  if (a == sphere && b == capsule) return CAROM_DISPATCH(sphere_capsule);
  if (a == capsule && b == capsule) return CAROM_DISPATCH(capsule_capsule);
  if (a == sphere && b == triangle) return CAROM_DISPATCH(sphere_triangle);
  if (a == capsule && b == triangle) return CAROM_DISPATCH(capsule_triangle);
  return nullptr;
}

}  // namespace carom
#endif  // HWY_ONCE

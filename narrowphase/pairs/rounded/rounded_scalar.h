// Boxes and hulls with a rounding: the scalar form.
#pragma once

#include <variant>

#include "narrowphase/pairs/any_pair.h"
#include "narrowphase/pairs/rounded/growth.h"
#include "narrowphase/scalar/scaled.h"
#include "shapes/rounding.h"

namespace carom::scalar {

inline bool is_rounded_pair(const Shape& a, const Shape& b) {
  return is_rounded(kind_of(a)) || is_rounded(kind_of(b));
}

// Tests of round shapes know of their roundings; these are those of boxes and hulls.
inline float growth_of(const Shape& shape) {
  return is_rounded(kind_of(shape)) ? rounding_of(shape) : 0;
}
inline Shape core_of(const Shape& shape) {
  return is_rounded(kind_of(shape)) ? without_rounding(shape) : shape;
}

inline bool is_special_triangle(const Shape& shape) {
  const auto* triangle = std::get_if<Triangle>(&shape);
  return triangle && carom::is_special_triangle(ShapeKind::triangle, shape_rows(shape).data());
}

inline float core_size(const Shape& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return sphere->radius;
  if (const auto* box = std::get_if<Aabb>(&shape)) {
    return core_size_of_aabb({box->lower.x(), box->lower.y(), box->lower.z()},
                             {box->upper.x(), box->upper.y(), box->upper.z()});
  }
  return carom::core_size(kind_of(shape), shape_rows(shape).data());
}

inline Growth growth_of(const Shape& a, const Shape& b, const Vector3f& d) {
  return {growth_of(a), growth_of(b), distance_along_axes(d), core_size(a), core_size(b)};
}

template <class Real>
SeparationAs<Real> grown(SeparationAs<Real> core, Real a, Real b) {
  core.separation -= a + b;
  core.arm_a += core.normal * a;
  core.arm_b -= core.normal * b;
  return core;
}

// In double precision. Neither shape is a special triangle.
inline SeparationAs<double> rounded_separation(const Shape& a, const Shape& b,
                                               const PairPose<double>& pose) {
  return grown<double>(separation_of<double>(core_of(a), core_of(b), pose), growth_of(a),
                       growth_of(b));
}

// The answer of the standard tier, in metres; `answer` gives it for the cores, and `exact` the one
// of the whole pair in double precision.
template <class Answer, class Exact>
Separation rounded_answer(const Shape& a, const Shape& b, const Vector3f& d, const Answer& answer,
                          const Exact& exact) {
  if (is_special_triangle(a) || is_special_triangle(b)) return exact();
  const Growth growth = growth_of(a, b, d);
  const Separation result = grown<float>(answer(core_of(a), core_of(b)), growth.a, growth.b);
  return growth.is_sure(result.separation) ? result : exact();
}

// The manifold of cores with these roundings; `core` gives theirs, for their contact and reach.
template <class CoreManifold>
Manifold rounded_manifold(float a, float b, const Separation& contact, float reach,
                          const CoreManifold& core) {
  Separation of_cores = contact;
  of_cores.separation += a + b;
  of_cores.arm_a -= contact.normal * a;
  of_cores.arm_b += contact.normal * b;
  Manifold manifold = core(of_cores, reach + (a + b));
  grow_points(manifold.points, manifold.count, contact.normal, a, b, contact.separation);
  return manifold;
}

}  // namespace carom::scalar

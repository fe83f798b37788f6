// Cylinders and segments about zero, and where two that are nearly parallel touch, scalar form.
#pragma once

#include "narrowphase/features/round_tolerances.h"
#include "narrowphase/scalar/vector.h"

namespace carom::scalar {

// A disc that moves along its axis from -half_length to half_length.
struct AxialCore {
  Vector3<float> axis;  // unit
  float half_length, rim;
};

// The part of a unit vector that is across a unit axis. What rounding leaves along the axis counts
// if the vector nearly lies on it, so it is taken away once more.
inline Vector3<float> part_across(const Vector3<float>& n, const Vector3<float>& axis,
                                  float along) {
  const Vector3<float> across = n - axis * along;
  return across - axis * dot(axis, across);
}

// How far a core about zero reaches along n.
inline float reach(const AxialCore& core, const Vector3<float>& n) {
  const float along = dot(core.axis, n);
  const Vector3<float> across = n - core.axis * along;
  return core.half_length * std::fabs(along) + core.rim * std::sqrt(dot(across, across));
}

// The point of a core about zero that is furthest along n.
inline Vector3<float> furthest_point(const AxialCore& core, const Vector3<float>& n) {
  const float along = dot(core.axis, n);
  const Vector3<float> across = part_across(n, core.axis, along);
  const float over = 1 / max(std::sqrt(dot(across, across)), kLeastRim);
  return core.axis * std::copysign(core.half_length, along) + across * (core.rim * over);
}

// Whether a point lies in the core, or beside it by no more than `most`.
inline bool holds(const AxialCore& core, const Vector3<float>& p, float most = kBesideCore) {
  const float along = dot(core.axis, p);
  const Vector3<float> across = p - core.axis * along;
  const float reach = core.rim + most;
  return reach >= 0 && std::fabs(along) <= core.half_length + most &&
         dot(across, across) <= reach * reach;
}

// Whether a whole disc, or a whole line of the side, is furthest along n, but for kFlatTogether.
struct Spread {
  bool is_disc, is_line;

  Spread(const AxialCore& core, const Vector3<float>& n) {
    const float along = dot(core.axis, n);
    const Vector3<float> across = n - core.axis * along;
    const bool is_end = std::fabs(along) > 0.5f;
    is_disc = is_end && core.rim * std::sqrt(dot(across, across)) <= kFlatTogether;
    is_line = !is_end && core.half_length * std::fabs(along) <= kFlatTogether;
  }
};

// The middle of what two intervals share, from the middle of the first.
inline float middle_of_both(float half_a, float middle_b, float half_b) {
  return 0.5f * (max(-half_a, middle_b - half_b) + min(half_a, middle_b + half_b));
}

// Where two discs lie on one another: the middle of what they share, from A's middle.
inline Vector3<float> between_discs(const AxialCore& a, const AxialCore& b, const Vector3<float>& n,
                                    const Vector3<float>& t) {
  const Vector3<float> aside = part_across(t, a.axis, dot(t, a.axis));
  const float apart = std::sqrt(dot(aside, aside));
  const float share = middle_of_both(a.rim, apart, b.rim) / max(apart, kLeastRim);
  return a.axis * std::copysign(a.half_length, dot(a.axis, n)) + aside * share;
}

}  // namespace carom::scalar

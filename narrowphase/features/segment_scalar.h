// Nearest points of segments, scalar form.
//
// Source: C. Ericson, Real-Time Collision Detection, 2005, sections 5.1.2 and 5.1.9.
#pragma once

#include "base/tolerances.h"
#include "narrowphase/scalar/vector.h"

namespace carom::scalar {

// From a point to the nearest point of a segment.
template <class Real>
struct ToSegment {
  Vector3<Real> point;  // the nearest
  Vector3<Real> delta;  // from the given point to it
  bool is_across;       // `point` is not an end; `delta` is perpendicular to the segment
};

template <class Real>
ToSegment<Real> nearest_on_segment(const Vector3<Real>& p, const Vector3<Real>& a,
                                   const Vector3<Real>& b) {
  const Vector3<Real> d = b - a;
  const Real squared = dot(d, d);
  const Real t = squared > 0 ? clamp<Real>(dot(Vector3<Real>(p - a), d) / squared, 0, 1) : 0;
  const Vector3<Real> point = a + d * t;
  Vector3<Real> delta = point - p;
  // What rounding left along the segment would tilt the normal of a near pair.
  const bool is_across = t > Real(0) && t < Real(1);
  if (is_across) delta -= d * (dot(delta, d) / squared);
  return {point, delta, is_across};
}

// a / b clamped to [0, 1]; 0 unless b > 0.
template <class Real>
Real clamped_ratio(Real a, Real b) {
  return b > 0 ? clamp<Real>(a / b, 0, 1) : 0;
}

// Whether the parameter t of a segment is at neither end.
template <class Real>
bool is_inside(Real t) {
  return t > Real(0) && t < Real(1);
}

// The nearest points p + d s and q + e t of two segments.
template <class Real>
struct NearestOfSegments {
  Vector3<Real> d, e;
  Real dd, ee;  // their squares
  Real s, t;
  Vector3<Real> delta;  // from p + d s to q + e t
};

// r = q - p. The form of the first s keeps the error of the distance at that of the coordinates,
// however nearly parallel the segments are; a c - b^2 would not.
template <class Real>
NearestOfSegments<Real> nearest_of_segments(const Vector3<Real>& r, const Vector3<Real>& d,
                                            const Vector3<Real>& e) {
  using Vector = Vector3<Real>;
  NearestOfSegments<Real> result{d, e, dot(d, d), dot(e, e), 0, 0, {}};
  const Vector n = cross(d, e);
  const Real along_lines = clamped_ratio(dot(cross(r, e), n), dot(n, n));
  result.t = clamped_ratio(dot(e, Vector(d * along_lines - r)), result.ee);
  result.s = clamped_ratio(dot(d, Vector(r + e * result.t)), result.dd);
  result.delta = (r + e * result.t) - d * result.s;
  return result;
}

// Whether n = d x e is more than rounding. `dd`, `ee`: squared lengths of d and e.
template <class Real>
bool have_common_normal(const Vector3<Real>& n, Real dd, Real ee) {
  using Tolerance = CoreTolerance<Real>;
  return dot(n, n) > max(Tolerance::kParallel * (dd * ee), Tolerance::kVanishing);
}

template <class Real>
struct WayBetween {
  Vector3<Real> way;  // not a unit vector
  bool is_across;     // perpendicular to both segments; the sign is arbitrary
};

// Recomputes the direction of `delta` from the nearest features: perpendicular to both segments if
// both points are inside them, perpendicular to one if only that point is.
template <class Real>
WayBetween<Real> way_between(const NearestOfSegments<Real>& near) {
  const Vector3<Real> n = cross(near.d, near.e);
  const bool in_d = is_inside(near.s), in_e = is_inside(near.t);
  const bool is_across = in_d && in_e && have_common_normal(n, near.dd, near.ee);
  Vector3<Real> way = is_across ? n : near.delta;
  // Removes what rounding left along the segment. Once perpendicular to d, n is perpendicular to e
  // up to rounding.
  if (in_d) {
    way -= near.d * (dot(way, near.d) / near.dd);
  } else if (in_e) {
    way -= near.e * (dot(way, near.e) / near.ee);
  }
  return {way, is_across};
}

// Some unit vector perpendicular to d; +x if d is zero.
template <class Real>
Vector3<Real> any_perpendicular(const Vector3<Real>& d) {
  const Real x = std::fabs(d.x()), y = std::fabs(d.y()), z = std::fabs(d.z());
  Vector3<Real> v;
  if (x <= y && x <= z) {
    v = {0, -d.z(), d.y()};  // x cross d
  } else if (y <= z) {
    v = {d.z(), 0, -d.x()};
  } else {
    v = {-d.y(), d.x(), 0};
  }
  const Real squared = dot(v, v);
  return squared > 0 ? Vector3<Real>(v * (1 / std::sqrt(squared))) : Vector3<Real>(1, 0, 0);
}

}  // namespace carom::scalar

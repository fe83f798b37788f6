// Exact answers for spheres and boxes: every float is taken as the exact number, and arithmetic has
// 100 decimal digits. Slow; it shares no code with the library.
#pragma once

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "tests/support/pairs.h"

namespace carom::test {

using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>,
                                           boost::multiprecision::et_off>;
using Real3 = std::array<Real, 3>;

inline Real dot(const Real3& a, const Real3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Real norm(const Real3& a) { return sqrt(dot(a, a)); }

template <class Vector>
Real3 exact(const Vector& v) {
  return {Real(v[0]), Real(v[1]), Real(v[2])};
}

// A sphere or a box, as a box grown by a radius.
struct ExactShape {
  Real3 lower{};
  Real3 upper{};
  Real radius = 0;

  explicit ExactShape(const Shape& shape) {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) {
      radius = sphere->radius;
    } else {
      lower = exact(std::get<Aabb>(shape).lower);
      upper = exact(std::get<Aabb>(shape).upper);
    }
  }

  // The largest n . x over the shape; n is a unit vector.
  Real support(const Real3& n) const {
    Real sum = radius;
    for (int i = 0; i < 3; ++i) sum += std::max<Real>(lower[i] * n[i], upper[i] * n[i]);
    return sum;
  }

  Real bounding_radius() const {
    Real3 corner;
    for (int i = 0; i < 3; ++i) corner[i] = std::max<Real>(abs(lower[i]), abs(upper[i]));
    return norm(corner) + radius;
  }

  // Signed distance of a point from the surface.
  Real distance(const Real3& point) const {
    Real3 outside;
    Real deepest = -1e300;
    for (int i = 0; i < 3; ++i) {
      const Real gap = std::max<Real>(lower[i] - point[i], point[i] - upper[i]);
      outside[i] = std::max<Real>(gap, 0);
      deepest = std::max<Real>(deepest, gap);
    }
    return (deepest > 0 ? norm(outside) : deepest) - radius;
  }
};

struct ExactPair {
  ExactShape a;
  ExactShape b;
  Real3 d;     // position of B relative to A's
  Real scale;  // mean of the bounding radii
  Real separation;

  ExactPair(const TestPair& pair, PositionType positions) : a(pair.a.shape), b(pair.b.shape) {
    const Real3 position_a = exact(stored(pair.a.position, positions));
    const Real3 position_b = exact(stored(pair.b.position, positions));
    for (int i = 0; i < 3; ++i) d[i] = position_b[i] - position_a[i];
    scale = (a.bounding_radius() + b.bounding_radius()) / 2;
    separation = exact_separation();
  }

  // The gap between the projections on a direction, a lower bound of the separation.
  Real gap_along(const Real3& normal) const {
    const Real length = norm(normal);
    const Real3 n = {normal[0] / length, normal[1] / length, normal[2] / length};
    return dot(d, n) - a.support(n) - b.support({-n[0], -n[1], -n[2]});
  }

 private:
  // The origin's signed distance from the box of all (point of B) - (point of A), minus the radii.
  Real exact_separation() const {
    ExactShape difference{Shape{Sphere{}}};
    for (int i = 0; i < 3; ++i) {
      difference.lower[i] = d[i] + b.lower[i] - a.upper[i];
      difference.upper[i] = d[i] + b.upper[i] - a.lower[i];
    }
    difference.radius = a.radius + b.radius;
    return difference.distance({});
  }
};

}  // namespace carom::test

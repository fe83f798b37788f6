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

Real dot(const Real3& a, const Real3& b);
Real norm(const Real3& a);

template <class Vector>
Real3 exact(const Vector& v) {
  return {Real(v[0]), Real(v[1]), Real(v[2])};
}

// A sphere or a box, as a box grown by a radius.
struct ExactShape {
  Real3 lower{};
  Real3 upper{};
  Real radius = 0;

  explicit ExactShape(const Shape& shape);

  // The largest n . x over the shape; n is a unit vector.
  Real support(const Real3& n) const;

  Real bounding_radius() const;

  // Signed distance of a point from the surface.
  Real distance(const Real3& point) const;
};

struct ExactPair {
  ExactShape a;
  ExactShape b;
  Real3 d;     // position of B relative to A's
  Real scale;  // mean of the bounding radii
  Real separation;

  ExactPair(const TestPair& pair, PositionType positions);

  // The gap between the projections on a direction, a lower bound of the separation.
  Real gap_along(const Real3& normal) const;

 private:
  // The origin's signed distance from the box of all (point of B) - (point of A), minus the radii.
  Real exact_separation() const;
};

}  // namespace carom::test

// The point of a simplex that is nearest to the origin, in any number type and without division.
// With exact numbers it is exact.
//
// Source of the regions: C. Ericson, Real-Time Collision Detection (2005), 5.1.5 and 5.1.6.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/dyadic.h"
#include "base/few_of.h"
#include "narrowphase/scalar/vector_of.h"

namespace carom {

inline int sign_of(double x) { return (x > 0) - (x < 0); }
inline double approximately(double x) { return x; }
inline double magnitude(double x) { return std::fabs(x); }

template <class Number>
struct NearestOfSimplex {
  using Vector = VectorOf<Number>;

  // The points that span the nearest one, as indices into the given simplex.
  FewOf<uint8_t, 4> carriers;
  // The direction of the nearest point from the origin, of any length.
  Vector way{};
  // The squared distance, as a quotient.
  Number numerator{0.0}, denominator{1.0};

  bool is_origin() const { return sign_of(numerator) == 0; }

  bool is_nearer_than(const NearestOfSimplex& other) const {
    return sign_of(numerator * other.denominator - other.numerator * denominator) < 0;
  }
};

// The nearest point of one to four points that are affinely independent.
template <class Number>
class SimplexSearch {
 public:
  using Vector = VectorOf<Number>;
  using Nearest = NearestOfSimplex<Number>;
  using Points = FewOf<Vector, 4>;

  static Nearest nearest(const Points& y) {
    switch (y.size()) {
      case 1:
        return of_point(y, 0);
      case 2:
        return of_segment(y, 0, 1);
      case 3:
        return of_triangle(y, 0, 1, 2);
      default:
        return of_tetrahedron(y);
    }
  }

 private:
  static Nearest of_point(const Points& y, uint8_t i) {
    Nearest point;
    point.carriers = {i};
    point.way = y[i];
    point.numerator = dot(y[i], y[i]);
    return point;
  }

  // The nearest point lies between the ends.
  static Nearest of_line(const Points& y, uint8_t i, uint8_t j) {
    const Vector along = y[j] - y[i];
    const Vector moment = cross(y[i], along);
    Nearest line;
    line.carriers = {i, j};
    line.way = cross(along, moment);
    line.numerator = dot(moment, moment);
    line.denominator = dot(along, along);
    return line;
  }

  static Nearest of_segment(const Points& y, uint8_t i, uint8_t j) {
    const Vector along = y[j] - y[i];
    if (sign_of(dot(along, y[i])) >= 0) return of_point(y, i);
    if (sign_of(dot(along, y[j])) <= 0) return of_point(y, j);
    return of_line(y, i, j);
  }

  static Nearest of_plane(const Points& y, uint8_t i, uint8_t j, uint8_t k, const Vector& normal) {
    const Number height = dot(normal, y[i]);
    Nearest plane;
    plane.carriers = {i, j, k};
    plane.way = sign_of(height) < 0 ? -normal : normal;
    plane.numerator = height * height;
    plane.denominator = dot(normal, normal);
    return plane;
  }

  static Nearest of_triangle(const Points& y, uint8_t i, uint8_t j, uint8_t k) {
    const Vector &a = y[i], &b = y[j], &c = y[k];
    const Vector ab = b - a, ac = c - a;
    const Number ab_a = -dot(ab, a), ac_a = -dot(ac, a);
    if (sign_of(ab_a) <= 0 && sign_of(ac_a) <= 0) return of_point(y, i);
    const Number ab_b = -dot(ab, b), ac_b = -dot(ac, b);
    if (sign_of(ab_b) >= 0 && sign_of(ac_b - ab_b) <= 0) return of_point(y, j);
    const Number ab_c = -dot(ab, c), ac_c = -dot(ac, c);
    if (sign_of(ac_c) >= 0 && sign_of(ab_c - ac_c) <= 0) return of_point(y, k);

    const Number beyond_ab = ab_a * ac_b - ab_b * ac_a;
    if (sign_of(beyond_ab) <= 0 && sign_of(ab_a) >= 0 && sign_of(ab_b) <= 0) {
      return of_line(y, i, j);
    }
    const Number beyond_ac = ab_c * ac_a - ab_a * ac_c;
    if (sign_of(beyond_ac) <= 0 && sign_of(ac_a) >= 0 && sign_of(ac_c) <= 0) {
      return of_line(y, i, k);
    }
    const Number beyond_bc = ab_b * ac_c - ab_c * ac_b;
    const bool between_b_and_c = sign_of(ac_b - ab_b) >= 0 && sign_of(ab_c - ac_c) >= 0;
    if (sign_of(beyond_bc) <= 0 && between_b_and_c) return of_line(y, j, k);
    return of_plane(y, i, j, k, cross(ab, ac));
  }

  // The nearest of the faces that separate the origin from the fourth point; the origin if there is
  // none.
  static Nearest of_tetrahedron(const Points& y) {
    static constexpr std::array<std::array<uint8_t, 4>, 4> kFaces = {
        {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}}};
    Nearest best;
    for (const auto& [i, j, k, apex] : kFaces) {
      const Vector normal = cross(y[j] - y[i], y[k] - y[i]);
      const int side_of_origin = -sign_of(dot(normal, y[i]));
      const int side_of_apex = sign_of(dot(normal, y[apex] - y[i]));
      if (side_of_origin * side_of_apex >= 0) continue;
      const Nearest face = of_triangle(y, i, j, k);
      if (best.carriers.empty() || face.is_nearer_than(best)) best = face;
    }
    if (best.carriers.empty()) best.carriers = {0, 1, 2, 3};
    return best;
  }
};

}  // namespace carom

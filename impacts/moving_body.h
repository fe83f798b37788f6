// Reads single bodies of a view with their sweeps.
#pragma once

#include <algorithm>
#include <cmath>

#include "impacts/first_time.h"
#include "impacts/simple_times.h"
#include "narrowphase/batch/stated_body.h"
#include "shapes/body_reader.h"

namespace carom {

struct MovingReader {
  const MovingSide& side;

  BodyReader body() const { return {side.bodies}; }

  Position<float> displacement(size_t i) const {
    return load_strided<Position<float>>(side.sweep.displacement, side.sweep.displacement_stride,
                                         i);
  }
  Position<float> rotation(size_t i) const {
    return load_strided<Position<float>>(side.sweep.rotation, side.sweep.rotation_stride, i);
  }
  // Whether its rotation vector is not zero; NaN is not.
  bool turns(size_t i) const {
    if (!side.sweep.rotation) return false;
    const Position<float> w = rotation(i);
    return !(w.x == 0 && w.y == 0 && w.z == 0);
  }
  Double3 arm(size_t i) const { return side.arm ? side.arm[i] : Double3{}; }

  bool is_valid(size_t i) const { return body().is_valid(i) && has_valid_motion(i); }
  bool has_valid_motion(size_t i) const {
    return is_finite(body().position<double>(i)) && is_finite(displacement(i)) &&
           is_finite(rotation(i));
  }
  // A NaN rotation counts as turning if the orientation of the kind matters.
  bool moves_in_a_line(size_t i) const {
    if (!turns(i)) return true;
    return !scalar::turns(body().kind(i)) && arm(i) == Double3{};
  }
  Eigen::Vector3d rotation_vector(size_t i) const {
    const Position<float> w = rotation(i);
    return {w.x, w.y, w.z};
  }
  scalar::Quaternion<double> orientation(size_t i) const {
    const Row q = body().orientation(i);
    return {{q[0], q[1], q[2]}, q[3]};
  }
  scalar::MovingShape moving(const Shape& shape, size_t i) const {
    const Double3 from = arm(i);
    return {shape, orientation(i), {from[0], from[1], from[2]}, rotation_vector(i)};
  }
};

// Components of the distance between bodies are clamped to this. Bodies of finite size and sweep
// that are further apart cannot meet, and the squares of larger distances would overflow.
inline constexpr double kFurthestApart = 1e40;

inline double apart(double from, double to) {
  return std::clamp(to - from, -kFurthestApart, kFurthestApart);
}

inline Double3 place_between(const MovingReader& a, const MovingReader& b, Pair pair) {
  const auto at_a = a.body().position<double>(pair.a), at_b = b.body().position<double>(pair.b);
  return {apart(at_a.x, at_b.x), apart(at_a.y, at_b.y), apart(at_a.z, at_b.z)};
}

inline Double3 way_between(const MovingReader& a, const MovingReader& b, Pair pair) {
  const Position<float> of_a = a.displacement(pair.a), of_b = b.displacement(pair.b);
  return {double{of_b.x} - double{of_a.x}, double{of_b.y} - double{of_a.y},
          double{of_b.z} - double{of_a.z}};
}

inline Eigen::Vector3d eigen(const Double3& v) { return {v[0], v[1], v[2]}; }

}  // namespace carom

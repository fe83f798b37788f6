// The input of kinds_fuzz: the number of a pair of kinds, flags, two bodies, then the input of
// take_hull() for A and for B.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "carom/shapes/views.h"
#include "fuzz/random_shape.h"
#include "narrowphase/pairs/pair_kinds.h"

namespace carom::fuzz {

struct KindPair {
  ShapeKind a, b;
};

// Every pair of kinds that has a kernel.
inline constexpr auto kPairs = [] {
  std::array<KindPair, kPairKinds.size()> pairs{};
  for (size_t i = 0; i < pairs.size(); ++i) pairs[i] = {kPairKinds[i].a, kPairKinds[i].b};
  return pairs;
}();

enum Flag : uint8_t { kExchanged = 1, kFloat64 = 2 };

// Spheres: the first number of the rows is the radius. Aabbs: the first two rows are the corners.
// The rows of hulls are ignored.
struct Body {
  std::array<std::array<float, 4>, kMostRows> rows;
  std::array<float, 4> orientation;
  std::array<double, 3> position;
};

// The first byte selects what follows. Below kRandomHull: one to sixteen points. Otherwise: the
// style, size and seed of a random hull of up to 64 points.
inline constexpr uint8_t kRandomHull = 128;
inline constexpr size_t kMostPoints = 16;

inline Hull take_points(size_t count, Data& data) {
  std::vector<Eigen::Vector3f> points(count, Eigen::Vector3f::Zero());
  for (Eigen::Vector3f& point : points) {
    for (float& x : point) {
      const auto any = take<float>(data);
      if (std::isfinite(any)) x = any;
    }
  }
  return oracle::hull_of(points);
}

inline Hull take_hull(Data& data) {
  const auto form = take<uint8_t>(data);
  if (form < kRandomHull) return take_points(form % kMostPoints + 1, data);
  const double size = std::pow(10.0, take<uint8_t>(data) % 84 - 45);
  return std::get<Hull>(take_random_shape(ShapeKind::hull, form, size, data));
}

}  // namespace carom::fuzz

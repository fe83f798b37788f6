// What kinds_fuzz reads: the number of a pair of kinds, flags, two bodies, then what take_hull()
// reads for A and for B.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "carom/kernel/views.h"
#include "oracle/convex_random.h"

namespace carom::fuzz {

struct KindPair {
  const char* name;
  ShapeKind a, b;
};

// Every pair of kinds that has a kernel.
inline constexpr KindPair kPairs[] = {
#define CAROM_PAIR(name, a, b, passes) {#name, ShapeKind::a, ShapeKind::b},
#include "narrowphase/pair_list.inc"
#undef CAROM_PAIR
};

enum Flag : uint8_t { kExchanged = 1, kFloat64 = 2 };

// Spheres: the radius is the first number of the rows; aabbs: the first two rows are the corners.
// The rows of hulls are not read.
struct Body {
  std::array<std::array<float, 4>, kMostRows> rows;
  std::array<float, 4> orientation;
  std::array<double, 3> position;
};

// From the front of the data; what is missing is zero.
template <class T>
T take(std::span<const uint8_t>& data) {
  T value{};
  const size_t size = std::min(data.size(), sizeof value);
  std::memcpy(&value, data.data(), size);
  data = data.subspan(size);
  return value;
}

// The first byte says what follows: below kRandomHull the points themselves, one to sixteen of
// them; otherwise the style, the size and the seed of a random hull of up to 64.
inline constexpr uint8_t kRandomHull = 128;
inline constexpr size_t kMostPoints = 16;

inline Hull take_points(size_t count, std::span<const uint8_t>& data) {
  std::vector<Eigen::Vector3f> points(count, Eigen::Vector3f::Zero());
  for (Eigen::Vector3f& point : points) {
    for (float& x : point) {
      const auto any = take<float>(data);
      if (std::isfinite(any)) x = any;
    }
  }
  return oracle::hull_of(points);
}

inline Hull take_hull(std::span<const uint8_t>& data) {
  const auto form = take<uint8_t>(data);
  if (form < kRandomHull) return take_points(form % kMostPoints + 1, data);
  const auto power = take<uint8_t>(data);
  oracle::Random random(take<uint64_t>(data));
  oracle::ConvexRandom shapes({.aspect = std::pow(10.0, form >> 4 & 7),
                               .degenerate = (form & 1) != 0,
                               .lattice = (form & 2) != 0,
                               .aligned = (form & 4) != 0},
                              random);
  return std::get<Hull>(shapes.shape(ShapeKind::hull, std::pow(10.0, power % 84 - 45)));
}

}  // namespace carom::fuzz

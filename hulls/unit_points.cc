#include "hulls/unit_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace carom::hulls {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

bool is_before(const Vector3f& p, const Vector3f& q) {
  return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
}

// The first index of every distinct point, ascending.
std::vector<uint32_t> distinct(std::span<const Vector3f> points) {
  std::vector<uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t i, uint32_t j) { return is_before(points[i], points[j]); });
  const auto is_same = [&](uint32_t i, uint32_t j) { return points[i] == points[j]; };
  order.erase(std::unique(order.begin(), order.end(), is_same), order.end());
  std::sort(order.begin(), order.end());
  return order;
}

}  // namespace

Vector3d UnitPoints::unscaled(const Vector3d& p) const {
  Vector3d place;
  for (int axis = 0; axis < 3; ++axis) {
    place[axis] = lower[axis] + std::ldexp(p[axis] + half[axis], exponent[axis]);
  }
  return place;
}

UnitPoints unit_points(std::span<const Vector3f> points) {
  Vector3d lower = points.front().cast<double>();
  Vector3d upper = lower;
  for (const Vector3f& p : points) {
    lower = lower.cwiseMin(p.cast<double>());
    upper = upper.cwiseMax(p.cast<double>());
  }
  UnitPoints unit;
  for (int axis = 0; axis < 3; ++axis) {
    std::frexp(upper[axis] - lower[axis], &unit.exponent[axis]);
    const double largest = std::max(-lower[axis], upper[axis]);
    const double half_step = std::max(largest * double{std::numeric_limits<float>::epsilon()} / 2,
                                      double{std::numeric_limits<float>::denorm_min()});
    unit.rounding[axis] = std::ldexp(half_step, -unit.exponent[axis]);
  }
  unit.lower = lower;
  for (int axis = 0; axis < 3; ++axis) {
    unit.half[axis] = std::ldexp(upper[axis] - lower[axis], -unit.exponent[axis]) / 2;
  }
  unit.source = distinct(points);
  unit.point.reserve(unit.source.size());
  for (const uint32_t source : unit.source) {
    const Vector3d above = points[source].cast<double>() - lower;
    Vector3d p;
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = std::ldexp(above[axis], -unit.exponent[axis]) - unit.half[axis];
    }
    unit.point.push_back(p);
  }
  return unit;
}

}  // namespace carom::hulls

// Pairs as rows for lanes of doubles.
#pragma once

#include <memory>

#include "narrowphase/doubles/core_rows.h"
#include "narrowphase/doubles/core_separation.h"
#include "narrowphase/scalar/scaled.h"

namespace carom {

// Rows with the points of the first cores that are no hulls.
struct CoreRowsWithPoints : CoreRows {
  std::array<std::array<std::array<float, 4>, 8>, kMost> own_points;
};

inline CoreRowsWithPoints& core_rows_of_thread() {
  thread_local const auto rows = std::make_unique<CoreRowsWithPoints>();
  return *rows;
}

// A core before it is turned: its points, their middle, and its radius, in metres.
struct StatedCore {
  const float* points;
  size_t count;
  Eigen::Vector3d middle;
  double radius = 0;
};

using OwnPoints = std::array<std::array<float, 4>, 8>;

inline void put_point(const Eigen::Vector3d& p, std::array<float, 4>& out) {
  out = {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), 0};
}

inline StatedCore stated_core(const scalar::SphereShape<double>& sphere, OwnPoints& own) {
  own[0] = {0, 0, 0, 0};
  return {own[0].data(), 1, Eigen::Vector3d::Zero(), sphere.radius};
}
inline StatedCore stated_core(const scalar::CapsuleShape<double>& capsule, OwnPoints& own) {
  put_point(capsule.a, own[0]);
  put_point(capsule.b, own[1]);
  return {own[0].data(), 2, (capsule.a + capsule.b) / 2, capsule.radius};
}
inline StatedCore stated_box(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper,
                             OwnPoints& own) {
  for (size_t i = 0; i < 8; ++i) {  // bit k of i: at the upper end of axis k
    put_point(
        {(i & 1 ? upper : lower).x(), (i & 2 ? upper : lower).y(), (i & 4 ? upper : lower).z()},
        own[i]);
  }
  return {own[0].data(), 8, (lower + upper) / 2};
}
inline StatedCore stated_core(const scalar::AabbShape<double>& box, OwnPoints& own) {
  return stated_box(box.lower, box.upper, own);
}
inline StatedCore stated_core(const scalar::BoxShape<double>& box, OwnPoints& own) {
  return stated_box(-box.half, box.half, own);
}
inline StatedCore stated_core(const scalar::HullShape<double>& hull, OwnPoints&) {
  const HullGeometry& geometry = *hull.geometry;
  return {geometry.records()[0].data(), geometry.points().size(), geometry.middle()};
}

// Adds a row unless lanes of doubles do not take it. Shapes, hulls at scale 1, and pose are in
// metres; an aabb has the identity for an orientation.
template <class A>
bool add_core_row(const A& a, const scalar::HullShape<double>& b,
                  const scalar::PairPose<double>& pose, CoreRowsWithPoints& rows) {
  // Products of rotations and lengths vanish at no scale within these.
  constexpr double kMostScale = 0x1p200;
  const auto scale = scalar::scale_of_pair(a, b, pose);
  if (!(scale.up <= kMostScale && scale.down <= kMostScale)) return false;
  const size_t row = rows.count;
  const StatedCore core_a = stated_core(a, rows.own_points[row]);
  const StatedCore core_b = stated_core(b, rows.own_points[row]);
  if (core_a.count > kMostPointsOfDoubles || core_b.count > kMostPointsOfDoubles) return false;
  const auto put = [&](size_t column, const Eigen::Vector3d& v) {
    for (size_t axis = 0; axis < 3; ++axis) {
      rows.column[column + axis][row] = v[static_cast<Eigen::Index>(axis)];
    }
  };
  const auto put_turn = [&](size_t column, const scalar::Quaternion<double>& q) {
    put(column, q.v);
    rows.column[column + 3][row] = q.w;
  };
  put(CoreRows::kOffset, pose.d * scale.down);
  put_turn(CoreRows::kTurnA, pose.a);
  put_turn(CoreRows::kTurnB, pose.b);
  put(CoreRows::kMiddleA, core_a.middle);
  put(CoreRows::kMiddleB, core_b.middle);
  rows.column[CoreRows::kRadius][row] = core_a.radius * scale.down;
  rows.column[CoreRows::kDown][row] = scale.down;
  rows.column[CoreRows::kUp][row] = scale.up;
  rows.points_a[row] = core_a.points;
  rows.points_b[row] = core_b.points;
  rows.count_a[row] = static_cast<uint32_t>(core_a.count);
  rows.count_b[row] = static_cast<uint32_t>(core_b.count);
  ++rows.count;
  return true;
}

}  // namespace carom

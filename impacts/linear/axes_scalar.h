// The first time of impact of two convex polytopes that move in a straight line: the first time at
// which they overlap along every separating axis. This is exact, because these axes are the normals
// of the faces of their difference.
//
// Source: C. Ericson, Real-Time Collision Detection, 2005, section 5.5.1 (separating axes of moving
// polytopes).
#pragma once

#include <array>

#include "impacts/linear/crossing_scalar.h"

namespace carom::scalar {

// The times at which the two overlap along all axes so far.
class AxisTimes {
 public:
  // Along this axis they overlap where |middle + t * rate| <= reach.
  void add(double middle, double rate, double reach) {
    const bool stands = rate == 0;
    const double inverse = stands ? 0 : 1 / rate;
    const double centre = -(middle * inverse);
    const double half = stands ? kNever : reach * std::fabs(inverse);
    is_apart_ = is_apart_ || (stands && std::fabs(middle) > reach);
    entry_ = max(centre - half, entry_);
    exit_ = min(centre + half, exit_);
  }

  double first() const { return first_time(entry_, exit_, !is_apart_ && entry_ <= exit_); }

 private:
  double entry_ = -kNever, exit_ = kNever;
  bool is_apart_ = false;
};

inline double sum_of_magnitudes(const Vector3d& v) {
  return (std::fabs(v.x()) + std::fabs(v.y())) + std::fabs(v.z());
}

// Half the extent of a box along n, in the box's own frame.
inline double reach_of_box(const Vector3d& half, const Vector3d& n) {
  return (half.x() * std::fabs(n.x()) + half.y() * std::fabs(n.y())) + half.z() * std::fabs(n.z());
}

// e_axis cross v. Exact: it only moves components and flips signs.
inline Vector3d axis_cross(int axis, const Vector3d& v) {
  if (axis == 0) return {0, -v.z(), v.y()};
  if (axis == 1) return {v.z(), 0, -v.x()};
  return {-v.y(), v.x(), 0};
}

// Two boxes in the frame of A. The middle of B starts at `at` and moves by `way`; its axes are the
// columns of `turn`. Cross products of nearly parallel axes are short, but the rounding errors of
// the projections are short with them, since both boxes are projected in full.
inline double boxes_meet(const Vector3d& at, const Vector3d& way, const Vector3d& half_a,
                         const Vector3d& half_b, const Rotation<double>& turn, double slack) {
  const std::array<Vector3d, 3> axes_b = {turn.x, turn.y, turn.z};
  AxisTimes times;
  for (int i = 0; i < 3; ++i) {
    const Vector3d seen(axes_b[0][i], axes_b[1][i], axes_b[2][i]);
    times.add(at[i], way[i], (half_a[i] + reach_of_box(half_b, seen)) + slack);
  }
  for (int j = 0; j < 3; ++j) {
    const Vector3d& n = axes_b[static_cast<size_t>(j)];
    const double reach = reach_of_box(half_a, n) + half_b[j];
    times.add(dot(at, n), dot(way, n), reach + slack * sum_of_magnitudes(n));
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Vector3d n = axis_cross(i, axes_b[static_cast<size_t>(j)]);
      const int k = (j + 1) % 3, l = (j + 2) % 3;
      const double across = half_b[k] * std::fabs(dot(n, axes_b[static_cast<size_t>(k)])) +
                            half_b[l] * std::fabs(dot(n, axes_b[static_cast<size_t>(l)]));
      const double reach = reach_of_box(half_a, n) + across;
      times.add(dot(at, n), dot(way, n), reach + slack * sum_of_magnitudes(n));
    }
  }
  return times.first();
}

// A box about zero, and a triangle that moves by `way`.
inline double box_meets_triangle(const std::array<Vector3d, 3>& corners, const Vector3d& way,
                                 const Vector3d& half, double slack) {
  AxisTimes times;
  const auto add = [&](const Vector3d& n) {
    const double p = dot(corners[0], n), q = dot(corners[1], n), r = dot(corners[2], n);
    const double low = min(min(p, q), r), high = max(max(p, q), r);
    const double reach = reach_of_box(half, n) + (high - low) * 0.5;
    times.add((high + low) * 0.5, dot(way, n), reach + slack * sum_of_magnitudes(n));
  };
  add(Vector3d::UnitX());
  add(Vector3d::UnitY());
  add(Vector3d::UnitZ());
  const std::array<Vector3d, 3> edges = {corners[1] - corners[0], corners[2] - corners[1],
                                         corners[0] - corners[2]};
  add(cross(edges[0], edges[1]));
  for (const Vector3d& edge : edges) {
    for (int i = 0; i < 3; ++i) add(axis_cross(i, edge));
  }
  return times.first();
}

// The time at which a body meets the plane of a half-space. Its lowest point starts at `height`.
inline double meets_plane(double height, double rate, double slack) {
  if (height <= slack) return 0;
  if (!(rate < 0)) return kNever;
  const double t = (height - slack) / -rate;
  return t <= 1 ? t : kNever;
}

}  // namespace carom::scalar

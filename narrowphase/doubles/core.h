// A convex shape as the hull of points, grown by a radius: the input of the searches over any two
// convex shapes. Around one or two points may lie ellipsoids or discs: then it is the hull of
// these.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "narrowphase/scalar/vector_of.h"

namespace carom {

using CoreVector = VectorOf<double>;

// Points are stored in columns of doubles, kCoreLanes at a time; the places after the last point
// repeat the first.
inline constexpr size_t kCoreLanes = 8;

// The ellipsoid about a point has these half axes, times the share of the point. An axis of length
// zero makes it flat.
struct CoreRoundness {
  std::array<CoreVector, 3> axis;
  std::array<double, 2> share;
};

class Core {
 public:
  double radius = 0;
  CoreVector middle{0, 0, 0};  // any point inside; the search starts there

  // The caller sets the points afterwards.
  void resize(size_t count) {
    count_ = count;
    padded_ = (count + kCoreLanes - 1) / kCoreLanes * kCoreLanes;
    if (values_.size() < 3 * padded_) values_.resize(3 * padded_);
    is_round_ = false;
  }
  // The core has one or two points.
  void make_round(const CoreRoundness& roundness) {
    roundness_ = roundness;
    is_round_ = true;
  }
  bool is_round() const { return is_round_; }
  const CoreRoundness& roundness() const { return roundness_; }

  // How far the ellipsoid of share 1 reaches along `way`, times the length of `way`.
  double reach(const CoreVector& way) const { return length(along_axes(way)); }
  // The furthest point of point i's ellipsoid.
  CoreVector round_point(size_t i, const CoreVector& way) const {
    const CoreVector along = along_axes(way);
    return round_point(i, along, length(along));
  }
  // How far point i's ellipsoid reaches at most.
  double roundness_of(size_t i) const {
    const auto& [x, y, z] = roundness_.axis;
    const double longest = std::max(std::max(length(x), length(y)), length(z));
    return is_round_ ? longest * roundness_.share[i] : 0;
  }
  // The distance of the furthest point from `middle`, or a little more.
  double reach_from_middle() const {
    double most = 0;
    for (size_t i = 0; i < count_; ++i) {
      most = std::max(most, length(point(i) - middle) + roundness_of(i));
    }
    return most;
  }
  // The support point of a round core.
  CoreVector furthest_round(const CoreVector& way) const {
    const CoreVector along = along_axes(way);
    const double here = length(along);
    const auto height = [&](size_t i) { return dot(way, point(i)) + roundness_.share[i] * here; };
    return round_point(count_ == 2 && height(1) > height(0) ? 1 : 0, along, here);
  }
  void set(size_t i, const CoreVector& p) {
    values_[i] = p.x;
    values_[padded_ + i] = p.y;
    values_[2 * padded_ + i] = p.z;
  }
  void pad() {
    for (size_t i = count_; i < padded_; ++i) set(i, point(0));
  }

  void move(const CoreVector& by) {
    for (size_t i = 0; i < padded_; ++i) set(i, point(i) + by);
    middle = middle + by;
  }

  size_t size() const { return count_; }
  size_t padded_size() const { return padded_; }
  CoreVector point(size_t i) const {
    return {values_[i], values_[padded_ + i], values_[2 * padded_ + i]};
  }
  const double* x() const { return values_.data(); }
  const double* y() const { return values_.data() + padded_; }
  const double* z() const { return values_.data() + 2 * padded_; }
  double* x() { return values_.data(); }
  double* y() { return values_.data() + padded_; }
  double* z() { return values_.data() + 2 * padded_; }

 private:
  static double length(const CoreVector& v) { return std::sqrt(dot(v, v)); }
  CoreVector along_axes(const CoreVector& way) const {
    const auto& [x, y, z] = roundness_.axis;
    return {dot(x, way), dot(y, way), dot(z, way)};
  }

  // `along`: a way along the axes of the ellipsoid; `reach`: its length.
  CoreVector round_point(size_t i, const CoreVector& along, double reach) const {
    if (!(reach > 0)) return point(i);
    const auto& [x, y, z] = roundness_.axis;
    const CoreVector out = x * (along.x / reach) + y * (along.y / reach) + z * (along.z / reach);
    return point(i) + out * roundness_.share[i];
  }

  bool is_round_ = false;
  CoreRoundness roundness_{};
  std::vector<double> values_;  // never shrinks: cores are used again for the next pair
  size_t count_ = 0, padded_ = 0;
};

// The cores of one pair; the memory serves the next pair too.
struct CorePair {
  Core a, b;
};

inline CorePair& core_pair_of_thread() {
  thread_local CorePair pair;
  return pair;
}

// The index of the support point of the core along `way`; the first of equals.
using FurthestPoint = size_t (*)(const Core& core, const CoreVector& way);

// The support point itself; `furthest` finds it among points.
inline CoreVector support_point(const Core& core, const CoreVector& way, FurthestPoint furthest) {
  return core.is_round() ? core.furthest_round(way) : core.point(furthest(core, way));
}

}  // namespace carom

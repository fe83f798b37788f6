// Pairs that move in a straight line, as columns of doubles: the input of the kernels of linear
// times of impact.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "carom/shapes/shape.h"

namespace carom {

// Kinds of bodies by the numbers that they store. An aabb is an unrotated box about its middle.
enum class LinearKind : uint8_t { sphere, capsule, box, triangle, plane, hull, none };

constexpr LinearKind linear_kind(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::sphere:
      return LinearKind::sphere;
    case ShapeKind::capsule:
      return LinearKind::capsule;
    case ShapeKind::aabb:
    case ShapeKind::box:
      return LinearKind::box;
    case ShapeKind::triangle:
      return LinearKind::triangle;
    case ShapeKind::halfspace:
      return LinearKind::plane;
    case ShapeKind::hull:
      return LinearKind::hull;
    default:
      return LinearKind::none;
  }
}

// How many numbers a body has.
//   sphere    radius
//   capsule   a (3), b (3), radius, quaternion (4)
//   box       half extents (3), quaternion (4)
//   triangle  three corners (9), quaternion (4)
//   plane     unit normal in world axes (3); then, of its pair, the height of the other body's
//             position over it, the rate of that, and the magnitude of the offset
//   hull      middle (3), size, quaternion (4); its geometry is apart
constexpr size_t number_count(LinearKind kind) {
  constexpr std::array<size_t, 7> kCount = {1, 11, 7, 13, 6, 8, 0};
  return kCount[static_cast<size_t>(kind)];
}

class LinearRows {
 public:
  static constexpr size_t kMost = 256;  // rows; a multiple of all vectors
  // Distance between columns, in numbers. A power of two would put a whole row into a few sets of
  // the cache (capsules: 100 instead of 59 ns per pair).
  static constexpr size_t kStride = kMost + 8;
  static constexpr size_t kPairColumns = 6;      // from (3), way (3)
  static constexpr size_t kRotationColumns = 6;  // of two hulls
  static constexpr size_t kMostColumns = kPairColumns + 11 + 13;

  double* column(size_t c) { return values_.data() + c * kStride; }
  const double* column(size_t c) const { return values_.data() + c * kStride; }

  void clear(size_t first, size_t columns, size_t count) {
    for (size_t c = first; c < first + columns; ++c) std::fill_n(column(c), count, 0.0);
  }

  // Fills the last vector with copies of the last row.
  void pad(size_t columns, size_t count) {
    const size_t padded = (count + 7) / 8 * 8;
    for (size_t c = 0; c < columns; ++c) {
      std::fill(column(c) + count, column(c) + padded, column(c)[count - 1]);
    }
  }
  void pad_hulls(size_t count) {
    const size_t padded = (count + 7) / 8 * 8;
    for (auto* hulls : {&hull_a_, &hull_b_}) {
      std::fill(hulls->begin() + count, hulls->begin() + padded, (*hulls)[count - 1]);
    }
  }

  // The geometries of rows of hulls; nullptr: it has none, and is not valid.
  const HullGeometry** hull_a() { return hull_a_.data(); }
  const HullGeometry** hull_b() { return hull_b_.data(); }

  double* times() { return times_.data(); }
  const double* times() const { return times_.data(); }

 private:
  alignas(64) std::array<double, kMostColumns * kStride> values_;
  alignas(64) std::array<double, kMost> times_;
  std::array<const HullGeometry*, kMost> hull_a_, hull_b_;
};

// Writes the times of `count` rows. It may write on up to a multiple of eight rows, whose columns
// must hold numbers.
using LinearKernel = void (*)(LinearRows& rows, size_t count);

// The kernels by method, for the ISA in use; nullptr: the method does not serve these kinds.
LinearKernel rounded_kernel(LinearKind a, LinearKind b);
LinearKernel box_kernel(LinearKind a, LinearKind b);
LinearKernel plane_kernel(LinearKind a);
LinearKernel hull_kernel();  // of two hulls
// The kernel for two hulls that may rotate: after their columns come the rotations over the
// interval (3 each).
LinearKernel turning_hull_kernel();

// The kernel for A and B in this order; nullptr: there is none.
inline LinearKernel linear_kernel(LinearKind a, LinearKind b) {
  if (b == LinearKind::plane) return plane_kernel(a);
  if (b == LinearKind::hull) return a == b ? hull_kernel() : nullptr;
  const LinearKernel rounded = rounded_kernel(a, b);
  return rounded ? rounded : box_kernel(a, b);
}

}  // namespace carom

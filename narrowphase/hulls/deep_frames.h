// The frames of pairs whose depths are searched together, in scaled units, a column a number.
#pragma once

#include <array>
#include <cstddef>

#include "narrowphase/scalar/vector.h"

namespace carom {

// As many pairs as the widest target has lanes.
inline constexpr size_t kMostDeepPairs = 16;

struct DeepFrames {
  using Column = std::array<float, kMostDeepPairs>;
  using Vectors = std::array<Column, 3>;

  size_t count;
  // For set_up(): the position of B relative to A, both orientations, and the middle of each solid
  // in its own frame.
  alignas(64) Vectors d;
  std::array<Column, 4> turn_a, turn_b;
  Vectors middle_a, middle_b;
  // From set_up(): the rotations from A to the world and from B to A, by their columns; the
  // position of B in the frame of A and of A in that of B, and so the middles.
  std::array<Vectors, 3> to_world, b_to_a;
  Vectors b_from_a, a_from_b;
  Vectors middle_a_in_b, middle_b_in_a;
  // For finish(), in the frame of A; from it, in world axes.
  Vectors normal, arm_a;
  Column gap;
  // From finish().
  Vectors arm_b;

  // Number by number: compilers copy whole vectors in other sizes than they write them, and reading
  // waits for that.
  static void get(const Vectors& columns, size_t i, Eigen::Vector3f& v) {
    for (size_t axis = 0; axis < 3; ++axis) v[static_cast<int>(axis)] = columns[axis][i];
  }
  static void get(const std::array<Vectors, 3>& columns, size_t i, scalar::Rotation<float>& r) {
    get(columns[0], i, r.x);
    get(columns[1], i, r.y);
    get(columns[2], i, r.z);
  }
  static Eigen::Vector3f vector(const Vectors& columns, size_t i) {
    return {columns[0][i], columns[1][i], columns[2][i]};
  }
  static void put(const Eigen::Vector3f& v, Vectors& columns, size_t i) {
    for (size_t axis = 0; axis < 3; ++axis) columns[axis][i] = v[static_cast<int>(axis)];
  }
  static void put(const scalar::Quaternion<float>& q, std::array<Column, 4>& columns, size_t i) {
    for (size_t axis = 0; axis < 3; ++axis) columns[axis][i] = q.v[static_cast<int>(axis)];
    columns[3][i] = q.w;
  }
  static void put(const scalar::Rotation<float>& r, std::array<Vectors, 3>& columns, size_t i) {
    put(r.x, columns[0], i);
    put(r.y, columns[1], i);
    put(r.z, columns[2], i);
  }
};

}  // namespace carom

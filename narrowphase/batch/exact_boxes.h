// Reads the two boxes of a row for tests in double precision. B is turned.
#pragma once

#include <algorithm>
#include <array>

#include "narrowphase/batch/single_pair.h"
#include "narrowphase/scalar/scaled.h"

namespace carom {

// In scaled units. The numbers are in this order, so that rows become columns of lanes.
struct ExactBoxes {
  std::array<double, 3> d;  // of B's centre from A's position, or from the centre of an upright A
  std::array<double, 3> half_a, half_b;
  std::array<double, 4> turn_a, turn_b;  // quaternions
  std::array<double, 3> centre_a;        // from A's position
};
inline constexpr size_t kExactBoxNumbers = sizeof(ExactBoxes) / sizeof(double);

class ExactBoxReader {
 public:
  ExactBoxReader(const Batch& batch, ShapeKind kind_a)
      : pairs_(batch.pairs),
        is_upright_(kind_a == ShapeKind::aabb),
        view_a_(view_of(batch.a, batch.layout, kind_a)),
        view_b_(view_of(batch.b, batch.layout, ShapeKind::box)) {}

  // Returns the metres in a unit.
  double read(size_t row, ExactBoxes& boxes) const {
    const Pair pair = pairs_[row];
    const Position<double> a = a_.position<double>(pair.a), b = b_.position<double>(pair.b);
    boxes.d = {b.x - a.x, b.y - a.y, b.z - a.z};
    boxes.half_b = half_of(b_, pair.b);
    boxes.turn_b = quaternion_of(b_, pair.b);
    return is_upright_ ? read_upright(pair.a, boxes) : read_turned(pair.a, boxes);
  }

 private:
  using Numbers = std::array<double, 3>;

  double read_turned(size_t a, ExactBoxes& boxes) const {
    boxes.half_a = half_of(a_, a);
    boxes.turn_a = quaternion_of(a_, a);
    boxes.centre_a = {};
    const scalar::DoubleScale scale = scalar::scale_of(
        std::max({largest(boxes.d), largest(boxes.half_a), largest(boxes.half_b)}));
    for (Numbers* each : {&boxes.d, &boxes.half_a, &boxes.half_b}) multiply(*each, scale.down);
    return scale.up;
  }

  // As placed_boxes() of an upright box does.
  double read_upright(size_t a, ExactBoxes& boxes) const {
    Numbers lower, upper;
    for (size_t k = 0; k < 3; ++k) lower[k] = a_.lower(k, a), upper[k] = a_.upper(k, a);
    const scalar::DoubleScale scale = scalar::scale_of(
        std::max({largest(boxes.d), largest(lower), largest(upper), largest(boxes.half_b)}));
    for (Numbers* each : {&boxes.d, &lower, &upper, &boxes.half_b}) multiply(*each, scale.down);
    for (size_t k = 0; k < 3; ++k) {
      boxes.half_a[k] = (upper[k] - lower[k]) * 0.5;
      boxes.centre_a[k] = (lower[k] + upper[k]) * 0.5;
      boxes.d[k] = ((boxes.d[k] - lower[k]) + (boxes.d[k] - upper[k])) * 0.5;
    }
    boxes.turn_a = {0, 0, 0, 1};
    return scale.up;
  }

  static Numbers half_of(const BodyReader& body, size_t index) {
    const Row half = body.row(index, 0);
    return {half[0], half[1], half[2]};
  }
  static std::array<double, 4> quaternion_of(const BodyReader& body, size_t index) {
    const scalar::Quaternion<double> q = orientation_of(body, index);
    return {q.v.x(), q.v.y(), q.v.z(), q.w};
  }
  static double largest(const Numbers& v) {
    return std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])});
  }
  static void multiply(Numbers& v, double by) {
    for (double& each : v) each *= by;
  }

  const Pair* pairs_;
  bool is_upright_;
  Collidables view_a_, view_b_;
  BodyReader a_{view_a_}, b_{view_b_};
};

}  // namespace carom

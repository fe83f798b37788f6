// A contender's answers for a set of pairs, in the columns that the library writes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "carom/results/contact.h"

namespace carom::accuracy {

class Answers {
 public:
  explicit Answers(size_t count)
      : overlap(count), status(count), separation(count), manifold_count(count), manifold(count) {
    for (auto* columns : {&normal, &point_a, &point_b}) {
      for (std::vector<float>& column : *columns) column.resize(count);
    }
  }

  ResultColumns columns() {
    ResultColumns out;
    out.overlap = overlap.data();
    out.status = status.data();
    out.separation = separation.data();
    for (size_t axis = 0; axis < 3; ++axis) {
      out.normal[axis] = normal[axis].data();
      out.point_a[axis] = point_a[axis].data();
      out.point_b[axis] = point_b[axis].data();
    }
    out.manifold_count = manifold_count.data();
    out.manifold = manifold.data();
    return out;
  }

  using Column3 = std::array<std::vector<float>, 3>;
  static Eigen::Vector3f row(const Column3& column, size_t i) {
    return {column[0][i], column[1][i], column[2][i]};
  }
  static void set_row(Column3& column, size_t i, const Eigen::Vector3f& value) {
    for (size_t axis = 0; axis < 3; ++axis) column[axis][i] = value[static_cast<int>(axis)];
  }

  std::vector<uint8_t> overlap;
  std::vector<uint8_t> status;
  std::vector<float> separation;
  Column3 normal;
  Column3 point_a;  // relative to the position of A; point_b: of B
  Column3 point_b;
  std::vector<uint8_t> manifold_count;
  std::vector<ManifoldPoints> manifold;
};

}  // namespace carom::accuracy

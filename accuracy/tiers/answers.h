// A contender's answers for a set of pairs, in the columns that the library writes. All are zero at
// first; points are relative to the positions of the bodies.
#pragma once

#include <Eigen/Core>
#include <array>

#include "carom/results/result_arrays.h"

namespace carom::accuracy {

class Answers : public ResultColumns {
 public:
  explicit Answers(size_t count) : arrays_(count, Detail::manifold) {
    static_cast<ResultColumns&>(*this) = arrays_.columns();
  }

  using Column3 = std::array<float*, 3>;
  static Eigen::Vector3f row(const Column3& column, size_t i) {
    return {column[0][i], column[1][i], column[2][i]};
  }
  static void set_row(const Column3& column, size_t i, const Eigen::Vector3f& value) {
    for (size_t axis = 0; axis < 3; ++axis) column[axis][i] = value[static_cast<int>(axis)];
  }

 private:
  ResultArrays arrays_;
};

}  // namespace carom::accuracy

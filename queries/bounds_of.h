// World bounds of bodies, and the memory of them.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "carom/bounds/bounds.h"

namespace carom {

class BoundsOf {
 public:
  BoundsOf() = default;
  BoundsOf(const Collidables& bodies, Parallelism parallelism) { find(bodies, parallelism); }

  void find(const Collidables& bodies, Parallelism parallelism) {
    for (std::vector<float>& column : columns_) column.resize(bodies.count);
    const auto column = [this](size_t i) { return columns_[i].data(); };
    (void)compute_bounds(bodies,
                         {{column(0), column(1), column(2)}, {column(3), column(4), column(5)}},
                         parallelism);
  }

  BoundsView view() const {
    const auto column = [this](size_t i) { return columns_[i].data(); };
    return {
        {column(0), column(1), column(2)}, {column(3), column(4), column(5)}, columns_[0].size()};
  }

  // Empties the bounds of body i, so that it takes no part any more.
  void empty(size_t i) {
    for (size_t axis = 0; axis < 3; ++axis) {
      columns_[axis][i] = std::numeric_limits<float>::infinity();
      columns_[3 + axis][i] = -std::numeric_limits<float>::infinity();
    }
  }

 private:
  std::array<std::vector<float>, 6> columns_;
};

}  // namespace carom

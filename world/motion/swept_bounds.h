// Bounds of bodies over the interval ahead of a step.
#pragma once

#include <array>
#include <cstddef>

#include "base/raw_vector.h"
#include "carom/base/parallelism.h"
#include "carom/shapes/views.h"
#include "world/motion/sweeps.h"
#include "world/store/columns.h"

namespace carom {

class SweptBounds {
 public:
  // Computes boxes that hold every body at all times of the interval. `bounds` are the present
  // ones, which a body keeps if it does not move. Empty bounds stay empty.
  void update(const Collidables& bodies, const Sweeps& sweeps, const BoundsView& bounds,
              Parallelism parallelism);

  BoundsView view() const;

  void give_back() {
    for (LargeVector<float>& column : columns_) carom::give_back(column);
  }
  size_t bytes() const;

 private:
  std::array<LargeVector<float>, 6> columns_;  // lower and upper corners, one row a body
};

}  // namespace carom

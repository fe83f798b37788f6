// Bounds with a margin (Verlet lists): a body keeps its fat bounds until its true ones leave them.
#pragma once

#include <array>
#include <cstddef>

#include "base/raw_vector.h"
#include "carom/base/parallelism.h"
#include "carom/shapes/views.h"
#include "world/store/columns.h"

namespace carom {

class FatBounds {
 public:
  // Renews the fat bounds of each body whose true bounds left them, or shrank well below them. New
  // ones are `margin` (finite, above zero) larger on every side. Empty bounds stay empty.
  void update(const BoundsView& bounds, float margin, Parallelism parallelism);

  BoundsView view() const;

  void give_back() {
    for (LargeVector<float>& column : columns_) carom::give_back(column);
  }
  size_t bytes() const;

 private:
  std::array<LargeVector<float>, 6> columns_;  // lower and upper corners, one row a body
};

}  // namespace carom

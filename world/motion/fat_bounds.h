// Bounds with a margin (Verlet lists): a body keeps its fat bounds until its true ones leave them.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "carom/base/parallelism.h"
#include "carom/shapes/views.h"

namespace carom {

class FatBounds {
 public:
  // New fat bounds, `margin` (finite, above zero) larger on every side, for each body whose true
  // bounds left the ones it had, or shrank well below them. Empty bounds stay empty.
  void update(const BoundsView& bounds, float margin, Parallelism parallelism);

  BoundsView view() const;

  size_t bytes() const;

 private:
  std::array<std::vector<float>, 6> columns_;  // lower and upper corners, one row a body
};

}  // namespace carom

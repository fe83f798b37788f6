// Memory for six columns of world bounds.
#pragma once

#include <vector>

#include "carom/bounds/bounds.h"

namespace carom::bench {

class BoundsArrays {
 public:
  explicit BoundsArrays(size_t count) : count_(count), values_(6 * count) {}

  BoundsColumns columns() {
    float* v = values_.data();
    return {{v, v + count_, v + 2 * count_}, {v + 3 * count_, v + 4 * count_, v + 5 * count_}};
  }
  BoundsView view() const {
    const float* v = values_.data();
    return {
        {v, v + count_, v + 2 * count_}, {v + 3 * count_, v + 4 * count_, v + 5 * count_}, count_};
  }

 private:
  size_t count_;
  std::vector<float> values_;
};

}  // namespace carom::bench

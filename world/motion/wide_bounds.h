// Bounds that have grown by the contact distances of their bodies.
#pragma once

#include <array>

#include "base/raw_vector.h"
#include "carom/base/parallelism.h"
#include "carom/shapes/views.h"
#include "world/motion/contact_distances.h"
#include "world/store/columns.h"

namespace carom {

class WideBounds {
 public:
  // Empty bounds stay empty.
  void update(const BoundsView& bounds, const ContactDistances& distances, Parallelism parallelism);
  BoundsView view() const;
  void give_back() {
    for (LargeVector<float>& column : columns_) carom::give_back(column);
  }
  size_t bytes() const;

 private:
  std::array<LargeVector<float>, 6> columns_;
};

}  // namespace carom

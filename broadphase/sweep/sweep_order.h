// The order of a sweep: boxes sorted by their lower corner on one axis, kept from call to call.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "carom/shapes/views.h"

namespace carom {

// The axis on which the lower corners of a fixed sample vary most; ties go to the first.
size_t axis_of_largest_spread(const BoundsView& bounds);

// Sorts by (lower corner, index). That is a total order, so the result does not depend on the order
// before, on how it was repaired, or on threads.
class SweepOrder {
 public:
  // Writes the indices of all boxes that take part to `order`, sorted along `axis`. `order` must
  // come in as the last call left it; it is repaired if that call was on the same axis.
  void update(const BoundsView& bounds, size_t axis, Parallelism parallelism,
              std::vector<uint32_t>& order);

  // Makes the next update start afresh.
  void forget() { axis_ = kNoAxis; }

  size_t bytes() const;

 private:
  static constexpr size_t kNoAxis = 3;

  bool repair(const BoundsView& bounds, size_t axis, const std::vector<uint32_t>& order);
  void collect(const BoundsView& bounds, size_t axis);

  size_t axis_ = kNoAxis;
  std::vector<uint64_t> items_;  // sortable key << 32 | index
  std::vector<uint64_t> scratch_;
  std::vector<uint32_t> histograms_;
};

}  // namespace carom

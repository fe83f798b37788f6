// The order of a sweep: boxes by their lower corner on one axis, kept from call to call.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "carom/shapes/views.h"

namespace carom {

// The axis on which the lower corners of a fixed sample vary most; ties go to the first.
size_t axis_of_largest_spread(const BoundsView& bounds);

// Sorts by (lower corner, index): a total order, so that the result does not depend on what the
// order was before, on the way it was repaired, or on threads.
class SweepOrder {
 public:
  // Writes the indices of all boxes that take part to `order`, sorted along `axis`. `order` comes
  // in as the last call left it, and is repaired if that was on the same axis.
  void update(const BoundsView& bounds, size_t axis, Parallelism parallelism,
              std::vector<uint32_t>& order);

  // The next update starts afresh.
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

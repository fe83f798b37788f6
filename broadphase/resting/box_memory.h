// The boxes and filters of the last call: which bodies differ in this one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/block_lists.h"
#include "base/parallel.h"
#include "broadphase/box_source.h"
#include "carom/broadphase/find_pairs.h"

namespace carom {

// A copy of everything.
class BoxMemory {
 public:
  // Replaces `changed` by the bodies that differ from the last update, ascending; bodies that were
  // not there count as different. By bits, so that NaN equals itself.
  void update(const BoundsView& bounds, const PairFilter& filter, Parallelism parallelism,
              std::vector<uint32_t>& changed);

  // The next update finds everything different.
  void forget() { count_ = 0; }

  // Number of bodies in the last update.
  size_t count() const { return count_; }

  size_t bytes() const;

 private:
  // Columns of the filter, absent ones empty.
  struct FilterCopy {
    std::vector<uint32_t> layer, mask, owner;
    std::vector<Motion> motion;
  };

  void resize(const BoundsView& bounds, const PairFilter& filter);
  void update_block(const BoxSource& source, const PairFilter& filter, size_t begin, size_t end,
                    std::vector<uint32_t>& changed);

  size_t count_ = 0;
  size_t known_ = 0;  // bodies of the update before
  std::array<std::vector<float>, 6> columns_;
  FilterCopy filter_;
  BlockLists<uint32_t> lists_;
};

// A copy of a few boxes: whether it is worth while to keep one of all.
class BoxSample {
 public:
  // The share of a fixed sample of boxes that differ from those of the last call; 1 for the first.
  double changed_share(const BoundsView& bounds);

  void forget() { count_ = 0; }

 private:
  static constexpr size_t kBoxes = 256;

  std::array<std::array<float, 6>, kBoxes> boxes_{};
  size_t count_ = 0;
};

}  // namespace carom

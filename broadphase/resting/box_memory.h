// Remembers the boxes and filters of the last call, and finds the bodies that differ in this one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/block_lists.h"
#include "base/parallel.h"
#include "broadphase/box_source.h"
#include "carom/broadphase/find_pairs.h"

namespace carom {

// A copy of all boxes and filter columns.
class BoxMemory {
 public:
  // Replaces `changed` by the bodies that differ from the last update, ascending. A body that was
  // not there then counts as different. Compares bits, so that NaN equals itself.
  void update(const BoundsView& bounds, const PairFilter& filter, Parallelism parallelism,
              std::vector<uint32_t>& changed);

  // The same where no bodies but these, ascending, and new ones may differ: takes all of them as
  // different.
  void update_listed(const BoundsView& bounds, const PairFilter& filter,
                     std::span<const uint32_t> listed, std::vector<uint32_t>& changed);

  // The next update finds everything different.
  void forget() { count_ = 0; }

  // Number of bodies in the last update.
  size_t count() const { return count_; }

  size_t bytes() const;

 private:
  // Copies of the filter's columns; absent ones are empty.
  struct FilterCopy {
    std::vector<uint32_t> layer, mask, owner, space;
    std::vector<int32_t> group;
    std::vector<Motion> motion;
    FilterRule rule = FilterRule::both;
  };

  template <class Visit>
  static void for_each_column(const PairFilter& filter, FilterCopy& copy, const Visit& visit);
  void resize(const BoundsView& bounds, const PairFilter& filter);
  void copy(const BoundsView& bounds, const PairFilter& filter, size_t body);
  void update_block(const BoxSource& source, const PairFilter& filter, size_t begin, size_t end,
                    std::vector<uint32_t>& changed);

  size_t count_ = 0;
  size_t known_ = 0;  // bodies in both of the last two updates; 0 if the filter has other columns
  std::array<std::vector<float>, 6> columns_;  // BoxBlock::kPadding more entries than boxes
  FilterCopy filter_;
  BlockLists<uint32_t> lists_;
};

// A copy of a few boxes, which says whether a copy of all is worth while.
class BoxSample {
 public:
  // The share of the sampled boxes that differ from the last call. 1 in the first call, or if the
  // number of boxes has changed.
  double changed_share(const BoundsView& bounds);

  void forget() { count_ = 0; }

 private:
  static constexpr size_t kBoxes = 256;

  std::array<std::array<float, 6>, kBoxes> boxes_{};
  size_t count_ = 0;
};

}  // namespace carom

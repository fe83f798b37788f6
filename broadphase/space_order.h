// Boxes grouped by the space that they are in: those of different spaces never meet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "carom/bounds/bounds.h"

namespace carom {

class SpaceOrder {
 public:
  // Groups the boxes that take part. Returns false, and leaves the groups undefined, if a space
  // holds more than `most` of them.
  bool update(const BoundsView& bounds, const uint32_t* space, size_t most);

  // The boxes, space by space, ascending within each.
  std::span<const uint32_t> boxes() const { return boxes_; }

  size_t spaces() const { return spaces_.size(); }
  // Where the boxes of the i-th space begin; first(spaces()) is where the last ones end.
  size_t first(size_t i) const { return first_[i]; }
  // The boxes of the space with this number.
  std::span<const uint32_t> boxes_of(uint32_t space) const;

  size_t bytes() const;

 private:
  bool sort_keys(uint32_t greatest_space, size_t most);

  std::vector<uint64_t> keys_, sorted_;  // the number of the space above the index of the box
  std::vector<uint32_t> counts_;
  std::vector<uint32_t> boxes_;
  std::vector<uint32_t> spaces_;  // numbers, ascending
  std::vector<uint32_t> first_;   // one a space, and the end
};

}  // namespace carom

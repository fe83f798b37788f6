// The order in which items are packed into the nodes of a tree.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "trees/tree.h"

namespace carom {

// Which items belong to a part of a tree. Without a list, all do.
struct PartOfItem {
  std::span<const uint8_t> parts = {};
  size_t part = 0;

  bool has(size_t item) const { return parts.empty() || parts[item] == part; }
};

// The items of a part whose boxes are not empty, so that neighbours in the list are neighbours in
// space: key << 32 | item. The order is the same for any number of threads.
std::vector<uint64_t> packed_order(std::span<const TreeBox> boxes, const PartOfItem& part,
                                   Parallelism parallelism);

}  // namespace carom

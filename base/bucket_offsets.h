// Counts -> offsets: the middle step of a parallel distribution into buckets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace carom {

// On entry counts[task * buckets + bucket] is the number of items that the task puts into the
// bucket; on return it is the place of the first of them. `begin` gets the place where every bucket
// begins and, as its last entry, the number of all items.
inline void counts_to_offsets(size_t tasks, size_t buckets, std::vector<uint32_t>& counts,
                              std::vector<uint32_t>& begin) {
  begin.resize(buckets + 1);
  uint32_t offset = 0;
  for (size_t bucket = 0; bucket < buckets; ++bucket) {
    begin[bucket] = offset;
    for (size_t task = 0; task < tasks; ++task) {
      offset += std::exchange(counts[task * buckets + bucket], offset);
    }
  }
  begin[buckets] = offset;
}

}  // namespace carom

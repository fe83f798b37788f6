/// @file
/// Results grouped by the space of their bodies.
#pragma once

#include <cstdint>
#include <vector>

namespace carom {

/// Which results of a step belong to which space (BodyDesc::space). The results of spaces[i] have
/// the indices items[first[i]] to items[first[i + 1] - 1].
struct SpaceGroups {
  std::vector<uint32_t> spaces;  ///< the numbers of the spaces that have results, ascending
  std::vector<uint32_t> first;   ///< one a space, and one more: the number of all results
  std::vector<uint32_t> items;   ///< indices of results, ascending within a space
};

}  // namespace carom

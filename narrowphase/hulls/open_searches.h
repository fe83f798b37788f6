// The searches of a batch that are still open when most lanes of their vector have ended. They are
// packed, so that the second stage continues them in full vectors.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "narrowphase/batch/batch.h"
#include "narrowphase/batch/column_memory.h"

namespace carom {

struct OpenSearches {
  // With room for a whole vector after the last search.
  static constexpr size_t kMost = kPairsPerBlock + kMostLanes;
  static constexpr size_t kColumns = 24;

  size_t count = 0;
  std::array<uint32_t, kMost> row;                           // of the batch
  std::array<std::array<uint32_t, kMost>, kColumns> column;  // bits of the search's state
};

}  // namespace carom

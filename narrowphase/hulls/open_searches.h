// Searches of a batch that are still open when most of their vector have ended, packed, so that
// they can go on in full vectors.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "narrowphase/batch/batch.h"
#include "narrowphase/batch/scratch_columns.h"

namespace carom {

struct OpenSearches {
  // Room for whole vectors behind the last.
  static constexpr size_t kMost = kPairsPerBlock + kMostLanes;
  static constexpr size_t kColumns = 24;

  size_t count = 0;
  std::array<uint32_t, kMost> row;                           // of the batch
  std::array<std::array<uint32_t, kMost>, kColumns> column;  // bits of what GJK goes on with
};

}  // namespace carom

// The number of pairs in each measurement.
#pragma once

#include <cstddef>
#include <cstdint>

#include "accuracy/pairs/oracle_pairs.h"

namespace carom::accuracy {

struct Effort {
  size_t stream;    // random pairs, timed and judged
  size_t family;    // of each family and position type
  size_t gap;       // at every distance from touching
  size_t distance;  // at every distance from the origin
  size_t angle;     // at every angle
  size_t scene;     // of each scene with undecided pairs
  int rounds;       // timed passes; times are their medians
};

// About two minutes for all kinds, or half an hour if long. k-DOPs get fewer pairs, because they
// are much slower in the library and in the oracle.
Effort effort_for(const KindPair& kinds, bool is_long);

}  // namespace carom::accuracy

// How many pairs each measurement takes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "accuracy/pairs/oracle_pairs.h"

namespace carom::accuracy {

struct Effort {
  size_t stream;    // random pairs, timed and judged
  size_t family;    // of every family and type of positions
  size_t gap;       // at every distance from touching
  size_t distance;  // at every distance from the origin
  size_t angle;     // at every angle
  size_t scene;     // of every scene of which certified may leave pairs undecided
  int rounds;       // passes that times are medians of
};

// Some two minutes for all kinds, or half an hour. Pairs with k-DOPs take so much longer, in the
// library as in the oracle, that there are fewer of them.
Effort effort_for(const KindPair& kinds, bool is_long);

}  // namespace carom::accuracy

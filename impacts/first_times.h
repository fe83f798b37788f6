// First times of impact of a block of pairs of any kinds.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "carom/results/pair.h"
#include "impacts/impact.h"
#include "impacts/simple_times.h"

namespace carom {

// One entry a pair, as the fields of FirstTime.
struct FirstTimeColumns {
  double* time;
  uint8_t* status;
  std::array<uint64_t, 2>* parts;
};

// Finds the first times of at most kPairsPerBlock pairs.
void find_first_times(const MovingSide& a, const MovingSide& b, std::span<const Pair> pairs,
                      const TimesWanted& wanted, const FirstTimeColumns& out);

}  // namespace carom

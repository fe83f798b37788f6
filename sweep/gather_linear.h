// Bodies of a view -> columns of linear pairs.
#pragma once

#include <span>

#include "sweep/linear_rows.h"
#include "sweep/moving_body.h"

namespace carom {

// A list of pairs of kinds A and B; `flipped`: pairs[row] is of B and A.
struct LinearPairs {
  const Pair* pairs;
  std::span<const uint16_t> rows;
  bool flipped;

  // A's body, then B's.
  Pair pair(size_t i) const {
    const Pair pair = pairs[rows[i]];
    return flipped ? Pair{pair.b, pair.a} : pair;
  }
};

// Writes row i of the columns for pair i of the list, and whether both bodies are valid; they move
// in a straight line and have a kernel.
using GatherLinear = void (*)(const MovingSide& a, const MovingSide& b, const LinearPairs& pairs,
                              LinearRows& rows, bool* valid);

GatherLinear gather_linear(LinearKind a, LinearKind b);

}  // namespace carom

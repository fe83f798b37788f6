// Bodies of a view -> columns of linear pairs.
#pragma once

#include "sweep/linear_rows.h"
#include "sweep/moving_body.h"

namespace carom {

// Writes row `row`, of a pair of kinds A and B (in this order; `flipped`: the pair is B, A) that
// moves in a straight line and has a kernel.
using GatherLinear = void (*)(const MovingReader& a, const MovingReader& b, Pair pair,
                              LinearRows& rows, size_t row);

GatherLinear gather_linear(LinearKind a, LinearKind b);

}  // namespace carom

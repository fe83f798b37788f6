// Bodies of a view -> columns of linear pairs.
#pragma once

#include <cstdint>

#include "impacts/linear/linear_rows.h"
#include "impacts/moving_body.h"

namespace carom {

// The body of every row, all of one linear kind that moves in a straight line.
struct LinearSide {
  const MovingSide& side;
  LinearKind kind;
  const uint32_t* body;
};

// Writes `count` rows of A and B in this order, and whether both bodies are valid. There is a
// kernel for their kinds.
void gather_linear(const LinearSide& a, const LinearSide& b, size_t count, LinearRows& rows,
                   bool* valid);

}  // namespace carom

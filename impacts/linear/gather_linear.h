// Gathers bodies of a view into columns of linear pairs.
#pragma once

#include <cstdint>

#include "impacts/linear/linear_rows.h"
#include "impacts/moving_body.h"

namespace carom {

// The body of every row. All are of one linear kind and move in a straight line.
struct LinearSide {
  const MovingSide& side;
  LinearKind kind;
  const uint32_t* body;
};

// Writes `count` rows of A and B in this order. valid[i] says whether both bodies of row i are
// valid. Their kinds must have a kernel.
void gather_linear(const LinearSide& a, const LinearSide& b, size_t count, LinearRows& rows,
                   bool* valid);

}  // namespace carom

// The results of boxes grow in lanes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "narrowphase/batch/batch.h"

namespace carom {

// The state of a row after its cores were tested.
enum class GrownState : uint8_t {
  done = 0,     // it has its answer, or none, since a body is not valid
  near = 1,     // the separation of the cores is only a bound, but they are to be measured
  left = 2,     // float32 cannot decide, or there is no rounding
  invalid = 3,  // a rounding is not valid
};

struct BoxesToGrow {
  const Batch& cores;  // of boxes on both sides; `out` has points relative to the bodies
  WitnessFrame frame;  // of the points to write
  bool is_rounded_a, is_rounded_b;
  bool is_bound;  // the separation of separate cores is only a bound
};

// Grows rows as class Growth says, and writes the state of each row. Rows that are not done keep
// what they have, but for `overlap`. Returns the number of rows that it took: whole vectors.
size_t grow_boxes(const BoxesToGrow& boxes, uint8_t* state);

}  // namespace carom

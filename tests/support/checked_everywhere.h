// Checks one pair on every ISA and in both orders against the exact answer.
#pragma once

#include "tests/support/isas.h"
#include "tests/support/kind_checks.h"
#include "tests/support/run.h"

namespace carom::test {

// Returns the result of (A, B).
inline reference::PairResult checked_everywhere(const TestPair& pair,
                                                PositionType positions = PositionType::float32) {
  for (const TestPair& each : {pair, swapped(pair)}) {
    checked_result(each, positions);
    Call call = call_with(positions);
    call.detail = Detail::manifold;
    for_each_isa([&] {
      EXPECT_TRUE(same_rows(expected_rows({&each, 1}, positions, Detail::manifold),
                            run_rows({&each, 1}, call), {&each, 1}));
    });
  }
  return reference_result(pair, positions);
}

}  // namespace carom::test

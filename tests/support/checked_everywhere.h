// Checks one pair on every ISA and in both orders against the exact answer.
#pragma once

#include "tests/support/isas.h"
#include "tests/support/kind_checks.h"
#include "tests/support/run.h"

namespace carom::test {

// Returns the result of (A, B).
reference::PairResult checked_everywhere(const TestPair& pair,
                                         PositionType positions = PositionType::float32);

}  // namespace carom::test

#include "tests/support/checked_everywhere.h"

namespace carom::test {

reference::PairResult checked_everywhere(const TestPair& pair, PositionType positions) {
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

// Pairs with a cylinder, a cone or an ellipsoid, one at a time.
#include <algorithm>
#include <limits>

#include "narrowphase/batch/row_store.h"
#include "narrowphase/batch/single_pair.h"
#include "narrowphase/pairs/manifold_batch.h"

namespace carom {

void run_round_pair(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b) {
  if (batch.pass == Pass::manifold) {
    return run_manifolds_one_by_one(batch, kind_a, kind_b);
  }
  const RowStore store(batch, kind_a, kind_b);
  for (size_t row = 0; row < batch.count; ++row) {
    std::array<float, 10> answer;
    if (!is_valid_pair(batch, kind_a, kind_b, row)) {
      answer.fill(std::numeric_limits<float>::quiet_NaN());
      store.put(row, Status::invalid, answer);
      continue;
    }
    const std::array<float, 11> found = exact_answer(batch, kind_a, kind_b, row);
    std::copy_n(found.begin(), answer.size(), answer.begin());
    store.put(row, found[10] != 0 ? Status::degenerate : Status::ok, answer);
    if (batch.unsure) batch.unsure[row] = 1;
  }
}

}  // namespace carom

#include "narrowphase/pairs/scalar_batch.h"

#include "narrowphase/batch/row_store.h"
#include "narrowphase/batch/single_pair.h"

namespace carom {
namespace {

void test_rows(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b) {
  const RowStore store(batch, kind_a, kind_b);
  for (size_t row = 0; row < batch.count; ++row) {
    if (!is_valid_pair(batch, kind_a, kind_b, row)) {
      store.put_invalid(row);
      continue;
    }
    const std::array<float, 11> answer = exact_answer(batch, kind_a, kind_b, row);
    const Status status = answer[10] != 0 ? Status::degenerate : Status::ok;
    store.put(row, status, answer);
    if (batch.unsure)
      batch.unsure[row] = 1;  // the test gives no error bound that would prove the decision
  }
}

}  // namespace

void run_scalar_batch(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b) {
  if (batch.pass == Pass::manifold) return run_scalar_manifolds(batch, kind_a, kind_b);
  test_rows(batch, kind_a, kind_b);
}

void run_scalar_manifolds(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b,
                          const uint8_t* wanted) {
  for (size_t row = 0; row < batch.count; ++row) {
    if (wanted && wanted[row] == 0) continue;
    const size_t to = batch.manifold_row[row];
    batch.out.manifold_count[to] =
        manifold_answer(batch, kind_a, kind_b, row, batch.out.manifold[to]);
  }
}

}  // namespace carom

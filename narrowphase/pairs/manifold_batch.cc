#include "narrowphase/pairs/manifold_batch.h"

#include <array>

#include "narrowphase/batch/column_memory.h"
#include "narrowphase/batch/single_pair.h"

namespace carom {

void run_manifolds(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b,
                   void (*in_lanes)(const Batch&)) {
  std::array<uint8_t, kPairsPerBlock> left{};
  Batch lanes = batch;
  lanes.unsure = left.data();
  in_lanes(lanes);
  for (size_t row = 0; row < batch.count; ++row) {
    if (left[row] == 0) continue;
    const size_t to = batch.manifold_row[row];
    batch.out.manifold_count[to] =
        manifold_answer(batch, kind_a, kind_b, row, batch.out.manifold[to]);
  }
}

}  // namespace carom

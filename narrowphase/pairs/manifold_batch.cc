#include "narrowphase/pairs/manifold_batch.h"

#include <algorithm>
#include <array>

#include "narrowphase/batch/column_memory.h"
#include "narrowphase/batch/single_pair.h"
#include "narrowphase/batch/world_point.h"

namespace carom {

void run_manifolds(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b,
                   void (*in_lanes)(const Batch&)) {
  std::array<uint8_t, kPairsPerBlock> left{};
  Batch lanes = batch;
  lanes.unsure = left.data();
  in_lanes(lanes);
  const Collidables bodies_a = view_of(batch.a, batch.layout, kind_a);
  for (size_t row = 0; row < batch.count; ++row) {
    if (left[row] == 0) continue;
    const size_t to = batch.manifold_row[row];
    ManifoldPoints& points = batch.out.manifold[to];
    const uint8_t count = manifold_answer(batch, kind_a, kind_b, row, points);
    batch.out.manifold_count[to] = count;
    for (size_t k = 0; batch.frame == WitnessFrame::world && k < count; ++k) {
      points.point[k] = world_point(BodyReader{bodies_a}, batch.pairs[row].a, points.point[k]);
    }
  }
}

void run_manifolds_one_by_one(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b) {
  run_manifolds(batch, kind_a, kind_b,
                [](const Batch& lanes) { std::fill_n(lanes.unsure, lanes.count, uint8_t{1}); });
}

}  // namespace carom

#include "narrowphase/blocks/passes.h"

#include <algorithm>

#include "base/few_of.h"
#include "narrowphase/batch/packed_direction.h"
#include "narrowphase/batch/row_selection.h"
#include "narrowphase/batch/world_points.h"
#include "narrowphase/blocks/pass_plan.h"
#include "narrowphase/hulls/features.h"
#include "narrowphase/manifolds/witness_points.h"
#include "narrowphase/proof/decide_unsure.h"
#include "narrowphase/proof/separation_bound.h"

namespace carom {
namespace {

bool is_invalid(const Batch& batch, size_t row) {
  return batch.out.status[row] == static_cast<uint8_t>(Status::invalid);
}

using RowFlags = std::array<uint8_t, kPairsPerBlock>;

// Measures the separate pairs. `of_invalid_pairs`: writes the columns of invalid pairs as well.
void run_distances(const PairKind& kind, const Batch& batch, bool of_invalid_pairs) {
  RowSelection separate(batch);
  separate.select([&](size_t row) {
    return !batch.out.overlap[row] && (of_invalid_pairs || !is_invalid(batch, row));
  });
  if (separate.count() == 0) return;
  TestColumns scratch;
  Batch distances = separate.batch(Pass::distance);
  distances.out = scratch.columns();
  kind.run(distances);
  separate.scatter(distances.out, batch.out, batch.detail);
}

// Writes to `open` which rows still need a test: all that are not separate along their direction.
void run_directions(const PairKind& kind, const Batch& batch, const uint32_t* direction,
                    RowFlags& open) {
  open.fill(1);
  RowSelection known(batch);
  known.select([&](size_t row) { return direction[row] != kNoDirection; });
  if (known.count() == 0) return;
  std::array<uint32_t, kPairsPerBlock> known_direction;
  RowFlags known_open;
  known.gather(direction, known_direction.data());
  Batch directions = known.batch(Pass::direction);
  directions.direction = known_direction.data();
  directions.out.overlap = known_open.data();
  kind.run(directions);
  known.scatter(known_open.data(), open.data());
}

// Stores the normals of the tested separate pairs. Without branches: they would be taken at random,
// and predicted badly.
void remember_directions(const Batch& batch, const RowFlags& tested, uint32_t* direction) {
  const ResultColumns& out = batch.out;
  for (size_t row = 0; row < batch.count; ++row) {
    const uint32_t found =
        pack_direction({out.normal[0][row], out.normal[1][row], out.normal[2][row]});
    const uint32_t apart = out.overlap[row] ? kNoDirection : found;
    direction[row] = tested[row] ? apart : direction[row];
  }
}

// Writes to `open` which rows still need a test, and the results of the others. `finds_depths`:
// overlapping pairs need a depth, which a recall cannot find. Where nearly all rows have features
// it takes all of them, since copying results back takes longer.
void run_recall(const PairKind& kind, const Batch& batch, bool finds_depths, RowFlags& open) {
  constexpr size_t kFewest = 8;  // fewer than one row in so many are few
  const size_t most = finds_depths ? kMostFeatures - 1 : kMostFeatures;
  RowSelection known(batch);
  known.select([&](size_t row) {
    open[row] = batch.features[row] == kNoFeatures || feature_count(batch.features[row]) > most;
    return open[row] == 0;
  });
  if (known.count() == 0) return;
  RowFlags unsure{};
  if (kFewest * (batch.count - known.count()) < batch.count) {
    Batch recall = batch;
    recall.pass = Pass::recall;
    recall.unsure = unsure.data();
    kind.run(recall);
    for (size_t row = 0; row < batch.count; ++row) open[row] |= unsure[row];
    return;
  }
  TestColumns scratch;
  std::array<uint64_t, kPairsPerBlock> features;
  known.gather(batch.features, features.data());
  Batch recall = known.batch(Pass::recall);
  recall.features = features.data();
  recall.unsure = unsure.data();
  recall.out = scratch.columns();
  kind.run(recall);
  known.scatter(recall.out, batch.out, batch.detail);
  known.scatter(unsure.data(), open.data());
}

// Tests the open rows and leaves the others as they are.
void test_open(const PairKind& kind, const Batch& batch, const RowFlags& open) {
  RowSelection tested(batch);
  tested.select([&](size_t row) { return open[row] != 0; });
  if (tested.count() == batch.count) return kind.run(batch);
  if (tested.count() == 0) return;
  TestColumns scratch;
  RowFlags unsure{};
  std::array<uint64_t, kPairsPerBlock> features;
  Batch test = tested.batch(batch.pass);
  test.out = scratch.columns();
  if (batch.unsure) test.unsure = unsure.data();
  if (batch.features) test.features = features.data();
  kind.run(test);
  if (batch.features) tested.scatter(features.data(), batch.features);
  if (batch.unsure) tested.scatter(unsure.data(), batch.unsure);
  tested.scatter(test.out, batch.out, batch.detail);
}

// Sets the decisions of the rows that are known to be separate.
void settle(const Batch& batch, const RowFlags& open) {
  const ResultColumns& out = batch.out;
  for (size_t row = 0; row < batch.count; ++row) {
    out.overlap[row] = open[row] ? out.overlap[row] : uint8_t{0};
    out.status[row] = open[row] ? out.status[row] : static_cast<uint8_t>(Status::ok);
  }
  for (size_t row = 0; batch.unsure && row < batch.count; ++row) {
    batch.unsure[row] = open[row] ? batch.unsure[row] : uint8_t{0};
  }
}

// Tests the pairs that are no longer separate along their known direction. Where nearly all of them
// are open, all are tested: copying the results of those that are takes longer than testing the
// others.
void run_test(const PairKind& kind, const Batch& batch, uint32_t* direction) {
  constexpr size_t kFewest = 4;  // fewer than one row in so many are few
  RowFlags open;
  run_directions(kind, batch, direction, open);
  const auto settled = static_cast<size_t>(std::count(open.begin(), open.begin() + batch.count, 0));
  if (kFewest * settled < batch.count) {
    kind.run(batch);
  } else {
    test_open(kind, batch, open);
  }
  if (settled > 0) settle(batch, open);
  remember_directions(batch, open, direction);
}

// `batch` has witness points relative to the bodies; manifolds get their points in `frame`.
void run_manifolds(const PairKind& kind, const Batch& batch, WitnessFrame frame,
                   bool of_separate_pairs) {
  std::fill_n(batch.out.manifold_count, batch.count, uint8_t{0});
  if (of_separate_pairs) std::fill_n(batch.out.manifold, batch.count, ManifoldPoints{});
  TestColumns contacts;
  const ResultColumns& from = batch.out;
  const ResultColumns to = contacts.columns();
  FewOf<PackedColumn, 8> columns;
  columns.push_back({from.separation, to.separation});
  for (size_t axis = 0; axis < 3; ++axis) {
    columns.push_back({from.normal[axis], to.normal[axis]});
    columns.push_back({from.point_a[axis], to.point_a[axis]});
  }
  // Without contact distances the rows that touch are those that overlap.
  const uint8_t* touch = from.overlap;
  std::array<float, kPairsPerBlock> reach;
  RowFlags within_reach;
  if (batch.reach) {
    columns.push_back({batch.reach, reach.data()});
    for (size_t row = 0; row < batch.count; ++row) within_reach[row] = touches(batch, row);
    touch = within_reach.data();
  }
  RowSelection touching(batch);
  touching.pack(touch, {columns.begin(), columns.size()});
  if (touching.count() == 0) return;
  Batch manifolds = touching.batch(Pass::manifold);
  manifolds.frame = frame;
  manifolds.tested = to;
  manifolds.manifold_row = touching.rows();
  if (batch.reach) manifolds.reach = reach.data();
  kind.run(manifolds);
}

void run_search(const PairKind& kind, const Batch& batch, const PassPlan& plan,
                uint32_t* direction) {
  Batch search = batch;
  search.pass = plan.search;
  search.detail = plan.search_detail;
  if (direction && plan.known == PassPlan::Known::directions) {
    run_test(kind, batch, direction);
  } else if (plan.known == PassPlan::Known::features) {
    RowFlags open;
    run_recall(kind, batch, plan.search == Pass::distance, open);
    test_open(kind, search, open);
  } else {
    kind.run(search);
  }
}

void run_points(const PairKind& kind, const Batch& batch, WitnessFrame frame,
                const PassPlan& plan) {
  switch (plan.points) {
    case PassPlan::Points::none:
      return;
    case PassPlan::Points::zero:
      std::fill_n(batch.out.manifold_count, batch.count, uint8_t{0});
      std::fill_n(batch.out.manifold, batch.count, ManifoldPoints{});
      return;
    case PassPlan::Points::witnesses:
      return copy_witnesses(batch);
    case PassPlan::Points::clipped:
      return run_manifolds(kind, batch, frame, plan.clears_separate);
  }
}

}  // namespace

void run_passes(const PairKind& kind, const Batch& asked, Measured measured, uint32_t* direction,
                const Accuracy& accuracy) {
  const PassPlan plan = plan_passes(kind, asked, measured, direction != nullptr, accuracy);
  RowFlags unsure;
  Batch batch = asked;
  batch.single_precision = plan.single_precision;
  if (!plan.proves) batch.slack = accuracy.tolerance;
  // Points are clipped relative to the bodies.
  if (plan.points == PassPlan::Points::clipped) batch.frame = WitnessFrame::body;
  if (plan.known == PassPlan::Known::features) batch.features = batch.out.features;
  if (plan.proves) {
    std::fill_n(unsure.begin(), batch.count, uint8_t{0});
    batch.unsure = unsure.data();
  }
  run_search(kind, batch, plan, direction);
  if (plan.measures_separate) run_distances(kind, batch, plan.measures_invalid);
  if (plan.proves) decide_unsure(kind, batch, accuracy.tier);
  if (plan.bounds) bound_separations(kind, batch);
  run_points(kind, batch, asked.frame, plan);
  if (batch.frame != asked.frame) move_to_world(batch);
}

}  // namespace carom

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
  known.select([&](size_t row) { return is_direction(direction[row]); });
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

// Stores the normals of the separate pairs whose rows are not remembered yet. Without branches:
// they would be taken at random, and predicted badly.
void remember_directions(const Batch& batch, const RowFlags& is_remembered, uint32_t* direction) {
  const ResultColumns& out = batch.out;
  for (size_t row = 0; row < batch.count; ++row) {
    const uint32_t found =
        pack_direction({out.normal[0][row], out.normal[1][row], out.normal[2][row]});
    const uint32_t apart = out.overlap[row] ? kNoDirection : found;
    direction[row] = is_remembered[row] ? direction[row] : apart;
  }
}

// A shell or nullptr for each row.
using RowShells = std::array<Shell*, kPairsPerBlock>;

// Calls use(row) for the rows with this flag. Lists them first, without branches: they are as
// random as overlaps.
template <class Use>
void for_each_flagged(const uint8_t* flags, size_t count, const Use& use) {
  std::array<uint16_t, kPairsPerBlock + 1> rows;
  size_t found = 0;
  for (size_t row = 0; row < count; ++row) {
    rows[found] = static_cast<uint16_t>(row);
    found += flags[row] != 0 ? 1 : 0;
  }
  for (size_t i = 0; i < found; ++i) use(rows[i]);
}

// Closes the open rows whose shells prove their depths, and writes their results. `of_rows`: the
// shells of this step.
void run_shells(const PairKind& kind, const Batch& batch, const uint32_t* words, KeptShells& shells,
                RowShells& of_rows, RowFlags& open) {
  of_rows.fill(nullptr);
  RowFlags has_shell{};
  for_each_flagged(open.data(), batch.count, [&](size_t row) {
    Shell* const shell = shells.take(words[row]);
    of_rows[row] = shell;
    has_shell[row] = shell && shell->triangle_count > 0;
  });
  RowSelection known(batch);
  known.select([&](size_t row) { return has_shell[row] != 0; });
  if (known.count() == 0) return;
  RowShells of_known;
  known.gather(of_rows.data(), of_known.data());
  TestColumns scratch;
  Batch proofs = known.batch(Pass::shell);
  proofs.shells = of_known.data();
  proofs.out = scratch.columns();
  kind.run(proofs);
  known.scatter(proofs.out, batch.out, batch.detail);
  for (size_t i = 0; i < known.count(); ++i) open[known.rows()[i]] = !proofs.out.overlap[i];
}

// Stores where the shells of the pairs are that overlap; these rows are then remembered.
void remember_shells(const Batch& batch, const RowShells& of_rows, KeptShells& shells,
                     RowFlags& is_remembered, uint32_t* words) {
  for_each_flagged(batch.out.overlap, batch.count, [&](size_t row) {
    words[row] = shells.word_of(of_rows[row], words[row]);
    is_remembered[row] = 1;
  });
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
  RowShells shells;
  Batch test = tested.batch(batch.pass);
  test.out = scratch.columns();
  if (batch.shells) {
    tested.gather(batch.shells, shells.data());
    test.shells = shells.data();
  }
  if (batch.unsure) test.unsure = unsure.data();
  if (batch.features) test.features = features.data();
  kind.run(test);
  if (batch.features) tested.scatter(features.data(), batch.features);
  if (batch.unsure) tested.scatter(unsure.data(), batch.unsure);
  tested.scatter(test.out, batch.out, batch.detail);
}

// Sets the decisions of the rows that are known to be separate. Without branches on them, which
// nobody can predict.
void settle(const Batch& batch, const RowFlags& is_apart) {
  RowFlags mask;
  for (size_t row = 0; row < batch.count; ++row) mask[row] = is_apart[row] ? 0 : 0xff;
  static_assert(static_cast<uint8_t>(Status::ok) == 0);
  const auto clear = [&](uint8_t* flags) {
    for (size_t row = 0; row < batch.count; ++row) flags[row] &= mask[row];
  };
  clear(batch.out.overlap);
  clear(batch.out.status);
  if (batch.unsure) clear(batch.unsure);
}

// Tests the pairs that are no longer separate along their known direction, and whose shells do not
// prove their depths. Where nearly all of them are open, all are tested: copying the results of
// those that are takes longer than testing the others.
void run_test(const PairKind& kind, Batch batch, const PairMemory& memory) {
  constexpr size_t kFewest = 4;  // fewer than one row in so many are few
  RowFlags open, is_apart;
  run_directions(kind, batch, memory.direction, open);
  for (size_t row = 0; row < batch.count; ++row) is_apart[row] = !open[row];
  RowShells shells;
  if (memory.shells) {
    run_shells(kind, batch, memory.direction, *memory.shells, shells, open);
    batch.shells = shells.data();
  }
  const auto settled = static_cast<size_t>(std::count(open.begin(), open.begin() + batch.count, 0));
  if (kFewest * settled < batch.count) {
    kind.run(batch);
  } else {
    test_open(kind, batch, open);
  }
  if (settled > 0) settle(batch, is_apart);
  if (memory.shells) {
    remember_shells(batch, shells, *memory.shells, is_apart, memory.direction);
  }
  remember_directions(batch, is_apart, memory.direction);
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
                const PairMemory& memory) {
  Batch search = batch;
  search.pass = plan.search;
  search.detail = plan.search_detail;
  search.measures = plan.measures_in_test;
  if (memory.direction && plan.known == PassPlan::Known::directions) {
    const bool has_shells = memory.shells && batch.slack > 0 && kind.has_shell_pass();
    return run_test(kind, batch, {memory.direction, has_shells ? memory.shells : nullptr});
  }
  // A place of a shell is good for one step, even if the pair needs none in this one.
  if (memory.direction) std::fill_n(memory.direction, batch.count, kNoDirection);
  if (plan.known == PassPlan::Known::features) {
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

void run_passes(const PairKind& kind, const Batch& asked, Measured measured,
                const PairMemory& memory, const Accuracy& accuracy) {
  const PassPlan plan = plan_passes(kind, asked, measured, memory.direction != nullptr, accuracy);
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
  run_search(kind, batch, plan, memory);
  if (plan.measures_separate) run_distances(kind, batch, plan.measures_invalid);
  if (plan.proves) decide_unsure(kind, batch, accuracy.tier);
  if (plan.bounds) bound_separations(kind, batch);
  run_points(kind, batch, asked.frame, plan);
  if (batch.frame != asked.frame) move_to_world(batch);
}

}  // namespace carom

#include "narrowphase/passes.h"

#include <algorithm>

namespace carom {
namespace {

// Some rows of a batch, as a batch of their own.
class RowSelection {
 public:
  explicit RowSelection(const Batch& batch) : batch_(batch) {}

  template <class Wanted>
  void select(const Wanted& wanted) {
    count_ = 0;
    for (size_t row = 0; row < batch_.count; ++row) {
      rows_[count_] = static_cast<uint16_t>(row);
      pairs_[count_] = batch_.pairs[row];
      count_ += wanted(row);
    }
  }

  size_t count() const { return count_; }
  size_t row(size_t i) const { return rows_[i]; }

  Batch batch(Pass pass) const {
    Batch selected = batch_;
    selected.pass = pass;
    selected.pairs = pairs_.data();
    selected.pairs_are_rows = false;
    selected.count = count_;
    return selected;
  }

  template <class T>
  void gather(const T* from, T* to) const {
    for (size_t i = 0; i < count_; ++i) to[i] = from[rows_[i]];
  }
  template <class T>
  void scatter(const T* from, T* to) const {
    for (size_t i = 0; i < count_; ++i) to[rows_[i]] = from[i];
  }

 private:
  const Batch& batch_;
  size_t count_ = 0;
  std::array<uint16_t, kPairsPerBlock + 1> rows_;
  std::array<Pair, kPairsPerBlock + 1> pairs_;
};

bool is_separate(const Batch& batch, size_t row) {
  return !batch.out.overlap[row] && batch.out.status[row] != static_cast<uint8_t>(Status::invalid);
}

void run_distances(const PairKind& kind, const Batch& batch) {
  RowSelection separate(batch);
  separate.select([&](size_t row) { return is_separate(batch, row); });
  if (separate.count() == 0) return;
  ScratchColumns scratch;
  Batch distances = separate.batch(Pass::distance);
  distances.out = scratch.columns();
  kind.run(distances);
  separate.scatter(distances.out.status, batch.out.status);
  separate.scatter(distances.out.separation, batch.out.separation);
  for (size_t axis = 0; axis < 3; ++axis) {
    separate.scatter(distances.out.normal[axis], batch.out.normal[axis]);
    separate.scatter(distances.out.point_a[axis], batch.out.point_a[axis]);
    separate.scatter(distances.out.point_b[axis], batch.out.point_b[axis]);
  }
}

// One point: the witness.
void copy_witnesses(const Batch& batch) {
  const ResultColumns& out = batch.out;
  for (size_t row = 0; row < batch.count; ++row) {
    out.manifold[row] = {};
    out.manifold_count[row] = out.overlap[row];
    if (!out.overlap[row]) continue;
    out.manifold[row].point[0] = {out.point_a[0][row], out.point_a[1][row], out.point_a[2][row]};
    out.manifold[row].separation[0] = out.separation[row];
  }
}

void run_manifolds(const PairKind& kind, const Batch& batch) {
  std::fill_n(batch.out.manifold_count, batch.count, uint8_t{0});
  std::fill_n(batch.out.manifold, batch.count, ManifoldPoints{});
  RowSelection overlapping(batch);
  overlapping.select([&](size_t row) { return batch.out.overlap[row]; });
  if (overlapping.count() == 0) return;
  ScratchColumns contacts;
  std::array<uint8_t, kPairsPerBlock> count;
  std::array<ManifoldPoints, kPairsPerBlock> points;
  Batch manifolds = overlapping.batch(Pass::manifold);
  manifolds.tested = contacts.columns();
  manifolds.out.manifold_count = count.data();
  manifolds.out.manifold = points.data();
  overlapping.gather(batch.out.separation, manifolds.tested.separation);
  for (size_t axis = 0; axis < 3; ++axis) {
    overlapping.gather(batch.out.normal[axis], manifolds.tested.normal[axis]);
    overlapping.gather(batch.out.point_a[axis], manifolds.tested.point_a[axis]);
  }
  kind.run(manifolds);
  overlapping.scatter(count.data(), batch.out.manifold_count);
  overlapping.scatter(points.data(), batch.out.manifold);
}

}  // namespace

ResultColumns ScratchColumns::columns() {
  const auto column3 = [this](size_t i) -> std::array<float*, 3> {
    return {floats[i].data(), floats[i + 1].data(), floats[i + 2].data()};
  };
  return {overlap.data(), status.data(), floats[0].data(), column3(1), column3(4), column3(7)};
}

void run_passes(const PairKind& kind, const Batch& batch, bool wants_distances) {
  kind.run(batch);
  if (batch.detail == Detail::overlap) return;
  if (wants_distances && kind.has_distance_pass()) run_distances(kind, batch);
  if (batch.detail != Detail::manifold) return;
  if (kind.has_manifold_pass()) {
    run_manifolds(kind, batch);
  } else {
    copy_witnesses(batch);
  }
}

}  // namespace carom

#include "broadphase/sweep/sweep_order.h"

#include <algorithm>
#include <array>
#include <bit>

#include "base/radix_sort.h"
#include "broadphase/box_source.h"

namespace carom {
namespace {

// An integer that orders like the float; -0 and +0 give the same one.
uint32_t sortable(float v) {
  const auto bits = std::bit_cast<uint32_t>(v + 0.0f);
  return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

uint64_t item(const BoundsView& bounds, size_t axis, uint32_t i) {
  return uint64_t{sortable(value_at(bounds, bounds.lower[axis], i))} << 32 | i;
}

uint32_t index_of(uint64_t item) { return static_cast<uint32_t>(item); }

// An insertion sort that gives up, and returns false, after `budget` moves.
bool insertion_sort(std::vector<uint64_t>& items, size_t budget) {
  for (size_t i = 1; i < items.size(); ++i) {
    const uint64_t moving = items[i];
    size_t hole = i;
    for (; hole > 0 && items[hole - 1] > moving; --hole) items[hole] = items[hole - 1];
    items[hole] = moving;
    const size_t moves = i - hole;
    if (moves > budget) return false;
    budget -= moves;
  }
  return true;
}

struct Moments {
  double count = 0;
  double sum = 0;
  double squares = 0;
};

double variance(const Moments& m) {
  if (m.count == 0) return 0;
  const double mean = m.sum / m.count;
  return m.squares / m.count - mean * mean;
}

}  // namespace

size_t axis_of_largest_spread(const BoundsView& bounds) {
  // A sample of fixed places is enough to choose an axis, and costs nothing.
  constexpr size_t kSamples = 4096;
  const size_t step = std::max<size_t>(1, bounds.count / kSamples);
  std::array<Moments, 3> moments;
  for (size_t i = 0; i < bounds.count; i += step) {
    if (!takes_part(bounds, i)) continue;
    for (size_t axis = 0; axis < 3; ++axis) {
      const double v = std::clamp(value_at(bounds, bounds.lower[axis], i), -1e30f, 1e30f);
      moments[axis].count += 1;
      moments[axis].sum += v;
      moments[axis].squares += v * v;
    }
  }
  size_t best = 0;
  for (size_t axis = 1; axis < 3; ++axis) {
    if (variance(moments[axis]) > variance(moments[best])) best = axis;
  }
  return best;
}

void SweepOrder::update(const BoundsView& bounds, size_t axis, Parallelism parallelism,
                        std::vector<uint32_t>& order) {
  if (axis != axis_ || !repair(bounds, axis, order)) {
    collect(bounds, axis);
    radix_sort_by_key(items_, scratch_, histograms_, parallelism);
  }
  axis_ = axis;
  order.resize(items_.size());
  std::transform(items_.begin(), items_.end(), order.begin(), index_of);
}

// Sorts the last call's order by this call's keys with insertions. Returns false if that is not
// worth it: boxes appeared or vanished, or moved past too many others.
bool SweepOrder::repair(const BoundsView& bounds, size_t axis, const std::vector<uint32_t>& order) {
  constexpr size_t kMovesPerBox = 4;  // beyond, three radix passes are cheaper
  size_t present = 0;
  for (size_t i = 0; i < bounds.count; ++i) present += takes_part(bounds, i);
  if (present != order.size()) return false;
  items_.resize(order.size());
  for (size_t i = 0; i < order.size(); ++i) {
    if (order[i] >= bounds.count || !takes_part(bounds, order[i])) return false;
    items_[i] = item(bounds, axis, order[i]);
  }
  return insertion_sort(items_, kMovesPerBox * items_.size());
}

// Lists the boxes in ascending order of index, which makes the stable sort a total order.
void SweepOrder::collect(const BoundsView& bounds, size_t axis) {
  items_.clear();
  for (size_t i = 0; i < bounds.count; ++i) {
    if (takes_part(bounds, i)) items_.push_back(item(bounds, axis, static_cast<uint32_t>(i)));
  }
}

size_t SweepOrder::bytes() const {
  return (items_.capacity() + scratch_.capacity()) * sizeof(uint64_t) +
         histograms_.capacity() * sizeof(uint32_t);
}

}  // namespace carom

#include "broadphase/point_candidates.h"

#include <algorithm>

#include "broadphase/sort/sort_pairs.h"
#include "broadphase/sweep/box_columns.h"
#include "broadphase/sweep/scan.h"
#include "broadphase/sweep/sweep_order.h"

namespace carom {
namespace {

constexpr size_t kBoxesPerBlock = 4096;

class CandidateSink final : public HitSink {
 public:
  CandidateSink(const BoxColumns& points, PairList& out) : points_(points), out_(out) {}

  void add(size_t box, const uint32_t* rows, size_t count) override {
    Pair* candidates = out_.reserve(count);
    for (size_t i = 0; i < count; ++i) {
      candidates[i] = {points_.body[rows[i]], static_cast<uint32_t>(box)};
    }
    out_.commit(count);
  }

 private:
  const BoxColumns& points_;
  PairList& out_;
};

// Box i with `first_axis` as its axis 0.
SearchBox turned_box(const BoundsView& bounds, size_t i, size_t first_axis) {
  SearchBox box;
  for (size_t k = 0; k < 3; ++k) {
    box.lower[k] = value_at(bounds, bounds.lower[(first_axis + k) % 3], i);
    box.upper[k] = value_at(bounds, bounds.upper[(first_axis + k) % 3], i);
  }
  return box;
}

}  // namespace

std::vector<Pair> find_point_candidates(const float* xyz, size_t count, size_t stride,
                                        const BoundsView& bounds, Parallelism parallelism) {
  if (count == 0) return {};
  const std::array<const float*, 3> columns = {xyz, xyz + 1, xyz + 2};
  const BoundsView as_boxes{columns, columns, count, stride};
  const size_t axis = axis_of_largest_spread(as_boxes);
  SweepOrder order;
  BoxColumns points;
  order.update(as_boxes, axis, parallelism, points.body);
  points.fill(as_boxes, axis, parallelism);

  FoundPairs found;
  found.start(~size_t{0});
  found.add(block_count(bounds.count, kBoxesPerBlock));
  for_each_block(
      bounds.count, kBoxesPerBlock, parallelism, [&](size_t block, size_t begin, size_t end) {
        CandidateSink sink(points, found[block]);
        const auto first = points.lower[0].begin();
        for (size_t i = begin; i < end; ++i) {
          if (!takes_part(bounds, i)) continue;
          const SearchBox box = turned_box(bounds, i, axis);
          const auto row =
              std::lower_bound(first, first + static_cast<ptrdiff_t>(points.count), box.lower[0]);
          sweep_box(points, box, i, static_cast<size_t>(row - first), sink);
        }
      });
  std::vector<Pair> pairs;
  Scratch scratch;
  PairSorter().sort(found.lists(), count, parallelism, pairs, scratch);
  return pairs;
}

}  // namespace carom

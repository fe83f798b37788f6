// Finds the pairs of half-spaces and boxes. Half-spaces have no bounds: they pair with every box
// that reaches into them.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/scratch.h"
#include "broadphase/sort/sort_pairs.h"
#include "broadphase/space_order.h"
#include "carom/base/parallelism.h"
#include "carom/broadphase/find_pairs.h"
#include "carom/results/pair.h"
#include "carom/shapes/views.h"

namespace carom {

// A half-space in world coordinates: all x with normal . x <= limit. The length of the normal
// follows from the body's quaternion and normal; the limit is rounded upwards.
struct WorldHalfspace {
  uint32_t body;
  std::array<double, 3> normal;
  double limit;
  double slack;  // slack * (|x| + |y| + |z|) bounds the rounding error of normal . x
};

// `body` must be a valid half-space of the view.
WorldHalfspace world_halfspace(const Collidables& bodies, uint32_t body);

// False only if the point is certainly outside, despite all rounding of the plane and of this test.
// An overflow gives infinities and then NaN, for which this is true.
inline bool may_hold(const WorldHalfspace& halfspace, double x, double y, double z) {
  const auto& n = halfspace.normal;
  const double height = (n[0] * x + n[1] * y) + n[2] * z;
  const double error = halfspace.slack * ((std::abs(x) + std::abs(y)) + std::abs(z));
  return !(height - error > halfspace.limit);
}

// The search keeps its working memory between calls.
class HalfspaceSearch {
 public:
  // Replaces `out` by the sorted pairs of a half-space and a box such that a corner of the box may
  // lie in the half-space, and the filter allows the pair. Half-spaces ascend by body. Boxes that
  // are empty or hold a NaN pair with nothing; the boxes of the half-spaces themselves must be
  // such. Returns the number of pairs; if it is above `most_pairs`, writes none.
  size_t find(std::span<const WorldHalfspace> halfspaces, const BoundsView& bounds,
              const PairFilter& filter, size_t most_pairs, Parallelism parallelism,
              std::vector<Pair>& out);

  size_t bytes() const;

 private:
  // The boxes [begin, end) of one task.
  struct Task {
    size_t index, begin, end;
  };

  size_t find_in_spaces(const BoundsView& bounds, const PairFilter& filter, size_t most_pairs,
                        Parallelism parallelism, std::vector<Pair>& out);

  template <class Visit>
  void for_each_word(const Task& task, const Visit& visit);
  void find_hits(const BoundsView& bounds, const Task& task);
  void filter_hits(const PairFilter& filter, const Task& task);
  void count_hits(const Task& task);
  void list_hits(const Task& task);

  std::span<const WorldHalfspace> halfspaces_;
  size_t tasks_ = 0;
  size_t words_ = 0;            // words of 64 bits a half-space
  std::vector<uint64_t> hits_;  // one bit a box
  // The number of pairs of each task, and later the place of its first pair: for pairs in which the
  // box comes first, one entry a task; for pairs in which the half-space does, one a half-space and
  // task.
  std::vector<size_t> box_first_, halfspace_first_;
  std::vector<Pair> box_pairs_, halfspace_pairs_;
  // Used if there are half-spaces in many spaces.
  SpaceOrder spaces_;
  FoundPairs found_;
  PairSorter sorter_;
  Scratch scratch_;
};

}  // namespace carom

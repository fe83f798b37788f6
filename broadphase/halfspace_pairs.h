// Half-spaces have no bounds: they meet every box that reaches into them.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "carom/base/parallelism.h"
#include "carom/broadphase/find_pairs.h"
#include "carom/results/pair.h"
#include "carom/shapes/views.h"

namespace carom {

// A half-space in world coordinates: all x with normal . x <= limit. The normal is as long as
// quaternion and normal of the body make it, and the limit is rounded upwards.
struct WorldHalfspace {
  uint32_t body;
  std::array<double, 3> normal;
  double limit;
  double slack;  // |x| + |y| + |z| times this is more than what normal . x may be off by
};

// Of a valid half-space of the view.
WorldHalfspace world_halfspace(const Collidables& bodies, uint32_t body);

// False only if the point is certainly outside, however much the plane and this were rounded. An
// overflow gives infinities and then NaN, which is certain of nothing.
inline bool may_hold(const WorldHalfspace& halfspace, double x, double y, double z) {
  const auto& n = halfspace.normal;
  const double height = (n[0] * x + n[1] * y) + n[2] * z;
  const double error = halfspace.slack * ((std::abs(x) + std::abs(y)) + std::abs(z));
  return !(height - error > halfspace.limit);
}

// Keeps its working memory from call to call.
class HalfspaceSearch {
 public:
  // Replaces `out` by the sorted pairs of half-spaces and boxes of which one corner may lie in the
  // half-space, and which the filter lets through. Half-spaces ascend by body. Boxes that are empty
  // or hold a NaN meet nothing; those of the half-spaces themselves must be. Returns how many pairs
  // there are; if there are more than `most_pairs`, none are written.
  size_t find(std::span<const WorldHalfspace> halfspaces, const BoundsView& bounds,
              const PairFilter& filter, size_t most_pairs, Parallelism parallelism,
              std::vector<Pair>& out);

  size_t bytes() const;

 private:
  // Boxes [begin, end), those of one task.
  struct Task {
    size_t index, begin, end;
  };

  template <class Visit>
  void for_each_word(const Task& task, const Visit& visit);
  void find_hits(const BoundsView& bounds, const Task& task);
  void filter_hits(const PairFilter& filter, const Task& task);
  void count_hits(const Task& task);
  void list_hits(const Task& task);

  std::span<const WorldHalfspace> halfspaces_;
  size_t tasks_ = 0;
  size_t words_ = 0;            // of 64 boxes
  std::vector<uint64_t> hits_;  // one bit a box, `words_` a half-space
  // How many pairs each task has, then where they begin: those in which the box comes first, and
  // those in which a half-space does, one a half-space and task.
  std::vector<size_t> box_first_, halfspace_first_;
  std::vector<Pair> box_pairs_, halfspace_pairs_;
};

}  // namespace carom

#include "world/halfspace_stage.h"

#include <algorithm>
#include <limits>

#include "broadphase/merge_pairs.h"
#include "kernel/body_reader.h"
#include "world/columns.h"

namespace carom {

void HalfspaceStage::set_aside(const BodyStore& bodies, std::array<std::vector<float>, 6>& bounds) {
  halfspaces_.clear();
  if (bodies.halfspaces().empty()) return drop_all();
  const Collidables view = bodies.view();
  for (const uint32_t index : bodies.halfspaces()) {
    if (bounds[0][index] > bounds[3][index]) continue;
    halfspaces_.push_back(world_halfspace(view, index));
    for (size_t axis = 0; axis < 3; ++axis) {
      bounds[axis][index] = std::numeric_limits<float>::infinity();
      bounds[3 + axis][index] = -std::numeric_limits<float>::infinity();
    }
  }
}

void HalfspaceStage::drop_all() {
  if (bytes() == 0) return;
  halfspaces_ = {};
  search_.reset();
  other_pairs_ = {};
  own_pairs_ = {};
}

void HalfspaceStage::add_pairs(const BoundsView& bounds, const PairFilter& filter,
                               size_t most_pairs, Parallelism parallelism, std::vector<Pair>& pairs,
                               PairSearch& search) {
  if (!search_) search_.emplace();
  search.pairs += search_->find(halfspaces_, bounds, filter, most_pairs, parallelism, own_pairs_);
  search.complete = search.complete && search.pairs <= most_pairs;
  if (search.complete) {
    merge_pairs(other_pairs_, own_pairs_, parallelism, pairs);
  } else {
    pairs.clear();
  }
}

void HalfspaceStage::add_point_candidates(const float* xyz, size_t count, size_t stride,
                                          std::vector<Pair>& candidates) const {
  if (halfspaces_.empty()) return;
  const auto middle = static_cast<ptrdiff_t>(candidates.size());
  for (size_t i = 0; i < count; ++i) {
    const auto p = load_strided<Position<float>>(xyz, stride, i);
    for (const WorldHalfspace& halfspace : halfspaces_) {
      if (!may_hold(halfspace, p.x, p.y, p.z)) continue;
      candidates.push_back({static_cast<uint32_t>(i), halfspace.body});
    }
  }
  std::inplace_merge(candidates.begin(), candidates.begin() + middle, candidates.end());
}

void HalfspaceStage::give_back_beyond(size_t pairs) {
  give_back_scratch(other_pairs_, pairs);
  give_back_scratch(own_pairs_, pairs);
}

size_t HalfspaceStage::bytes() const {
  return bytes_of(halfspaces_) + (search_ ? search_->bytes() : 0) + bytes_of(other_pairs_) +
         bytes_of(own_pairs_);
}

}  // namespace carom

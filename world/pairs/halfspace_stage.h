// The half-spaces of a world, which the broadphase proper does not see.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "broadphase/halfspace_pairs.h"
#include "carom/broadphase/find_pairs.h"
#include "world/motion/sweeps.h"
#include "world/store/body_store.h"

namespace carom {

class HalfspaceStage {
 public:
  // Remembers the valid half-spaces, those whose bounds are not empty, and empties the bounds.
  void set_aside(const BodyStore& bodies, std::array<std::vector<float>, 6>& bounds);

  bool has_any() const { return !halfspaces_.empty(); }
  std::span<const WorldHalfspace> all() const { return halfspaces_; }  // by body index

  // For a step that looks ahead: pairs are those that half-spaces and bodies may make on their way.
  void sweep(const Sweeps& sweeps);
  void stay();  // for one that does not

  // Whether a box, that of `other`, reaches into the valid half-space of `body`, as they are now.
  bool reaches(uint32_t body, const BoundsView& bounds, uint32_t other) const;

  // Where the pairs of all other bodies go to, if there are half-spaces.
  std::vector<Pair>& other_pairs() { return other_pairs_; }

  // Replaces `pairs` by those and the pairs of half-spaces, sorted, and counts them in `search`. If
  // there are more than `most_pairs` altogether, the search is incomplete, and there are none.
  void add_pairs(const BoundsView& bounds, const PairFilter& filter, size_t most_pairs,
                 Parallelism parallelism, std::vector<Pair>& pairs, PairSearch& search);

  // Adds to the sorted candidates (point, body) those of half-spaces.
  void add_point_candidates(const float* xyz, size_t count, size_t stride,
                            std::vector<Pair>& candidates) const;

  void give_back_beyond(size_t pairs);
  size_t bytes() const;

 private:
  void drop_all();

  std::vector<WorldHalfspace> halfspaces_;  // by body index
  std::vector<WorldHalfspace> swept_;       // what each covers on its way; empty if they stay
  std::optional<HalfspaceSearch> search_;   // made on first use
  std::vector<Pair> other_pairs_, own_pairs_;
};

}  // namespace carom

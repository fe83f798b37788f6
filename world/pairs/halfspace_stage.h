// The half-spaces of a world, which the broadphase itself does not see.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "base/raw_vector.h"
#include "broadphase/halfspace_pairs.h"
#include "carom/broadphase/find_pairs.h"
#include "world/motion/contact_distances.h"
#include "world/motion/sweeps.h"
#include "world/store/body_store.h"

namespace carom {

class HalfspaceStage {
 public:
  // Remembers the valid half-spaces, which are those with bounds that are not empty, and empties
  // these bounds.
  void set_aside(const BodyStore& bodies, std::array<LargeVector<float>, 6>& bounds);

  bool has_any() const { return !halfspaces_.empty(); }
  std::span<const WorldHalfspace> all() const { return halfspaces_; }  // by body index

  // For a step that looks ahead: half-spaces then pair with all that they may reach during the
  // interval.
  void sweep(const Sweeps& sweeps);
  void stay();  // for a step that does not look ahead
  // After that: half-spaces pair with all that may be within the distance of a pair of them and a
  // body, whose bounds have grown (ContactDistances).
  void widen(const ContactDistances& distances);

  // Whether the box of `other` reaches into the valid half-space of `body`, at present, or is at
  // most `growth` outside.
  bool reaches(uint32_t body, const BoundsView& bounds, uint32_t other, float growth) const;

  // Where the broadphase writes the pairs of all other bodies, if there are half-spaces.
  std::vector<Pair>& other_pairs() { return other_pairs_; }

  // Replaces `pairs` by other_pairs() and the pairs of half-spaces, sorted, and counts them in
  // `search`. If there are more than `most_pairs` in all, the search is incomplete and `pairs`
  // empty.
  void add_pairs(const BoundsView& bounds, const PairFilter& filter, size_t most_pairs,
                 Parallelism parallelism, std::vector<Pair>& pairs, PairSearch& search);

  // Adds the candidates (point, half-space) to the sorted candidates (point, body).
  void add_point_candidates(const float* xyz, size_t count, size_t stride,
                            std::vector<Pair>& candidates) const;

  void give_back();
  size_t bytes() const;

 private:
  std::vector<WorldHalfspace> halfspaces_;  // by body index
  // what each covers during the interval, with its growth; empty if that is what it is now
  std::vector<WorldHalfspace> swept_;
  std::optional<HalfspaceSearch> search_;  // created on first use
  std::vector<Pair> other_pairs_, own_pairs_;
};

}  // namespace carom

// Temporal coherence: sorts boxes that rest into cells once and keeps their pairs, so that a search
// runs only for the boxes that moved.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/grid/cell_rows.h"
#include "broadphase/resting/box_memory.h"
#include "broadphase/sort/pair_list.h"
#include "broadphase/sort/sort_pairs.h"

namespace carom {

class RestingBoxes {
 public:
  // Working memory shared with other searches, and their limits.
  struct Workspace {
    CellRows& moving;
    FoundPairs& found;
    PairSorter& sorter;
    Scratch& scratch;
    size_t most_pairs;
    double most_crowded;  // limit for CellRows::crowding()
    PairOrder order;      // of all pairs; once it changes, the boxes must be forgotten
  };

  enum class Outcome {
    found,     // `out` holds all pairs
    too_many,  // there are more pairs than wanted; all is forgotten
    restless,  // so many boxes moved that a search from scratch costs less
    crowded,   // cells would hold too many boxes; all is forgotten
  };

  bool is_empty() const { return !holds_any_; }

  // Takes all boxes as resting from now on, and finds their pairs.
  Outcome settle(const BoundsView& bounds, const PairFilter& filter, Parallelism parallelism,
                 Workspace work, std::vector<Pair>& out);

  // Finds the pairs after some boxes have moved, appeared or vanished. `listed`: those that may
  // have, ascending; nullptr: any.
  Outcome update(const BoundsView& bounds, const PairFilter& filter,
                 const std::span<const uint32_t>* listed, Parallelism parallelism, Workspace work,
                 std::vector<Pair>& out);

  void forget();

  size_t pairs() const { return pair_count_; }        // pairs of the last search, even if too many
  size_t changed() const { return changed_.size(); }  // boxes that differed in the last update
  size_t grids() const { return rows_.grids().count; }
  size_t searched() const { return searched_; }  // boxes whose pairs the last search found
  size_t bytes() const;

 private:
  static constexpr uint32_t kNoRow = 0xffffffffu;

  Outcome settle_rest(const BoundsView& bounds, const PairFilter& filter, Parallelism parallelism,
                      Workspace work);
  static void list_found(size_t bodies, Parallelism parallelism, Workspace work,
                         std::vector<Pair>& out);
  void wake(size_t count_before);
  void drop_pairs_of_moving();
  Outcome find_pairs_of_moving(const BoundsView& bounds, const PairFilter& filter,
                               Parallelism parallelism, Workspace work, std::vector<Pair>& out);

  bool holds_any_ = false;
  BoxMemory memory_;
  CellRows rows_;                   // the resting boxes
  std::vector<uint32_t> row_of_;    // of each body; kNoRow: it moves, or takes no part
  std::vector<uint8_t> is_moving_;  // of each body
  std::vector<uint32_t> moving_;    // ascending
  std::vector<Pair> pairs_;         // among resting boxes, in the order that is wanted
  std::vector<Pair> moving_pairs_;  // all others
  std::vector<uint32_t> changed_, resting_, merged_;
  size_t pair_count_ = 0;
  size_t searched_ = 0;
  size_t idle_ = 0;  // searches for boxes that rested, since the last settlement
};

}  // namespace carom

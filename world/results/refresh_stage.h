// Renews the results of a few pairs in place, where the list of pairs is that of the last step.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/block_lists.h"
#include "base/raw_vector.h"
#include "carom/results/event.h"
#include "world/changes/drift.h"
#include "world/pairs/gap_stage.h"
#include "world/pairs/pair_history.h"
#include "world/results/list_moves.h"
#include "world/results/result_buffer.h"
#include "world/store/body_store.h"

namespace carom {

class RefreshStage {
 public:
  struct Input {
    const ResultBuffer& results;
    const GapStage& gaps;
    const BodyStore& bodies;
    const Drift& drift;
    Detail detail;
    bool identities;
    Parallelism parallelism;
  };

  // Begins a step that renews nothing.
  void clear() { pairs_.clear(); }
  // Begins a step that renews the results of these pairs (indices, ascending).
  void start(std::span<const uint32_t> due, const PairHistory& now, Parallelism parallelism);
  size_t renewed() const { return pairs_.size(); }
  // The pairs themselves, which the rows of the results belong to.
  std::span<const Pair> pairs() const { return pairs_; }
  // Takes the results of a range of rows. Contacts that were there are overwritten; what begins or
  // ends waits for finish().
  void take(const PairRange& range, const Input& input, PairHistory& now);
  // Adds the contacts of pairs that have begun to touch, and drops those of others. Returns by how
  // many there are now more overlaps.
  ptrdiff_t finish(const Input& input, PairHistory& now);
  // Adds the begins and ends to events of other pairs.
  void add_events(const BodyStore& bodies, const PairHistory& now, RawVector<Event>& events);

  void give_back();
  size_t bytes() const;

 private:
  // A pair whose decision, or whether it has a contact, differs from before.
  struct Change {
    uint32_t pair;
    uint32_t contact;  // PairHistory::contact; any place for a new one
    uint8_t overlap, overlap_before;
    Contact new_contact;
    ManifoldPoints new_points;
    PointNames new_names;
  };

  void take_rows(size_t begin, size_t end, const Input& input, std::vector<Change>& changes,
                 PairHistory& now) const;
  void move_contacts(const Input& input, PairHistory& now);

  std::span<const uint32_t> due_;
  std::vector<Pair> pairs_;
  BlockLists<Change> changes_of_block_;
  std::vector<Change> changes_, found_;
  std::vector<ListMove> moves_;
  RawVector<Event> own_events_, others_;
};

}  // namespace carom

// The overlaps of two steps -> begin and end events, and persist events if asked for.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/block_lists.h"
#include "base/raw_vector.h"
#include "carom/base/parallelism.h"
#include "carom/results/event.h"
#include "carom/results/impact.h"
#include "world/pairs/pair_history.h"
#include "world/store/body_store.h"
#include "world/store/columns.h"

namespace carom {

class EventStage {
 public:
  struct Input {
    const PairHistory& last;  // may be `now` itself if nothing changed: every overlap then persists
    const PairHistory& now;
    const BodyStore& bodies;
    std::span<const BodyId> quarantined;  // by index
    bool wants_persist;
  };
  void run(const Input& input, Parallelism parallelism, RawVector<Event>& events);

  // Adds one event for each impact, in their order.
  static void add_impacts(std::span<const Impact> impacts, const BodyStore& bodies,
                          RawVector<Event>& events);

  // Remembers the generations of all bodies. The next step needs them to name the bodies of
  // overlaps that ended.
  void remember(const BodyStore& bodies);

  void give_back() {
    carom::give_back(generation_);
    give_back_scratch(lists_);
  }
  size_t bytes() const { return lists_.bytes() + generation_.capacity() * sizeof(uint32_t); }

 private:
  BodyId last_id(uint32_t index) const { return {index, generation_[index]}; }
  bool is_same_body(uint32_t index, const BodyStore& bodies) const {
    return index < generation_.size() && last_id(index) == bodies.id_of(index);
  }
  // A pair with an event. `pair` is a place in the last step for ends, else in this one.
  struct Change {
    uint32_t pair;
    EventKind kind;
  };

  void find_changes(const Input& input, Parallelism parallelism);
  void make_events(std::span<const Change> changes, const Input& input, Event* events) const;

  BlockLists<Change> lists_;
  std::vector<uint32_t> generation_;  // of the last step
};

}  // namespace carom

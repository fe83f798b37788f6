// The overlaps of two steps -> begin, persist and end events.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/block_lists.h"
#include "carom/base/parallelism.h"
#include "carom/results/event.h"
#include "carom/results/impact.h"
#include "world/pairs/pair_history.h"
#include "world/store/body_store.h"
#include "world/store/columns.h"

namespace carom {

class EventStage {
 public:
  // `last` may be `now` itself if nothing changed: every overlap then persists.
  void run(const PairHistory& last, const PairHistory& now, const BodyStore& bodies,
           Parallelism parallelism, std::vector<Event>& events);

  // Adds one event for each impact, in their order.
  static void add_impacts(std::span<const Impact> impacts, const BodyStore& bodies,
                          std::vector<Event>& events);

  // Remembers the generations of all bodies. The next step needs them to name the bodies of
  // overlaps that ended.
  void remember(const BodyStore& bodies);

  void give_back_beyond(size_t pairs) { give_back(lists_, pairs); }
  size_t bytes() const { return lists_.bytes() + generation_.capacity() * sizeof(uint32_t); }

 private:
  BodyId last_id(uint32_t index) const { return {index, generation_[index]}; }

  BlockLists<Event> lists_;
  std::vector<uint32_t> generation_;  // of the last step
};

}  // namespace carom

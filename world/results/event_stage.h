// The overlaps of two steps -> begin and end events, and persist events if asked for.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/raw_vector.h"
#include "carom/base/parallelism.h"
#include "carom/results/event.h"
#include "carom/results/impact.h"
#include "world/pairs/carry_plan.h"
#include "world/pairs/pair_history.h"
#include "world/results/overlap_merge.h"
#include "world/store/body_store.h"
#include "world/store/columns.h"

namespace carom {

class EventStage {
 public:
  struct Input {
    const PairHistory& last;  // may be `now` itself if nothing changed: every overlap then persists
    const PairHistory& now;
    const CarryPlan* plan;  // how `now` follows from `last`; nullptr if they are the same
    const BodyStore& bodies;
    std::span<const BodyId> quarantined;  // by index
    bool wants_persist;
    bool skips_carried = false;  // their events are found elsewhere
  };
  void run(const Input& input, Parallelism parallelism, RawVector<Event>& events);

  // Adds one event for each impact, in their order.
  static void add_impacts(std::span<const Impact> impacts, const BodyStore& bodies,
                          RawVector<Event>& events);

  // Remembers the generations of all bodies. The next step needs them to name the bodies of
  // overlaps that ended.
  void remember(const BodyStore& bodies);

  void give_back();
  size_t bytes() const;

 private:
  // Blocks whose events are found side by side.
  static constexpr size_t kBlocksAtOnce = 16;

  struct alignas(64) Scratch {
    Overlaps last, now;
    RawVector<Event> unnamed, events;

    void make_room();
    size_t bytes() const;
  };

  void add_blocks(const Input& input, size_t first, size_t end, Parallelism parallelism,
                  RawVector<Event>& events);
  void add_block(const Input& input, size_t block, Scratch& scratch,
                 RawVector<Event>& events) const;
  static void read_block(const Input& input, size_t block, Scratch& scratch);
  static void name(std::span<Event> events, std::span<const uint32_t> generations);
  void add_named(const Input& input, std::span<const Event> unnamed,
                 RawVector<Event>& events) const;
  uint32_t last_generation(uint32_t index) const {
    return generation_.empty() ? 0 : generation_[index];
  }

  std::array<Scratch, kBlocksAtOnce> scratch_;
  std::vector<uint32_t> generation_;  // of the last step; empty while no body was ever removed
};

}  // namespace carom

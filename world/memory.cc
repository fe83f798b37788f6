// What memory a world holds, and how it gives back what it does not need.
#include "world/world_state.h"

namespace carom {

WorldMemory World::State::memory() const {
  WorldMemory memory;
  memory.bodies = bodies.bytes() + excluded.bytes() + changes.bytes() + drift.bytes() +
                  sweeps.bytes() + bytes_of(bounds.quarantined());
  memory.bounds = bounds.bytes() + swept_bounds.bytes() + fat_bounds.bytes() + dops.record_bytes() +
                  outer.bytes() + query_index.bytes() + wide_bounds.bytes() +
                  wide_swept_bounds.bytes();
  memory.broadphase = finder.bytes() + selection.bytes() + halfspaces.bytes();
  memory.pairs_and_results = now.bytes() + last.bytes() + pair_changes.bytes() + plan.bytes() +
                             hold.bytes() + refresh.bytes() + gaps.bytes() + dops.pair_bytes() +
                             directions.bytes() + shells.bytes() + results.bytes() +
                             contact_stage.bytes() + sieve.bytes() + impacts.bytes() +
                             speculative.bytes() + event_stage.bytes() + bytes_of(events);
  return memory;
}

// What bodies and results need stays. Working memory goes, and so do the last step's pairs, which
// the next step would overwrite.
void World::State::give_back_memory() {
  bodies.give_back();
  excluded.give_back();
  changes.give_back();
  drift.give_back();
  hold.give_back();
  refresh.give_back();
  gaps.give_back();
  sweeps.give_back();
  give_back(events);
  bounds.give_back();
  swept_bounds.give_back();
  fat_bounds.give_back();
  wide_bounds.give_back();
  wide_swept_bounds.give_back();
  query_index.give_back();
  dops.give_back();
  outer.give_back();
  halfspaces.give_back();
  now.give_back();
  pair_changes.give_back();
  directions.give_back();
  shells.give_back();
  impacts.give_back();
  speculative.give_back();
  event_stage.give_back();
  contact_stage.give_back();
  give_back_scratch(last, plan, results, sieve, selection, finder);
}

}  // namespace carom

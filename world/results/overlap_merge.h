// The overlaps of two steps, merged into events.
#pragma once

#include <cstdint>

#include "base/raw_vector.h"
#include "carom/results/event.h"
#include "world/pairs/pair_history.h"

namespace carom {

// Some overlaps of a step, sorted by pair, and behind them one whose key is above all others.
struct Overlaps {
  RawVector<uint64_t> key;
  RawVector<uint64_t> tail;  // event_tail()
  size_t count = 0;

  void reserve(size_t pairs);
  void start(size_t pairs);
  // Adds those of pairs [begin, end). Undecided pairs have no events. `kind`: begin for this step,
  // end for the last one.
  void add(const PairHistory& history, size_t begin, size_t end, EventKind kind);
  void finish();
  size_t bytes() const;
};

// What becomes of overlaps of both steps: an event, none, or an end and a begin.
enum class Persisting : uint8_t { wanted, dropped, apart };

// Adds the events, sorted by pair, without the generations of their bodies.
void merge_overlaps(const Overlaps& last, const Overlaps& now, Persisting persisting,
                    RawVector<Event>& events);

}  // namespace carom

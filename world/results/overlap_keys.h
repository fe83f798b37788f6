// The pairs of a step that overlap.
#pragma once

#include <cstdint>
#include <span>

#include "carom/results/event.h"
#include "carom/results/pair.h"
#include "world/pairs/pair_history.h"

namespace carom {

// Lists write a whole vector behind their last number.
inline constexpr size_t kOverlapsBeyond = 16;

// In event_tail(): the overlap is with a sensor.
inline constexpr uint64_t kSensorInTail = uint64_t{1} << 40;

// The last eight bytes of the event of an overlap, as a number: contact, kind, sensor, zeros.
// `contact` is that of PairHistory, whose kNone is the kNoContact of events.
static_assert(PairHistory::kNone == kNoContact);
constexpr uint64_t event_tail(uint32_t contact, EventKind kind) {
  const bool sensor = contact == PairHistory::kSensor;
  const bool listed = !sensor && kind != EventKind::end;
  return (listed ? contact : kNoContact) | static_cast<uint64_t>(kind) << 32 |
         (sensor ? kSensorInTail : 0);
}

// Writes pair_key() and event_tail() of each pair whose overlap is 1, in their order, and returns
// how many there are. There must be room for all pairs and kOverlapsBeyond more.
size_t list_overlaps(std::span<const Pair> pairs, const uint8_t* overlap, const uint32_t* contact,
                     EventKind kind, uint64_t* keys, uint64_t* tails);

}  // namespace carom

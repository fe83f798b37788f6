// What changed between the last step and this one.
#pragma once

#include <cstdint>

#include "carom/shapes/body.h"

namespace carom {

enum class EventKind : uint8_t {
  begin,    // overlap now, did not before
  persist,  // overlap now and before
  end,      // overlapped before; do not now, or one of them was removed, replaced or quarantined
  impact,   // will meet within the interval ahead: World::impacts()
};

inline constexpr int kEventKindCount = 4;

inline constexpr uint32_t kNoContact = 0xffffffffu;

// Events are sorted by (a.index, b.index); where a body was replaced by another at the same index,
// the end of the old pair comes before the begin of the new one. Behind them all follow those of
// impacts, one each, in the order of World::impacts().
struct Event {
  BodyId a;  // the ids at the time of the overlap
  BodyId b;
  // Index into World::contacts(), of impacts into World::impacts(); kNoContact for ends, and for
  // overlaps with sensors or at detail overlap.
  uint32_t contact;
  EventKind kind;
  bool sensor;            // one of the two is a sensor
  uint16_t reserved = 0;  // zero, so that events compare and hash as bytes
};
static_assert(sizeof(Event) == 24);

}  // namespace carom

/// @file
/// Events: what changed between the last step and this one.
#pragma once

#include <cstdint>

#include "carom/shapes/body.h"

namespace carom {

/// What happened to a pair.
enum class EventKind : uint8_t {
  begin,    ///< overlaps now and did not before
  persist,  ///< overlaps now and did before; only with WorldSettings::persist_events
  end,      ///< overlapped before and does not now, or a body was removed, replaced or quarantined
  impact,   ///< will meet within the interval ahead: World::impacts()
};

/// How many kinds of events there are.
inline constexpr int kEventKindCount = 4;

/// Bits of Event::gone.
enum Gone : uint8_t {
  kRemovedA = 1,      ///< a was removed; another body may have its index
  kRemovedB = 2,      ///< b was removed; another body may have its index
  kQuarantinedA = 4,  ///< a still exists, but is not valid any more: World::quarantined()
  kQuarantinedB = 8,  ///< b still exists, but is not valid any more: World::quarantined()
};

/// The contact index of an event without contact.
inline constexpr uint32_t kNoContact = 0xffffffffu;

/// One event of a step. Events are sorted by (a.index, b.index); if a body was replaced by another
/// at the same index, the end of the old pair comes before the begin of the new one. The events of
/// impacts follow after all others, one each, in the order of World::impacts().
struct Event {
  BodyId a;  ///< the id of the first body at the time of the overlap
  BodyId b;  ///< the id of the second body at the time of the overlap
  /// Index of the pair's first contact in World::contacts(), for impacts into World::impacts();
  /// kNoContact for ends, and for overlaps with sensors or at Detail::overlap.
  uint32_t contact;
  EventKind kind;    ///< what happened
  bool sensor;       ///< one of the two is a sensor
  uint8_t gone = 0;  ///< of ends: bits of Gone; 0 if the bodies moved apart or a filter parts them
  uint8_t reserved = 0;  ///< zero, so that events compare and hash as bytes
};
static_assert(sizeof(Event) == 24);

}  // namespace carom

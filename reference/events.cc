// The overlaps of two frames -> begin, persist and end: a merge of two sorted lists.
#include "reference/events.h"

#include <utility>

namespace carom::reference {
namespace {

std::pair<uint32_t, uint32_t> place(const Event& event) { return {event.a.index, event.b.index}; }

bool same_bodies(const Event& x, const Event& y) { return x.a == y.a && x.b == y.b; }

Event with_kind(Event event, EventKind kind) {
  event.kind = kind;
  if (kind == EventKind::end) event.contact = kNoContact;
  return event;
}

}  // namespace

std::vector<Event> events(std::span<const Event> before, std::span<const Event> now) {
  std::vector<Event> merged;
  auto old = before.begin();
  // First end the overlaps that are gone, or that were between other bodies with the same indices.
  const auto end_up_to = [&](const Event& current) {
    for (; old != before.end() && place(*old) < place(current); ++old) {
      merged.push_back(with_kind(*old, EventKind::end));
    }
    if (old != before.end() && place(*old) == place(current) && !same_bodies(*old, current)) {
      merged.push_back(with_kind(*old++, EventKind::end));
    }
  };
  for (const Event& current : now) {
    end_up_to(current);
    const bool persists = old != before.end() && same_bodies(*old, current);
    if (persists) ++old;
    merged.push_back(with_kind(current, persists ? EventKind::persist : EventKind::begin));
  }
  for (; old != before.end(); ++old) merged.push_back(with_kind(*old, EventKind::end));
  return merged;
}

}  // namespace carom::reference

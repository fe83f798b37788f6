// The overlaps of two frames -> begin, persist and end: a merge of two sorted lists.
#include "reference/events.h"

#include <algorithm>
#include <utility>

namespace carom::reference {
namespace {

std::pair<uint32_t, uint32_t> place(const Event& event) { return {event.a.index, event.b.index}; }

bool same_bodies(const Event& x, const Event& y) { return x.a == y.a && x.b == y.b; }

Event with_kind(Event event, EventKind kind) {
  event.kind = kind;
  return event;
}

struct Census {
  std::span<const Body> bodies;
  std::span<const BodyId> quarantined;

  bool is_removed(BodyId id) const {
    return !std::binary_search(bodies.begin(), bodies.end(), Body{id, {}},
                               [](const Body& x, const Body& y) { return x.id < y.id; });
  }

  bool is_quarantined(BodyId id) const {
    return std::find(quarantined.begin(), quarantined.end(), id) != quarantined.end();
  }
};

Event end_of(Event overlap, const Census& census) {
  overlap.kind = EventKind::end;
  overlap.contact = kNoContact;
  if (census.is_removed(overlap.a)) overlap.gone |= kRemovedA;
  if (census.is_removed(overlap.b)) overlap.gone |= kRemovedB;
  if (census.is_quarantined(overlap.a)) overlap.gone |= kQuarantinedA;
  if (census.is_quarantined(overlap.b)) overlap.gone |= kQuarantinedB;
  return overlap;
}

}  // namespace

std::vector<Event> events(std::span<const Event> before, std::span<const Event> now,
                          std::span<const Body> bodies, std::span<const BodyId> quarantined) {
  const Census census = {bodies, quarantined};
  std::vector<Event> merged;
  auto old = before.begin();
  // First end the overlaps that are gone, or that were between other bodies with the same indices.
  const auto end_up_to = [&](const Event& current) {
    for (; old != before.end() && place(*old) < place(current); ++old) {
      merged.push_back(end_of(*old, census));
    }
    if (old != before.end() && place(*old) == place(current) && !same_bodies(*old, current)) {
      merged.push_back(end_of(*old++, census));
    }
  };
  for (const Event& current : now) {
    end_up_to(current);
    const bool persists = old != before.end() && same_bodies(*old, current);
    if (persists) ++old;
    merged.push_back(with_kind(current, persists ? EventKind::persist : EventKind::begin));
  }
  for (; old != before.end(); ++old) merged.push_back(end_of(*old, census));
  return merged;
}

}  // namespace carom::reference

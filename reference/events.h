// The overlaps of two frames -> begin, persist and end.
#pragma once

#include <span>
#include <vector>

#include "carom/reference/reference.h"
#include "carom/results/event.h"

namespace carom::reference {

// `before` and `now` are the overlaps of two frames, sorted by (a.index, b.index); their kinds are
// not read. `bodies` and `quarantined` are those of the present frame.
std::vector<Event> events(std::span<const Event> before, std::span<const Event> now,
                          std::span<const Body> bodies, std::span<const BodyId> quarantined);

}  // namespace carom::reference

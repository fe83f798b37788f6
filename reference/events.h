// The overlaps of two frames -> begin, persist and end.
#pragma once

#include <span>
#include <vector>

#include "carom/results/event.h"

namespace carom::reference {

// `before` and `now` are the overlaps of two frames, sorted by (a.index, b.index); their kinds are
// not read.
std::vector<Event> events(std::span<const Event> before, std::span<const Event> now);

}  // namespace carom::reference

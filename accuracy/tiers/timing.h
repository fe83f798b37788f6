// Times of passes that are compared with each other.
#pragma once

#include <functional>
#include <span>
#include <vector>

namespace carom::accuracy {

// The median seconds of each pass. They run in turns, so that a clock that drifts is the same for
// all of them; passes of microseconds run often enough for the clock to be read seldom.
std::vector<double> median_seconds(std::span<const std::function<void()>> passes, int rounds);

}  // namespace carom::accuracy

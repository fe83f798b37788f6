// Times passes that are compared with each other.
#pragma once

#include <functional>
#include <span>
#include <vector>

namespace carom::accuracy {

// The median seconds of each pass. The passes run in turns, so that a drift of the machine's speed
// affects all of them. Short passes run often enough that reading the clock costs little.
std::vector<double> median_seconds(std::span<const std::function<void()>> passes, int rounds);

}  // namespace carom::accuracy

// The time of queries.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <limits>

namespace carom::bench {

// Nanoseconds a query, of the fastest pass over all of them.
template <class Run>
double fastest_pass(size_t queries, int passes, const Run& run) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < passes; ++i) {
    const auto start = std::chrono::steady_clock::now();
    run();
    const auto duration = std::chrono::steady_clock::now() - start;
    least = std::min(least, std::chrono::duration<double, std::nano>(duration).count());
  }
  return least / static_cast<double>(queries);
}

}  // namespace carom::bench

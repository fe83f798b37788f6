#include "accuracy/tiers/timing.h"

#include <algorithm>
#include <chrono>
#include <cstddef>

namespace carom::accuracy {
namespace {

constexpr double kEnoughSeconds = 2e-3;
constexpr size_t kMostRepeats = 1000;

double seconds_of(const std::function<void()>& pass, size_t repeats) {
  const auto begin = std::chrono::steady_clock::now();
  for (size_t i = 0; i < repeats; ++i) pass();
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  return taken.count() / static_cast<double>(repeats);
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

std::vector<double> median_seconds(std::span<const std::function<void()>> passes, int rounds) {
  std::vector<std::vector<double>> seconds(passes.size());
  for (int round = 0; round < rounds; ++round) {
    for (size_t i = 0; i < passes.size(); ++i) {
      const double once = seconds_of(passes[i], 1);  // also warms the caches
      const auto repeats = static_cast<size_t>(kEnoughSeconds / std::max(once, 1e-9));
      seconds[i].push_back(seconds_of(passes[i], std::clamp<size_t>(repeats, 1, kMostRepeats)));
    }
  }
  std::vector<double> medians;
  for (std::vector<double>& each : seconds) medians.push_back(median(each));
  return medians;
}

}  // namespace carom::accuracy

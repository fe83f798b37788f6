#include "bench/support/measure.h"

#include <algorithm>

namespace carom::bench {
namespace {

bool failed = false;

}  // namespace

std::vector<Runner> all_runners() {
  std::vector<Runner> runners = {{std::nullopt}};
  for (const Isa isa : usable_isas()) runners.push_back({isa});
  return runners;
}

std::vector<Setup> all_setups() {
  std::vector<Setup> setups;
  for (const Isa isa : usable_isas()) setups.push_back({isa, 1});
  setups.push_back({usable_isas().back(), 2});
  return setups;
}

std::vector<Setup> strongest_setups() {
  const Isa strongest = usable_isas().back();
  return {{strongest, 1}, {strongest, 2}};
}

std::string short_count(size_t count) {
  if (count % 1'000'000 == 0) return std::to_string(count / 1'000'000) + "M";
  if (count % 1'000 == 0) return std::to_string(count / 1'000) + "k";
  return std::to_string(count);
}

void fail(benchmark::State& state, const std::string& message) {
  failed = true;
  state.SkipWithError(message.c_str());
}

bool use_isa(benchmark::State& state, Isa isa) {
  unforce_isa();
  const bool used = active_isa() == isa || (force_isa(isa) && active_isa() == isa);
  if (!used) fail(state, std::string(name(isa)) + " cannot be used");
  return used;
}

bool any_failed() { return failed; }

double PassTimes::median() const {
  std::vector<double> sorted = seconds_;
  const auto middle = sorted.begin() + static_cast<ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

void report(benchmark::State& state, const char* item, size_t items, const PassTimes& times,
            std::optional<double> reference_seconds) {
  const double seconds = times.median();
  state.counters[std::string("ns_per_") + item] = seconds * 1e9 / static_cast<double>(items);
  if (reference_seconds) state.counters["speedup"] = *reference_seconds / seconds;
}

}  // namespace carom::bench

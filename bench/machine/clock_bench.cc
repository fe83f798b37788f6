// The clock of this machine: clock/add/t1, in nanoseconds a cycle. docs/roofline.md counts
// instructions a cycle with it.
#include <cstdint>

#include "bench/support/measure.h"
#include "bench/support/suites.h"

namespace carom::bench {
namespace {

constexpr size_t kAdditions = size_t{1} << 20;

// Every addition waits for the last one, and takes one cycle. The compiler cannot join them,
// because it does not know what the empty instruction does to the sum. A loop as short as this can
// take more than a cycle by itself.
void add_in_turn(uint64_t step) {
  uint64_t sum = step;
#pragma GCC unroll 16
  for (size_t i = 0; i < kAdditions; ++i) {
    sum += step;
    asm volatile("" : "+r"(sum));
  }
}

void measure_clock(benchmark::State& state) {
  uint64_t step = 1;
  benchmark::DoNotOptimize(step);
  PassTimes times;
  for (auto _ : state) times.measure([&] { add_in_turn(step); });
  report(state, "cycle", kAdditions, times);
}

}  // namespace

void register_clock() {
  benchmark::RegisterBenchmark("clock/add/t1", measure_clock)->Unit(benchmark::kMillisecond);
}

}  // namespace carom::bench

// What the memory of this machine gives one thread: memory/WAY, in nanoseconds a line of 64 bytes.
// docs/frame.md compares the stages of a frame with it.
#include <cstring>
#include <vector>

#include "bench/support/measure.h"
#include "bench/support/suites.h"

namespace carom::bench {
namespace {

struct alignas(64) Line {
  uint64_t word[8];
};
using Lines = std::vector<Line>;

// Many times the last level of a cache.
constexpr size_t kLines = size_t{1} << 22;

void read(const Lines& lines, Lines&) {
  uint64_t sum[8] = {};
  for (const Line& line : lines) {
    for (size_t k = 0; k < 8; ++k) sum[k] += line.word[k];
  }
  benchmark::DoNotOptimize(sum);
}

void copy(const Lines& from, Lines& to) {
  std::memcpy(to.data(), from.data(), from.size() * sizeof(Line));
  benchmark::ClobberMemory();
}

// Every line once, each far from the last one; the next address does not wait for the line.
void gather(const Lines& lines, Lines&) {
  constexpr size_t kOdd = 2654435761;
  uint64_t sum = 0;
  for (size_t i = 0; i < lines.size(); ++i) sum += lines[i * kOdd % kLines].word[0];
  benchmark::DoNotOptimize(sum);
}

void measure_memory(benchmark::State& state, void (*way)(const Lines&, Lines&)) {
  const Lines from(kLines, Line{{1, 2, 3, 4, 5, 6, 7, 8}});
  Lines to(kLines);
  PassTimes times;
  for (auto _ : state) times.measure([&] { way(from, to); });
  report(state, "line", kLines, times);
}

}  // namespace

void register_memory() {
  const auto add = [](const char* name, auto way) {
    const auto run = [way](benchmark::State& state) { measure_memory(state, way); };
    benchmark::RegisterBenchmark(name, run)->Unit(benchmark::kMillisecond);
  };
  add("memory/read", read);
  add("memory/copy", copy);
  add("memory/gather", gather);
}

}  // namespace carom::bench

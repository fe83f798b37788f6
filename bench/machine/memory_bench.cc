// What the memory of this machine gives: memory/WAY/THREADS, in nanoseconds a line of 64 bytes.
// docs/frame.md compares the stages of a frame with it. cache/copy/t1 copies about as many bytes as
// a stream of pairs has, which stay in the last level of the caches: docs/roofline.md.
#include <cstring>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "bench/support/measure.h"
#include "bench/support/suites.h"
#include "carom/base/thread_arena.h"

namespace carom::bench {
namespace {

struct alignas(64) Line {
  uint64_t word[8];
};
using Lines = std::vector<Line>;

// Many times the last level of a cache, and 4 MiB.
constexpr size_t kLines = size_t{1} << 22, kLinesOfCache = size_t{1} << 16;

void read(const Lines& lines, Lines&, size_t begin, size_t end) {
  uint64_t sum[8] = {};
  for (size_t i = begin; i < end; ++i) {
    for (size_t k = 0; k < 8; ++k) sum[k] += lines[i].word[k];
  }
  benchmark::DoNotOptimize(sum);
}

void copy(const Lines& from, Lines& to, size_t begin, size_t end) {
  std::memcpy(to.data() + begin, from.data() + begin, (end - begin) * sizeof(Line));
  benchmark::ClobberMemory();
}

// Every line once, each far from the last one; the next address does not wait for the line.
void gather(const Lines& lines, Lines&, size_t begin, size_t end) {
  constexpr size_t kOdd = 2654435761;
  uint64_t sum = 0;
  for (size_t i = begin; i < end; ++i) sum += lines[i * kOdd % kLines].word[0];
  benchmark::DoNotOptimize(sum);
}

using Way = void (*)(const Lines& from, Lines& to, size_t begin, size_t end);

// A task of a thread takes an eighth of the lines.
void measure_memory(benchmark::State& state, Way way, size_t lines, int threads) {
  const Lines from(lines, Line{{1, 2, 3, 4, 5, 6, 7, 8}});
  Lines to(lines);
  ThreadArena arena(threads);
  PassTimes times;
  arena.run([&] {
    for (auto _ : state) {
      times.measure([&] {
        for_each_block(lines, lines / 8, arena.parallelism(),
                       [&](size_t, size_t begin, size_t end) { way(from, to, begin, end); });
      });
    }
  });
  report(state, "line", lines, times);
}

}  // namespace

void register_memory() {
  const auto add = [](const char* name, Way way, size_t lines, int threads) {
    const auto run = [=](benchmark::State& state) { measure_memory(state, way, lines, threads); };
    const std::string full_name = std::string(name) + "/t" + std::to_string(threads);
    benchmark::RegisterBenchmark(full_name.c_str(), run)->Unit(benchmark::kMillisecond);
  };
  for (const int threads : {1, 2}) {
    add("memory/read", read, kLines, threads);
    add("memory/copy", copy, kLines, threads);
    add("memory/gather", gather, kLines, threads);
  }
  add("cache/copy", copy, kLinesOfCache, 1);
}

}  // namespace carom::bench

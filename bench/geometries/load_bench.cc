// Making height fields of 4096 x 4096 cells: height_field_load/TYPE. s_per_gb: seconds for each
// gigabyte of heights; memory: of the field, times that of its heights.
#include <string>
#include <vector>

#include "bench/support/measure.h"
#include "bench/support/suites.h"
#include "carom/shapes/height_field_geometry.h"

namespace carom::bench {
namespace {

constexpr uint32_t kSamples = 4097;  // along a side
constexpr size_t kAll = size_t{kSamples} * kSamples;

template <class Height>
void measure_load(benchmark::State& state, HeightType type) {
  std::vector<Height> heights(kAll);
  for (size_t i = 0; i < kAll; ++i) heights[i] = static_cast<Height>(i * 7919 % 1000);
  const HeightGrid grid{.nx = kSamples,
                        .ny = kSamples,
                        .dx = 1,
                        .dy = 1,
                        .samples = {.data = heights.data(), .type = type}};
  PassTimes times;
  size_t bytes = 0;
  for (auto _ : state) {
    times.measure([&] {
      const auto field = make_height_field(grid);
      if (field) bytes = (*field)->bytes();
    });
  }
  if (bytes == 0) return fail(state, "no height field");
  const double given = kAll * sizeof(Height);
  state.counters["s_per_gb"] = times.median() / (given * 1e-9);
  state.counters["memory"] = static_cast<double>(bytes) / given;
}

}  // namespace

void register_loads() {
  benchmark::RegisterBenchmark("height_field_load/float32", [](benchmark::State& state) {
    measure_load<float>(state, HeightType::float32);
  })->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("height_field_load/int16", [](benchmark::State& state) {
    measure_load<int16_t>(state, HeightType::int16);
  })->Unit(benchmark::kMillisecond);
}

}  // namespace carom::bench

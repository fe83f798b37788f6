// Times of impact: NAME/toi/linear, NAME/toi/turning and, with contacts, NAME/impact/linear.
#include <string>

#include "bench/support/cached.h"
#include "bench/support/kind_pairs.h"
#include "bench/support/measure.h"
#include "bench/support/motion_stream.h"
#include "bench/support/suites.h"

namespace carom::bench {
namespace {

void measure_kernel(benchmark::State& state, const MotionStream& stream, bool contacts, Isa isa) {
  ImpactArrays results(stream.spec().count);
  if (!use_isa(state, isa)) return;
  (void)stream.run(results.columns());
  if (const auto wrong = stream.difference(results.columns())) return fail(state, *wrong);
  const ImpactColumns columns = contacts ? results.columns() : results.times_alone();
  PassTimes times;
  for (auto _ : state) {
    times.measure([&] { (void)stream.run(columns); });
    benchmark::ClobberMemory();
  }
  // The reference always finds contacts, so its time compares only with runs that do.
  const auto reference =
      contacts ? std::optional<double>(stream.reference_seconds()) : std::nullopt;
  report(state, "pair", stream.spec().count, times, reference);
}

void measure_reference(benchmark::State& state, const MotionStream& stream) {
  std::vector<reference::Impact> results;
  PassTimes times;
  for (auto _ : state) {
    times.measure([&] { stream.run_reference(results); });
    benchmark::ClobberMemory();
  }
  report(state, "pair", stream.spec().count, times, stream.reference_seconds());
}

void register_stream(const KindPair& kinds, const MotionSpec& spec, bool contacts) {
  const std::string title = std::string(kinds.name) + (contacts ? "/impact/" : "/toi/") +
                            (spec.turning ? "turning/" : "linear/");
  for (const Runner& runner : all_runners()) {
    if (!runner.isa && !contacts) continue;
    const auto body = [=](benchmark::State& state) {
      const auto& stream = cached<MotionStream>(spec);
      if (runner.isa) {
        measure_kernel(state, stream, contacts, *runner.isa);
      } else {
        measure_reference(state, stream);
      }
    };
    benchmark::RegisterBenchmark((title + runner.name()).c_str(), body)
        ->Unit(benchmark::kMicrosecond);
  }
}

}  // namespace

void register_impacts(const Options& options) {
  for (const KindPair& kinds : kind_pairs()) {
    const auto has = [&](ShapeKind kind) { return kinds.a == kind || kinds.b == kind; };
    if (has(ShapeKind::halfspace)) continue;
    const bool is_slow = has(ShapeKind::hull) || has(ShapeKind::dop);
    MotionSpec spec{.kind_a = kinds.a, .kind_b = kinds.b};
    spec.count = is_slow ? options.pairs / 32 : options.pairs / 4;
    register_stream(kinds, spec, false);
    register_stream(kinds, spec, true);
    spec.turning = true;
    spec.count = options.pairs / 32;
    register_stream(kinds, spec, true);
  }
}

}  // namespace carom::bench

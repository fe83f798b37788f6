// Every pair of kinds that has a kernel: NAME/DETAIL/STORAGE/hitPERCENT/ACCESS/RUNNER. In place of
// hitPERCENT, `touch`: all pairs touch to within rounding; `parallel`: boxes lie nearly parallel.
#include <algorithm>
#include <cmath>
#include <string>

#include "bench/support/cached.h"
#include "bench/support/kind_pairs.h"
#include "bench/support/measure.h"
#include "bench/support/mesh_stream.h"
#include "bench/support/pair_stream.h"
#include "bench/support/suites.h"

namespace carom::bench {
namespace {

// Also measured with float64 positions and other hit rates.
constexpr const char* kInDepth[] = {"sphere_sphere", "sphere_aabb", "aabb_aabb", "box_box"};

// Why the stream's hit rate is wrong or its results differ from the reference; nothing if all is
// well.
std::optional<std::string> problem(const PairStream& stream, Detail detail, ResultArrays& results) {
  const StreamSpec& spec = stream.spec();
  if (spec.placing == Placing::freely && std::abs(stream.hit_percent() - spec.hit_percent) > 2) {
    return "the hit rate is " + std::to_string(stream.hit_percent()) + " %";
  }
  spoil(results);
  if (const Result<void> done = stream.run(detail, results.columns()); !done) {
    return done.error().message;
  }
  return stream.difference(detail, results.columns());
}

// Passes per iteration: so many that reading the clock costs next to nothing, fewer for slow kinds.
size_t passes(const PairStream& stream) {
  constexpr size_t kPairs = 50'000;
  constexpr double kReferenceSeconds = 0.02;
  const auto enough = static_cast<size_t>(kReferenceSeconds / stream.reference_seconds());
  return std::max<size_t>(1, std::min(kPairs / stream.spec().count, enough));
}

template <class Pass>
void measure(benchmark::State& state, const PairStream& stream, const Pass& pass) {
  const size_t repeats = passes(stream);
  PassTimes times;
  for (auto _ : state) {
    times.measure([&] {
      for (size_t i = 0; i < repeats; ++i) pass();
    });
  }
  report(state, "pair", repeats * stream.spec().count, times,
         static_cast<double>(repeats) * stream.reference_seconds());
}

void measure_kernel(benchmark::State& state, const PairStream& stream, Detail detail, Isa isa) {
  ResultArrays results(stream.spec().count, Detail::manifold);
  if (!use_isa(state, isa)) return;
  if (const auto wrong = problem(stream, detail, results)) return fail(state, *wrong);
  measure(state, stream, [&] {
    benchmark::DoNotOptimize(stream.run(detail, results.columns()));
    benchmark::ClobberMemory();
  });
  state.counters["pairs"] = static_cast<double>(stream.spec().count);
  state.counters["bytes_per_pair"] = static_cast<double>(stream.bytes_per_pair(detail));
}

void measure_reference(benchmark::State& state, const PairStream& stream) {
  std::vector<reference::PairResult> results;
  measure(state, stream, [&] {
    stream.run_reference(results);
    benchmark::ClobberMemory();
  });
}

std::string share_of(const StreamSpec& spec) {
  if (spec.placing == Placing::touching) return "touch";
  if (spec.placing == Placing::parallel) return "parallel";
  return "hit" + std::to_string(spec.hit_percent);
}

// Registers a stream on every runner. `access` is part of the name.
void register_stream(const KindPair& kinds, const StreamSpec& spec, Detail detail,
                     const char* access) {
  const std::string stream_name = kinds.name + "/" + name(detail) + "/" + name(spec.storage) + "/" +
                                  share_of(spec) + "/" + access + "/";
  for (const Runner& runner : all_runners()) {
    const auto body = [spec, detail, runner](benchmark::State& state) {
      const auto& stream = cached<PairStream>(spec);
      if (runner.isa) {
        measure_kernel(state, stream, detail, *runner.isa);
      } else {
        measure_reference(state, stream);
      }
    };
    benchmark::RegisterBenchmark((stream_name + runner.name()).c_str(), body)
        ->Unit(benchmark::kMicrosecond);
  }
}

// Registers streams as rows and as a list of pairs, at every detail.
void register_streams(const KindPair& kinds, Storage storage, int hit_percent, size_t count) {
  for (const Access access : {Access::rows, Access::pairs}) {
    for (const Detail detail : {Detail::overlap, Detail::contact, Detail::manifold}) {
      register_stream(kinds,
                      {.kind_a = kinds.a,
                       .kind_b = kinds.b,
                       .storage = storage,
                       .hit_percent = hit_percent,
                       .access = access,
                       .count = count},
                      detail, access == Access::rows ? "rows" : "pairs");
    }
  }
}

// Fewer pairs for slow kinds: k-DOPs and hulls take long to draw. Those of k-DOPs, which have a
// geometry each, are still more than the caches hold.
size_t pair_count(const KindPair& kinds, const Options& options) {
  const auto has = [&](ShapeKind kind) {
    return core_kind(kinds.a) == kind || core_kind(kinds.b) == kind;
  };
  if (has(ShapeKind::dop)) return options.pairs / 5;
  return has(ShapeKind::hull) ? options.pairs / 4 : options.pairs;
}

// Registers hulls of 8 to 64 vertices, as rows only.
void register_hulls(const KindPair& kinds, size_t count) {
  for (const size_t vertices : {8, 16, 32, 64}) {
    const std::string title = kinds.name + ("_" + std::to_string(vertices));
    for (const Detail detail : {Detail::overlap, Detail::contact, Detail::manifold}) {
      register_stream({title.c_str(), kinds.a, kinds.b},
                      {.kind_a = kinds.a, .kind_b = kinds.b, .count = count, .vertices = vertices},
                      detail, "rows");
    }
  }
}

void register_in_depth(const KindPair& kinds, size_t count) {
  for (const Storage storage : {Storage::f32, Storage::f64}) {
    for (const int hit_percent : {10, 50, 90}) {
      register_streams(kinds, storage, hit_percent, count);
    }
  }
}

// Pairs of which float32 cannot decide many, as rows.
void register_placed(const KindPair& kinds, Placing placing, size_t count) {
  for (const Detail detail : {Detail::overlap, Detail::contact, Detail::manifold}) {
    register_stream(kinds,
                    {.kind_a = kinds.a, .kind_b = kinds.b, .placing = placing, .count = count},
                    detail, "rows");
  }
}

// Boxes in world coordinates, so few that inputs and results stay in L2. This shows the speed of
// the kernel alone.
void register_in_l2(const KindPair& kinds) {
  constexpr size_t kPairs = 4096;
  for (const int hit_percent : {10, 50, 90}) {
    register_stream(kinds,
                    {.kind_a = kinds.a,
                     .kind_b = kinds.b,
                     .storage = Storage::world,
                     .hit_percent = hit_percent,
                     .count = kPairs},
                    Detail::overlap, "l2");
  }
}

void measure_on_terrain(benchmark::State& state, const MeshSpec& spec, Detail detail, Isa isa) {
  const auto& stream = cached<MeshStream>(spec);
  if (!use_isa(state, isa)) return;
  ResultArrays results(spec.count, Detail::manifold);
  spoil(results);
  if (const Result<void> done = stream.run(detail, results.columns()); !done) {
    return fail(state, done.error().message);
  }
  if (const auto wrong = stream.difference(detail, results.columns())) return fail(state, *wrong);
  PassTimes times;
  for (auto _ : state) {
    times.measure([&] { (void)stream.run(detail, results.columns()); });
    benchmark::ClobberMemory();
  }
  report(state, "pair", spec.count, times, stream.reference_seconds());
}

// Bodies on a terrain of 10,000 triangles.
void register_terrain(size_t count, bool is_field) {
  const std::string ground = is_field ? "_height_field/" : "_mesh/";
  for (const ShapeKind kind :
       {ShapeKind::sphere, ShapeKind::capsule, ShapeKind::box, ShapeKind::hull}) {
    for (const Detail detail : {Detail::overlap, Detail::contact, Detail::manifold}) {
      for (const Isa isa : usable_isas()) {
        const std::string title =
            std::string(name(kind)) + ground + name(detail) + "/f32/hit50/rows/" + name(isa);
        const MeshSpec spec{.kind = kind, .count = count, .is_field = is_field};
        benchmark::RegisterBenchmark(title.c_str(), [=](benchmark::State& state) {
          measure_on_terrain(state, spec, detail, isa);
        })->Unit(benchmark::kMicrosecond);
      }
    }
  }
}

}  // namespace

void register_narrowphase(const Options& options) {
  for (const KindPair& kinds : kind_pairs()) {
    if (std::count(std::begin(kInDepth), std::end(kInDepth), kinds.name) > 0) {
      register_in_depth(kinds, options.pairs);
    } else if (kinds.a == ShapeKind::hull && kinds.b == ShapeKind::hull) {
      register_hulls(kinds, options.pairs);
    } else {
      register_streams(kinds, Storage::f32, 50, pair_count(kinds, options));
    }
    if (kinds.a == ShapeKind::aabb && kinds.b == ShapeKind::aabb) register_in_l2(kinds);
    register_placed(kinds, Placing::touching, pair_count(kinds, options) / 4);
    if (kinds.a == ShapeKind::box && kinds.b == ShapeKind::box) {
      register_placed(kinds, Placing::parallel, options.pairs);
    }
  }
  for (const bool is_field : {false, true}) register_terrain(options.pairs / 10, is_field);
}

}  // namespace carom::bench

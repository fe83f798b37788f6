// Finding the pairs of a frame: find_pairs/SCENE/METHOD/cold or warm/THREADS/ISA. Cold: starts
// without the last frame. Warm: repairs the order of the last frame or keeps its resting pairs.
#include "carom/broadphase/find_pairs.h"

#include <optional>

#include "bench/support/bounds_arrays.h"
#include "bench/support/cached.h"
#include "bench/support/frames.h"
#include "bench/support/measure.h"
#include "bench/support/suites.h"
#include "carom/base/thread_arena.h"
#include "reference/pairs.h"

namespace carom::bench {
namespace {

constexpr size_t kMostForReference = 10'000;
constexpr size_t kMostForBruteForce = 10'000;  // most bodies to measure it with
constexpr size_t kMostForBruteForceOnce = 100'000;
constexpr size_t kMostForSweep = 100'000;

reference::Box box_at(const BoundsView& bounds, size_t i) {
  return {{bounds.lower[0][i], bounds.lower[1][i], bounds.lower[2][i]},
          {bounds.upper[0][i], bounds.upper[1][i], bounds.upper[2][i]}};
}

// The bounds of a scene, and the pairs of its second frame.
class BoundsFrames {
 public:
  explicit BoundsFrames(const SceneSpec& spec) {
    const Frames frames(spec);
    for (size_t i = 0; i < Frames::kCount; ++i) {
      const std::vector<PlacedShape> bodies = frames.bodies(i);
      const DenseBodies arrays(spec.kind, bodies, Storage::f32);
      compute_bounds(arrays.view(), bounds_.emplace_back(spec.bodies).columns());
    }
    if (spec.bodies <= kMostForReference) {
      run_reference();
    } else {
      run_kernel();
    }
  }

  BoundsView bounds(size_t frame) const { return bounds_[frame].view(); }
  const std::vector<Pair>& expected() const { return expected_; }
  std::optional<double> reference_seconds() const { return reference_seconds_; }

 private:
  void run_reference() {
    const BoundsView view = bounds(1);
    std::vector<reference::Box> boxes;
    for (size_t i = 0; i < view.count; ++i) boxes.push_back(box_at(view, i));
    PassTimes times;
    for (int pass = 0; pass < 3; ++pass) {
      times.measure([&] { expected_ = reference::overlapping_pairs(boxes); });
    }
    reference_seconds_ = times.median();
  }

  // Expected pairs of scenes too large for the reference come from a kernel that the smaller scenes
  // compared with the reference: brute force on the strongest ISA, or for even more bodies the
  // sweep on the weakest.
  void run_kernel() {
    const bool brute = bounds(1).count <= kMostForBruteForceOnce;
    force_isa(brute ? usable_isas().back() : usable_isas().front());
    PairFinder().find(bounds(1), {}, expected_,
                      brute ? BroadphaseMethod::brute : BroadphaseMethod::sweep);
  }

  std::vector<BoundsArrays> bounds_;
  std::vector<Pair> expected_;
  std::optional<double> reference_seconds_;
};

struct Case {
  SceneSpec scene;
  BroadphaseMethod method;
  bool warm;
  Setup setup;

  std::string name() const {
    return "find_pairs/" + scene.name() + "/" + carom::name(method) + (warm ? "/warm/" : "/cold/") +
           setup.name();
  }
};

void measure(benchmark::State& state, const Case& c) {
  const auto& frames = cached<BoundsFrames>(c.scene);
  ThreadArena arena(c.setup.threads);
  if (!use_isa(state, c.setup.isa)) return;
  PairFinder finder;
  std::vector<Pair> pairs;
  const auto find = [&](size_t frame) {
    if (!c.warm) finder.forget();
    finder.find(frames.bounds(frame), {}, pairs, c.method, arena.parallelism());
  };
  arena.run([&] {
    find(0);
    find(1);
    if (pairs != frames.expected()) return fail(state, "not the pairs of the reference");
    find(0);
    FrameCycle cycle(Frames::kCount);
    PassTimes times;
    for (auto _ : state) {
      const size_t frame = cycle.next();
      times.measure([&] { find(frame); });
    }
    report(state, "body", c.scene.bodies, times, frames.reference_seconds());
  });
  const auto bodies = static_cast<double>(c.scene.bodies);
  state.counters["pairs"] = static_cast<double>(frames.expected().size());
  state.counters["bytes_per_body"] = static_cast<double>(finder.bytes()) / bodies;
}

void add(const Case& c) {
  benchmark::RegisterBenchmark(c.name().c_str(), [c](benchmark::State& state) {
    measure(state, c);
  })->Unit(benchmark::kMillisecond);
}

// Every method, cold and warm, on every ISA.
void register_in_full(const SceneSpec& scene) {
  for (const Setup& setup : all_setups()) {
    if (scene.bodies <= kMostForBruteForce) add({scene, BroadphaseMethod::brute, false, setup});
    if (scene.bodies <= kMostForSweep) add({scene, BroadphaseMethod::sweep, true, setup});
    for (const bool warm : {false, true}) add({scene, BroadphaseMethod::grid, warm, setup});
  }
}

}  // namespace

void register_find_pairs(const Options& options) {
  for (const size_t bodies : scene_sizes(options.max_bodies)) {
    register_in_full({"brownian", bodies});
    for (const char* generator : {"varied", "static", "still"}) {
      for (const Setup& setup : strongest_setups()) {
        add({{generator, bodies}, BroadphaseMethod::grid, true, setup});
      }
    }
  }
}

}  // namespace carom::bench

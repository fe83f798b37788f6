// Whole frames of spheres, from positions to contacts and events: world/SCENE/DETAIL/THREADS/ISA.
// The time is that of World::step(); counters tell the mean milliseconds of its stages.
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "bench/support/cached.h"
#include "bench/support/frames.h"
#include "bench/support/measure.h"
#include "bench/support/suites.h"
#include "carom/base/thread_arena.h"
#include "carom/reference/reference.h"
#include "carom/world/world.h"

namespace carom::bench {
namespace {

constexpr size_t kSmallest = 10'000;
constexpr size_t kMostForReference = 10'000;

std::vector<reference::Body> reference_bodies(const Frames& frames, size_t frame) {
  std::vector<reference::Body> bodies;
  for (const PlacedShape& placed : frames.bodies(frame)) {
    const auto index = static_cast<uint32_t>(bodies.size());
    bodies.push_back({{index, 0}, {.shape = placed.shape, .position = placed.position}});
  }
  return bodies;
}

// A scene, and the reference's results of its first two frames unless that takes too long.
struct WorldScene {
  explicit WorldScene(const SceneSpec& spec) : frames(spec) {
    if (spec.bodies > kMostForReference) return;
    for (size_t i = 0; i < 2; ++i) {
      expected.push_back(reference::step(reference_bodies(frames, i), PositionType::float32,
                                         Detail::contact, false, i ? &expected[0] : nullptr));
      std::erase_if(expected.back().events,
                    [](const Event& event) { return event.kind == EventKind::persist; });
    }
  }

  Frames frames;
  std::vector<reference::Frame> expected;
};

template <class T>
bool same_bytes(std::span<const T> got, const std::vector<T>& expected) {
  return got.size() == expected.size() &&
         (got.empty() || std::memcmp(got.data(), expected.data(), got.size_bytes()) == 0);
}

bool is_as_expected(const World& world, const reference::Frame& expected) {
  return same_bytes(world.pairs(), expected.pairs) &&
         same_bytes(world.overlaps(), expected.overlaps) &&
         same_bytes(world.contacts(), expected.contacts) &&
         same_bytes(world.events(), expected.events);
}

World make_world(const Frames& frames, Parallelism parallelism) {
  World world({.parallelism = parallelism});
  std::vector<BodyDesc> bodies;
  for (const reference::Body& body : reference_bodies(frames, 0)) bodies.push_back(body.desc);
  std::vector<BodyId> ids;
  world.add(bodies, ids);
  return world;
}

void place(const Frames& frames, size_t frame, World& world) {
  float* record = world.arrays().record32;
  const std::vector<float>& positions = frames.positions(frame);
  for (size_t i = 0; i < positions.size(); i += 3, record += 4) {
    std::memcpy(record, &positions[i], 3 * sizeof(float));
  }
}

// Sums of stage times over frames.
class StageTimes {
 public:
  void add(const StepReport& step) {
    for (int stage = 0; stage < kStageCount; ++stage) ns_[stage] += step.stage_ns[stage];
    stages_run_ |= step.stages_run;
  }

  void report(benchmark::State& state) const {
    for (int stage = 0; stage < kStageCount; ++stage) {
      if (!(stages_run_ >> stage & 1)) continue;
      state.counters[std::string("ms_") + name(static_cast<Stage>(stage))] =
          static_cast<double>(ns_[stage]) * 1e-6 / static_cast<double>(state.iterations());
    }
  }

 private:
  uint64_t ns_[kStageCount] = {};
  uint32_t stages_run_ = 0;
};

void measure_frames(benchmark::State& state, const WorldScene& scene, World& world) {
  const Frames& frames = scene.frames;
  for (size_t i = 0; i < 2; ++i) {
    place(frames, i, world);
    world.step();
    if (i < scene.expected.size() && !is_as_expected(world, scene.expected[i])) {
      return fail(state, "not the results of the reference");
    }
  }
  place(frames, 0, world);
  world.step();

  FrameCycle cycle(Frames::kCount);
  PassTimes times;
  StageTimes stages;
  for (auto _ : state) {
    state.PauseTiming();
    place(frames, cycle.next(), world);
    state.ResumeTiming();
    times.measure([&] { world.step(); });
    stages.add(world.report());
  }
  report(state, "body", frames.spec().bodies, times);
  stages.report(state);
  const StepReport& last = world.report();
  state.counters["pairs"] = static_cast<double>(last.pairs);
  state.counters["contacts"] = static_cast<double>(last.contacts);
  state.counters["tested"] = static_cast<double>(last.tested);
  state.counters["bytes_per_body"] =
      static_cast<double>(world.bytes()) / static_cast<double>(frames.spec().bodies);
}

void measure(benchmark::State& state, const SceneSpec& spec, const Setup& setup) {
  const auto& scene = cached<WorldScene>(spec);
  ThreadArena arena(setup.threads);
  if (!use_isa(state, setup.isa)) return;
  arena.run([&] {
    World world = make_world(scene.frames, arena.parallelism());
    measure_frames(state, scene, world);
  });
}

}  // namespace

void register_world(const Options& options) {
  for (const size_t bodies : scene_sizes(options.max_bodies)) {
    if (bodies < kSmallest) continue;
    for (const char* generator : {"brownian", "still"}) {
      const SceneSpec spec = {generator, bodies, ShapeKind::sphere};
      for (const Setup& setup : bodies == kSmallest ? all_setups() : strongest_setups()) {
        const std::string name = "world/" + spec.name() + "/contact/" + setup.name();
        const auto body = [spec, setup](benchmark::State& state) { measure(state, spec, setup); };
        benchmark::RegisterBenchmark(name.c_str(), body)->Unit(benchmark::kMillisecond);
      }
    }
  }
}

}  // namespace carom::bench

// Whole frames of spheres, from positions to contacts and events: world/SCENE/EXTRA/THREADS/ISA.
// The time is that of World::step(); counters tell the mean milliseconds of its stages. EXTRA is
// `contact`, or what the world has beside: `persist` events, or a million `excluded` pairs that do
// not meet.
#include <cmath>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "bench/support/cached.h"
#include "bench/support/frames.h"
#include "bench/support/measure.h"
#include "bench/support/stage_times.h"
#include "bench/support/suites.h"
#include "carom/base/thread_arena.h"
#include "carom/reference/reference.h"
#include "carom/world/world.h"
#include "oracle/random.h"

namespace carom::bench {
namespace {

constexpr size_t kSmallest = 10'000;
constexpr size_t kMostForReference = 10'000;

struct Extra {
  const char* name;
  bool persist_events = false;
  size_t excluded = 0;
};
constexpr Extra kExtras[] = {
    {.name = "contact"},
    {.name = "persist", .persist_events = true},
    {.name = "excluded", .excluded = 1'000'000},
};

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
      expected.push_back(
          reference::step(reference_bodies(frames, i),
                          {.velocities = false, .previous = i ? &expected[0] : nullptr}));
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
  std::vector<Event> events = expected.events;
  if (!world.settings().persist_events) {
    std::erase_if(events, [](const Event& event) { return event.kind == EventKind::persist; });
  }
  return same_bytes(world.pairs(), expected.pairs) &&
         same_bytes(world.overlaps(), expected.overlaps) &&
         same_bytes(world.contacts(), expected.contacts) && same_bytes(world.events(), events);
}

// Pairs of bodies that are too far from each other to meet in any frame.
std::vector<Pair> distant_pairs(const Frames& frames, size_t count) {
  constexpr float kFar = 10;  // metres
  const std::vector<float>& positions = frames.positions(0);
  oracle::Random random(7);
  std::vector<Pair> pairs;
  while (pairs.size() < count) {
    const auto a = static_cast<uint32_t>(random.below(frames.spec().bodies));
    const auto b = static_cast<uint32_t>(random.below(frames.spec().bodies));
    if (std::fabs(positions[3 * size_t{a}] - positions[3 * size_t{b}]) > kFar) {
      pairs.push_back({a, b});
    }
  }
  return pairs;
}

World make_world(const Frames& frames, const Extra& extra, Parallelism parallelism) {
  World world({.parallelism = parallelism, .persist_events = extra.persist_events});
  std::vector<BodyDesc> bodies;
  for (const reference::Body& body : reference_bodies(frames, 0)) bodies.push_back(body.desc);
  std::vector<BodyId> ids;
  world.add(bodies, ids);
  world.exclude(distant_pairs(frames, extra.excluded));
  return world;
}

void place(const Frames& frames, size_t frame, World& world) {
  float* record = world.arrays().record32;
  const std::vector<float>& positions = frames.positions(frame);
  for (size_t i = 0; i < positions.size(); i += 3, record += 4) {
    std::memcpy(record, &positions[i], 3 * sizeof(float));
  }
}

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

void measure(benchmark::State& state, const SceneSpec& spec, const Extra& extra,
             const Setup& setup) {
  const auto& scene = cached<WorldScene>(spec);
  ThreadArena arena(setup.threads);
  if (!use_isa(state, setup.isa)) return;
  arena.run([&] {
    World world = make_world(scene.frames, extra, arena.parallelism());
    measure_frames(state, scene, world);
  });
}

}  // namespace

void register_world(const Options& options) {
  for (const size_t bodies : scene_sizes(options.max_bodies)) {
    if (bodies < kSmallest) continue;
    for (const char* generator : {"brownian", "still"}) {
      const SceneSpec spec = {generator, bodies, ShapeKind::sphere};
      for (const Extra& extra : kExtras) {
        const bool on_all = bodies == kSmallest && &extra == kExtras;
        for (const Setup& setup : on_all ? all_setups() : strongest_setups()) {
          const std::string name = "world/" + spec.name() + "/" + extra.name + "/" + setup.name();
          const auto run = [=](benchmark::State& state) { measure(state, spec, extra, setup); };
          benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMillisecond);
        }
      }
    }
  }
}

}  // namespace carom::bench

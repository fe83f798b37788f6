// k-DOPs between broadphase and narrow phase, for turned boxes of one form:
// dop_bounds/FORM_kK/WHAT/THREADS/RUNNER, WHAT being
//   compute            computes the k-DOPs; time per body
//   pairs              tests candidate pairs; time per pair. left: share of the candidates (%) that
//                      the test leaves; overlapping: share that really overlaps. The difference is
//                      false positives.
//   overlap, contact   the narrow phase of a frame at that detail including k-DOPs; time per
//                      candidate pair. without: the time without k-DOPs; gain: without / with
#include "carom/bounds/dop_bounds.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <initializer_list>

#include "bench/support/bodies.h"
#include "bench/support/cached.h"
#include "bench/support/measure.h"
#include "bench/support/pair_stream.h"
#include "bench/support/suites.h"
#include "carom/base/thread_arena.h"
#include "carom/world/world.h"

namespace carom::bench {
namespace {

constexpr size_t kTurnedBodies = 5'000;
constexpr double kDensity = 0.1;  // share of the space that bodies of one cubic metre fill

// Edge lengths of a box, up to a factor.
struct Form {
  const char* name;
  float x, y, z;

  friend bool operator==(const Form& a, const Form& b) { return std::strcmp(a.name, b.name) == 0; }
};

constexpr Form kForms[] = {{"cubes", 1, 1, 1}, {"rods", 1, 1, 10}, {"plates", 10, 10, 1}};

struct Setting {
  Form form;
  DopKind kind;
  Setup setup;
};

PlacedShape draw_turned(const Form& form, oracle::Random& random) {
  const float half = 0.5f / std::cbrt(form.x * form.y * form.z);
  PlacedShape body = draw_body(ShapeKind::box, random);
  body.shape = Box{{form.x * half, form.y * half, form.z * half}};
  const double side = std::cbrt(static_cast<double>(kTurnedBodies) / kDensity);
  for (int axis = 0; axis < 3; ++axis) body.position[axis] = random.uniform(0, side);
  return as_stored(body, Storage::f32);
}

std::vector<PlacedShape> draw_bodies(const Form& form) {
  oracle::Random random(1);
  std::vector<PlacedShape> bodies;
  for (size_t i = 0; i < kTurnedBodies; ++i) bodies.push_back(draw_turned(form, random));
  return bodies;
}

// A world that tests every pair in every step.
World make_world(const std::vector<PlacedShape>& bodies, Detail detail,
                 std::optional<DopKind> dop_bounds, Parallelism parallelism) {
  World world({.detail = detail,
               .parallelism = parallelism,
               .events = false,
               .carry_results = false,
               .dop_bounds = dop_bounds});
  for (const PlacedShape& body : bodies) {
    world.add({.shape = body.shape, .position = body.position, .orientation = body.orientation});
  }
  return world;
}

// Bodies and their candidate pairs.
struct DopScene {
  explicit DopScene(const Form& form)
      : bodies(draw_bodies(form)), arrays(ShapeKind::box, bodies, Storage::f32) {
    World world = make_world(bodies, Detail::overlap, std::nullopt, Parallelism::none);
    world.step();
    pairs.assign(world.pairs().begin(), world.pairs().end());
    overlaps.assign(world.overlaps().begin(), world.overlaps().end());
  }

  std::vector<PlacedShape> bodies;
  DenseBodies arrays;
  std::vector<Pair> pairs;
  std::vector<uint8_t> overlaps;
};

double share(size_t part, size_t whole) {
  return 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

void measure_compute(benchmark::State& state, const DopScene& scene, DopKind kind,
                     Parallelism parallelism) {
  std::vector<float> records(kTurnedBodies * dop_record_size(kind));
  PassTimes times;
  for (auto _ : state) {
    times.measure([&] { compute_dops(scene.arrays.view(), {kind, records.data()}, parallelism); });
  }
  report(state, "body", kTurnedBodies, times);
}

void measure_pairs(benchmark::State& state, const DopScene& scene, DopKind kind,
                   Parallelism parallelism) {
  std::vector<float> records(kTurnedBodies * dop_record_size(kind));
  compute_dops(scene.arrays.view(), {kind, records.data()}, parallelism);
  std::vector<uint8_t> overlap(scene.pairs.size());
  size_t left = 0;
  PassTimes times;
  for (auto _ : state) {
    times.measure([&] {
      left = drop_separate_dops({kind, records.data()}, scene.pairs, overlap.data(), parallelism);
    });
  }
  for (size_t i = 0; i < overlap.size(); ++i) {
    if (overlap[i] < scene.overlaps[i]) return fail(state, "an overlapping pair is dropped");
  }
  report(state, "pair", scene.pairs.size(), times);
  const auto overlapping = std::count(scene.overlaps.begin(), scene.overlaps.end(), 1);
  state.counters["left"] = share(left, scene.pairs.size());
  state.counters["overlapping"] = share(static_cast<size_t>(overlapping), scene.pairs.size());
}

// The least time of a frame per item. Other programs disturb many of the few frames, so a median
// would not do.
class LeastTime {
 public:
  explicit LeastTime(size_t items) : items_(static_cast<double>(items)) {}

  void add(const StepReport& report, std::initializer_list<Stage> stages) {
    uint64_t ns = 0;
    for (const Stage stage : stages) ns += report.stage_ns[static_cast<size_t>(stage)];
    least_ = std::min(least_, static_cast<double>(ns) / items_);
  }

  double ns() const { return least_; }

 private:
  double items_;
  double least_ = HUGE_VAL;
};

// Steps a world with and one without k-DOPs in turns, so that a drift of the clock affects both.
void measure_frames(benchmark::State& state, const DopScene& scene, DopKind kind, Detail detail,
                    Parallelism parallelism) {
  World with = make_world(scene.bodies, detail, kind, parallelism);
  World without = make_world(scene.bodies, detail, std::nullopt, parallelism);
  LeastTime all(scene.pairs.size()), dops(scene.pairs.size()), plain(scene.pairs.size());
  for (auto _ : state) {
    const StepReport& report = with.step();
    all.add(report, {Stage::dops, Stage::narrowphase});
    dops.add(report, {Stage::dops});
    plain.add(without.step(), {Stage::narrowphase});
  }
  if (with.report().overlaps != without.report().overlaps) {
    return fail(state, "other overlaps with k-DOPs than without");
  }
  state.counters["ns_per_pair"] = all.ns();
  state.counters["dops"] = dops.ns();
  state.counters["without"] = plain.ns();
  state.counters["gain"] = plain.ns() / all.ns();
}

template <class Measure>
void add(const Setting& setting, const char* what, const Measure& measure) {
  const std::string name = std::string("dop_bounds/") + setting.form.name + "_k" +
                           std::to_string(2 * slab_count(setting.kind)) + "/" + what + "/" +
                           setting.setup.name();
  benchmark::RegisterBenchmark(name.c_str(), [setting, measure](benchmark::State& state) {
    const auto& scene = cached<DopScene>(setting.form);
    if (!use_isa(state, setting.setup.isa)) return;
    ThreadArena arena(setting.setup.threads);
    arena.run([&] { measure(state, scene, setting.kind, arena.parallelism()); });
  })->Unit(benchmark::kMicrosecond);
}

void register_setting(const Setting& setting) {
  add(setting, "compute", measure_compute);
  add(setting, "pairs", measure_pairs);
  for (const Detail detail : {Detail::overlap, Detail::contact}) {
    add(setting, name(detail),
        [detail](benchmark::State& state, const DopScene& scene, DopKind kind,
                 Parallelism parallelism) {
          measure_frames(state, scene, kind, detail, parallelism);
        });
  }
}

}  // namespace

void register_dop_bounds() {
  for (const Form& form : kForms) {
    for (const DopKind kind : {DopKind::k14, DopKind::k18, DopKind::k26}) {
      for (const Setup& setup : strongest_setups()) register_setting({form, kind, setup});
    }
  }
}

}  // namespace carom::bench

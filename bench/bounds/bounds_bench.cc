// World bounds: bounds/KIND/STORAGE/THREADS/RUNNER.
#include "carom/bounds/bounds.h"

#include <bit>

#include "bench/support/bodies.h"
#include "bench/support/bounds_arrays.h"
#include "bench/support/cached.h"
#include "bench/support/measure.h"
#include "bench/support/suites.h"
#include "carom/base/thread_arena.h"
#include "carom/reference/reference.h"

namespace carom::bench {
namespace {

constexpr size_t kBodies = 100'000;

struct SetSpec {
  ShapeKind kind;
  Storage storage;

  friend bool operator==(const SetSpec&, const SetSpec&) = default;
};

std::vector<PlacedShape> draw_bodies(const SetSpec& spec) {
  oracle::Random random(1);
  std::vector<Hull> hulls;
  if (spec.kind == ShapeKind::hull) hulls = draw_hulls(kHulls, 16, random);
  std::vector<PlacedShape> bodies;
  for (size_t i = 0; i < kBodies; ++i) {
    bodies.push_back(as_stored(draw_body(spec.kind, random, hulls), spec.storage));
    if (spec.kind == ShapeKind::dop) bodies[i].shape = bodies[i % kHulls].shape;
  }
  return bodies;
}

class BodySet {
 public:
  explicit BodySet(const SetSpec& spec)
      : spec_(spec), bodies_(draw_bodies(spec)), arrays_(spec.kind, bodies_, spec.storage) {
    PassTimes times;
    for (int pass = 0; pass < 5; ++pass) times.measure([&] { run_reference(expected_); });
    reference_seconds_ = times.median();
  }

  const Collidables& view() const { return arrays_.view(); }
  double reference_seconds() const { return reference_seconds_; }

  void run_reference(std::vector<reference::Box>& out) const {
    out.resize(kBodies);
    for (size_t i = 0; i < kBodies; ++i) {
      out[i] = reference::bounds(bodies_[i].shape, bodies_[i].pose(), position_type(spec_.storage));
    }
  }

  bool is_as_expected(const BoundsView& bounds) const {
    for (size_t i = 0; i < kBodies; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        const auto column = static_cast<size_t>(axis);
        if (bits(bounds.lower[column][i]) != bits(expected_[i].lower[axis])) return false;
        if (bits(bounds.upper[column][i]) != bits(expected_[i].upper[axis])) return false;
      }
    }
    return true;
  }

 private:
  static uint32_t bits(float x) { return std::bit_cast<uint32_t>(x); }

  SetSpec spec_;
  std::vector<PlacedShape> bodies_;
  DenseBodies arrays_;
  std::vector<reference::Box> expected_;
  double reference_seconds_ = 0;
};

void measure_kernel(benchmark::State& state, const BodySet& set, const Setup& setup) {
  BoundsArrays bounds(kBodies);
  ThreadArena arena(setup.threads);
  if (!use_isa(state, setup.isa)) return;
  arena.run([&] {
    compute_bounds(set.view(), bounds.columns(), arena.parallelism());
    if (!set.is_as_expected(bounds.view())) return fail(state, "not the bounds of the reference");
    PassTimes times;
    for (auto _ : state) {
      times.measure([&] { compute_bounds(set.view(), bounds.columns(), arena.parallelism()); });
    }
    report(state, "body", kBodies, times, set.reference_seconds());
  });
}

void measure_reference(benchmark::State& state, const BodySet& set) {
  std::vector<reference::Box> boxes;
  PassTimes times;
  for (auto _ : state) times.measure([&] { set.run_reference(boxes); });
  report(state, "body", kBodies, times, set.reference_seconds());
}

void register_set(const SetSpec& spec) {
  const std::string set_name = std::string("bounds/") + name(spec.kind) + "/" + name(spec.storage);
  const auto add = [&](const std::string& runner, auto measure) {
    benchmark::RegisterBenchmark((set_name + "/" + runner).c_str(), measure)
        ->Unit(benchmark::kMicrosecond);
  };
  add("t1/reference",
      [spec](benchmark::State& state) { measure_reference(state, cached<BodySet>(spec)); });
  for (const Setup& setup : all_setups()) {
    add(setup.name(), [spec, setup](benchmark::State& state) {
      measure_kernel(state, cached<BodySet>(spec), setup);
    });
  }
}

}  // namespace

void register_bounds() {
  for (const ShapeKind kind :
       {ShapeKind::sphere, ShapeKind::capsule, ShapeKind::aabb, ShapeKind::box, ShapeKind::triangle,
        ShapeKind::dop, ShapeKind::hull}) {
    for (const Storage storage : {Storage::f32, Storage::f64}) register_set({kind, storage});
  }
}

}  // namespace carom::bench

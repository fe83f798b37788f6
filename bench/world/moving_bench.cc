// Steps of worlds in which all bodies move, every hundredth, or none:
// world/moving/WHAT/WHO/THREADS. Cubes do not turn, boxes do. A body goes to and fro between two
// places; the bodies are the same in each step.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "bench/support/measure.h"
#include "bench/support/stage_times.h"
#include "bench/support/suites.h"
#include "carom/base/thread_arena.h"
#include "carom/reference/reference.h"
#include "carom/world/world.h"
#include "oracle/random.h"

namespace carom::bench {
namespace {

struct Crowd {
  const char* name;
  size_t bodies;
  ShapeKind kind;
  Detail detail;
  double room;  // of a body: the edge of a cube, in metres
};

// In the small ones a box meets the bounds of three others, as in a heap.
constexpr Crowd kCrowds[] = {
    {"20_boxes", 20, ShapeKind::box, Detail::manifold, 1.6},
    {"100_spheres", 100, ShapeKind::sphere, Detail::contact, 1.3},
    {"500_boxes", 500, ShapeKind::box, Detail::manifold, 1.8},
    {"100k_cubes", 100'000, ShapeKind::aabb, Detail::contact, 1.41},
    {"100k_spheres", 100'000, ShapeKind::sphere, Detail::contact, 1.71},
};

struct Who {
  const char* name;
  size_t every;  // a body in so many moves; 0: none
};
constexpr Who kAll{"all", 1}, kSome{"some", 100}, kNone{"none", 0};

Shape shape_of(ShapeKind kind) {
  constexpr float kHalf = 0.5f;
  switch (kind) {
    case ShapeKind::sphere:
      return Sphere{kHalf};
    case ShapeKind::box:
      return Box{{kHalf, kHalf, kHalf}};
    default:
      return Aabb::from_half_extents({kHalf, kHalf, kHalf});
  }
}

std::vector<BodyDesc> draw_crowd(const Crowd& crowd) {
  oracle::Random random(1);
  const double side = crowd.room * std::cbrt(static_cast<double>(crowd.bodies));
  std::vector<BodyDesc> bodies(crowd.bodies);
  for (BodyDesc& body : bodies) {
    body.shape = shape_of(crowd.kind);
    body.position = {random.uniform(0, side), random.uniform(0, side), random.uniform(0, side)};
    if (crowd.kind == ShapeKind::box) {
      body.orientation = Eigen::AngleAxisf(static_cast<float>(random.uniform(0, 6)),
                                           random.direction().cast<float>());
    }
  }
  return bodies;
}

class MovingCrowd {
 public:
  MovingCrowd(const Crowd& crowd, const Who& who, Parallelism parallelism)
      : world_({.detail = crowd.detail, .parallelism = parallelism}), bodies_(draw_crowd(crowd)) {
    world_.add(bodies_, ids_);
    oracle::Random random(2);
    for (size_t i = 0; who.every > 0 && i < bodies_.size(); i += who.every) {
      const Eigen::Vector3d way = 0.02 * random.direction();
      movers_.push_back(ids_[i]);
      places_[0].push_back(bodies_[i].position);
      places_[1].push_back(bodies_[i].position + way);
    }
  }

  void move() {
    at_ = 1 - at_;
    world_.set_positions(movers_, places_[at_]);
  }
  void step() { world_.step(); }
  const World& world() const { return world_; }

  // The contacts of the reference for the bodies where they are.
  std::vector<Contact> expected() {
    std::vector<reference::Body> bodies;
    for (size_t i = 0; i < bodies_.size(); ++i) {
      BodyDesc desc = bodies_[i];
      desc.position = world_.position(ids_[i]);
      bodies.push_back({ids_[i], desc});
    }
    return reference::step(bodies, {.detail = world_.settings().detail, .velocities = false})
        .contacts;
  }

 private:
  World world_;
  std::vector<BodyDesc> bodies_;
  std::vector<BodyId> ids_, movers_;
  std::array<std::vector<Eigen::Vector3d>, 2> places_;
  size_t at_ = 0;
};

void measure_crowd(benchmark::State& state, const Crowd& crowd, const Who& who, int threads) {
  constexpr size_t kMostForReference = 1'000;
  ThreadArena arena(threads);
  arena.run([&] {
    MovingCrowd moving(crowd, who, arena.parallelism());
    // The world learns in its first steps which bodies rest.
    for (int i = 0; i < 8; ++i) {
      moving.move();
      moving.step();
    }
    if (crowd.bodies <= kMostForReference) {
      const std::vector<Contact> expected = moving.expected();
      const std::span<const Contact> found = moving.world().contacts();
      if (!std::equal(found.begin(), found.end(), expected.begin(), expected.end(),
                      [](const Contact& a, const Contact& b) {
                        return a.a == b.a && a.b == b.b && a.separation == b.separation;
                      })) {
        return fail(state, "not the contacts of the reference");
      }
    }
    PassTimes times;
    StageTimes stages;
    for (auto _ : state) {
      state.PauseTiming();
      moving.move();
      state.ResumeTiming();
      times.measure([&] { moving.step(); });
      stages.add(moving.world().report());
    }
    stages.report(state);
    report(state, "body", crowd.bodies, times);
    state.counters["us_a_step"] = 1e6 * times.median();
    state.counters["pairs"] = static_cast<double>(moving.world().report().pairs);
    state.counters["contacts"] = static_cast<double>(moving.world().report().contacts);
  });
}

void register_crowd(const Crowd& crowd, const Who& who) {
  for (const int threads : {1, 2}) {
    const std::string name =
        std::string("world/moving/") + crowd.name + "/" + who.name + "/t" + std::to_string(threads);
    benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
      measure_crowd(state, crowd, who, threads);
    })->Unit(benchmark::kMicrosecond);
  }
}

}  // namespace

void register_moving(const Options& options) {
  for (const Crowd& crowd : kCrowds) {
    if (crowd.bodies > options.max_bodies) continue;
    register_crowd(crowd, kAll);
    if (crowd.bodies < 10'000) continue;
    register_crowd(crowd, kSome);
    register_crowd(crowd, kNone);
  }
}

}  // namespace carom::bench

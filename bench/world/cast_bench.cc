// Casts and queries, 10,000 at a time, in a world of 10,000 bodies: cast/BODIES/WHAT/THREADS/ISA.
// Rays start anywhere and are as long as the world is wide. cast/BODIES/tree and cast/BODIES/refit
// bring the index of queries up to date after a step in which no body moved, or all did.
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "bench/support/cached.h"
#include "bench/support/measure.h"
#include "bench/support/suites.h"
#include "carom/base/thread_arena.h"
#include "carom/world/world.h"
#include "oracle/random.h"

namespace carom::bench {
namespace {

constexpr size_t kQueries = 10'000;
constexpr size_t kChecked = 20;  // queries also tested against every body

enum class What { closest, all, spheres, overlaps, nearest };
constexpr What kEverything[] = {What::closest, What::all, What::spheres, What::overlaps,
                                What::nearest};

const char* name(What what) {
  constexpr const char* kNames[] = {"closest", "all", "spheres_closest", "overlaps", "nearest"};
  return kNames[static_cast<int>(what)];
}

// Bodies of several kinds that fill a fifth of the volume.
std::vector<BodyDesc> draw_yard(size_t count, double side, oracle::Random& random) {
  std::vector<BodyDesc> bodies(count);
  for (BodyDesc& body : bodies) {
    const auto size = [&] { return static_cast<float>(random.uniform(0.2, 0.7)); };
    body.position = {random.uniform(0, side), random.uniform(0, side), random.uniform(0, side)};
    const double angle = random.uniform(0, 6);
    body.orientation =
        Eigen::AngleAxisf(static_cast<float>(angle), random.direction().cast<float>());
    switch (random.below(4)) {
      case 0:
        body.shape = Sphere{size()};
        break;
      case 1:
        body.shape = Aabb::from_half_extents({size(), size(), size()});
        break;
      case 2:
        body.shape = Box{{size(), size(), size()}};
        break;
      default:
        body.shape = Capsule{{0, -size(), 0}, {0, size(), 0}, size() / 2};
    }
  }
  return bodies;
}

struct Yard {
  explicit Yard(size_t count) : side(2 * std::cbrt(static_cast<double>(count))) {
    oracle::Random random(1);
    bodies = draw_yard(count, side, random);
    for (size_t i = 0; i < kQueries; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        records.push_back(static_cast<float>(random.uniform(0, side)));
      }
      records.push_back(0.25f);
      directions.push_back(random.direction().cast<float>());
    }
  }

  double side;
  std::vector<BodyDesc> bodies;
  std::vector<float> records;  // x, y, z, radius a query
  std::vector<Eigen::Vector3f> directions;
};

World make_world(const Yard& yard, Parallelism parallelism, std::vector<BodyId>& ids) {
  World world({.detail = Detail::pairs, .parallelism = parallelism});
  world.add(yard.bodies, ids);
  world.step();
  return world;
}

class Queries {
 public:
  Queries(const Yard& yard, const World& world)
      : world_(world),
        parallelism_(world.settings().parallelism),
        rays_(yard.records.data(), yard.directions[0].data(), kQueries,
              static_cast<float>(yard.side), 4 * sizeof(float)),
        spheres_(sphere_records(yard.records.data(), kQueries)) {}

  // Returns the number of hits.
  size_t run(What what) {
    switch (what) {
      case What::closest:
      case What::all:
        world_.cast(rays_.queries(), rays_.sweep(), hits_,
                    {.hits = what == What::all ? CastHits::all : CastHits::closest,
                     .parallelism = parallelism_});
        return hits_.size();
      case What::spheres:
        world_.cast(spheres_, rays_.sweep(), hits_, {.parallelism = parallelism_});
        return hits_.size();
      case What::overlaps:
        world_.find_overlaps(spheres_, overlaps_, {.parallelism = parallelism_});
        return overlaps_.size();
      default:
        world_.find_nearest(spheres_, std::numeric_limits<float>::infinity(), nearest_,
                            {.parallelism = parallelism_});
        return nearest_.size();
    }
  }

 private:
  const World& world_;
  const Parallelism parallelism_;
  const Rays rays_;
  const Collidables spheres_;
  std::vector<CastHit> hits_;
  std::vector<OverlapHit> overlaps_;
  std::vector<NearestHit> nearest_;
};

using HitList = std::vector<std::tuple<uint32_t, float, uint32_t>>;  // query, time, body

HitList hits_of_first(const Yard& yard, const World& world) {
  const Rays rays(yard.records.data(), yard.directions[0].data(), kChecked,
                  static_cast<float>(yard.side), 4 * sizeof(float));
  std::vector<CastHit> hits;
  world.cast(rays.queries(), rays.sweep(), hits, {.hits = CastHits::all});
  HitList list;
  for (const CastHit& hit : hits) list.emplace_back(hit.query, hit.toi, hit.body);
  return list;
}

// The same hits, by casts at one body after another.
HitList plain_hits(const Yard& yard) {
  HitList all;
  for (uint32_t i = 0; i < yard.bodies.size(); ++i) {
    World alone({.detail = Detail::pairs});
    alone.add(yard.bodies[i]);
    alone.step();
    for (const auto& [query, toi, body] : hits_of_first(yard, alone)) {
      all.emplace_back(query, toi, i);
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

void measure(benchmark::State& state, size_t bodies, What what, const Setup& setup) {
  const auto& yard = cached<Yard>(bodies);
  ThreadArena arena(setup.threads);
  if (!use_isa(state, setup.isa)) return;
  arena.run([&] {
    std::vector<BodyId> ids;
    const World world = make_world(yard, arena.parallelism(), ids);
    if (hits_of_first(yard, world) != plain_hits(yard)) return fail(state, "hits are missing");
    Queries queries(yard, world);
    PassTimes times;
    size_t hits = 0;
    for (auto _ : state) times.measure([&] { hits = queries.run(what); });
    report(state, "query", kQueries, times);
    state.counters["hits"] = static_cast<double>(hits);
    state.counters["queries_per_s"] = kQueries / times.median();
  });
}

// The index of queries after a step in which no body moved, or every body by a centimetre.
void measure_index(benchmark::State& state, size_t bodies, bool move, const Setup& setup) {
  const auto& yard = cached<Yard>(bodies);
  ThreadArena arena(setup.threads);
  if (!use_isa(state, setup.isa)) return;
  arena.run([&] {
    std::vector<BodyId> ids;
    World world = make_world(yard, arena.parallelism(), ids);
    std::vector<Eigen::Vector3d> positions;
    for (const BodyDesc& body : yard.bodies) positions.push_back(body.position);
    oracle::Random random(2);
    PassTimes times;
    for (auto _ : state) {
      state.PauseTiming();
      for (Eigen::Vector3d& position : positions) position += 0.01 * random.direction();
      if (move) world.set_positions(ids, positions);
      world.step();
      state.ResumeTiming();
      times.measure([&] { world.prepare_queries(); });
    }
    report(state, "body", bodies, times);
  });
}

}  // namespace

void register_casts(const Options& options) {
  for (const size_t bodies : {size_t{10'000}, size_t{100'000}}) {
    if (bodies > options.max_bodies) continue;
    const std::string scene = "cast/" + short_count(bodies) + "/";
    for (const What what : kEverything) {
      for (const Setup& setup : bodies == 10'000 ? all_setups() : strongest_setups()) {
        const auto body = [=](benchmark::State& state) { measure(state, bodies, what, setup); };
        benchmark::RegisterBenchmark((scene + name(what) + "/" + setup.name()).c_str(), body)
            ->Unit(benchmark::kMillisecond);
      }
    }
    for (const Setup& setup : strongest_setups()) {
      for (const bool move : {false, true}) {
        const std::string name = scene + (move ? "refit/" : "tree/") + setup.name();
        benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
          measure_index(state, bodies, move, setup);
        })->Unit(benchmark::kMillisecond);
      }
    }
  }
}

}  // namespace carom::bench

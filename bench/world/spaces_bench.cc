// Many small scenes: world/spaces/SCENES/{together,alone}. Together: one world, a space a scene.
// Alone: a world a scene. The time is that of the steps, with manifolds, while all bodies move.
#include <string>
#include <vector>

#include "bench/support/measure.h"
#include "bench/support/suites.h"
#include "carom/world/world.h"
#include "oracle/random.h"

namespace carom::bench {
namespace {

constexpr size_t kBodies = 20;  // of a scene: a floor, and bodies of four kinds

std::vector<BodyDesc> draw_scene(uint32_t space) {
  oracle::Random random(space + 1);
  std::vector<BodyDesc> bodies = {
      {.shape = Halfspace{{0, 0, 1}, 0}, .motion = Motion::fixed, .space = space}};
  const Shape kShapes[] = {Sphere{0.3f}, Capsule{{0, 0, -0.3f}, {0, 0, 0.3f}, 0.2f},
                           Box{{0.3f, 0.2f, 0.25f}},
                           Aabb{{-0.3f, -0.3f, -0.3f}, {0.3f, 0.3f, 0.3f}}};
  while (bodies.size() < kBodies) {
    const Eigen::Vector3d position(random.uniform(0, 2), random.uniform(0, 2),
                                   random.uniform(0.1, 1));
    bodies.push_back({.shape = kShapes[bodies.size() % 4], .position = position, .space = space});
  }
  return bodies;
}

// Worlds, and the way that their bodies go from step to step: there and back.
class Scenes {
 public:
  Scenes(uint32_t scenes, bool together) : worlds_(together ? 1 : scenes) {
    for (World& world : worlds_) world = World({.detail = Detail::manifold});
    for (uint32_t scene = 0; scene < scenes; ++scene) {
      World& world = worlds_[together ? 0 : scene];
      for (const BodyDesc& body : draw_scene(scene)) bodies_.push_back({&world, world.add(body)});
    }
  }

  void move() {
    const double way = forth_ ? 0.01 : -0.01;
    forth_ = !forth_;
    for (const auto& [world, id] : bodies_) {
      world->set_position(id, world->position(id) + Eigen::Vector3d(way, way / 2, 0));
    }
  }

  void step() {
    for (World& world : worlds_) world.step();
  }

  size_t contacts() const {
    size_t sum = 0;
    for (const World& world : worlds_) sum += world.contacts().size();
    return sum;
  }

 private:
  struct Body {
    World* world;
    BodyId id;
  };

  std::vector<World> worlds_;
  std::vector<Body> bodies_;
  bool forth_ = true;
};

void measure_scenes(benchmark::State& state, uint32_t scenes, bool together) {
  Scenes measured(scenes, together), other(scenes, !together);
  for (Scenes* each : {&measured, &other}) each->step();
  if (measured.contacts() != other.contacts() || measured.contacts() == 0) {
    return fail(state, "not the contacts of worlds of their own");
  }
  PassTimes times;
  for (auto _ : state) {
    measured.move();
    times.measure([&] { measured.step(); });
  }
  report(state, "body", scenes * kBodies, times);
}

}  // namespace

void register_spaces(const Options& options) {
  const auto scenes = static_cast<uint32_t>(options.max_bodies >= 100'000 ? 4096 : 64);
  for (const bool together : {true, false}) {
    const std::string name =
        "world/spaces/" + std::to_string(scenes) + (together ? "/together" : "/alone");
    const auto run = [=](benchmark::State& state) { measure_scenes(state, scenes, together); };
    benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMillisecond);
  }
}

}  // namespace carom::bench

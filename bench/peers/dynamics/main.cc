// carom_stacks [STEPS]: the scenes of examples/rigid_scenes.h in Bullet's world and in the
// example's solver on Carom's contacts, for 1,000 steps of 1/60 s. How far the furthest body went,
// how fast the fastest still is, and how deep two bodies overlapped.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "bench/peers/dynamics/bullet_scene.h"

namespace carom::bench {
namespace {

struct Outcome {
  double furthest = 0;  // metres
  double top = 0;       // the body that was added last, metres
  double fastest = 0;   // metres a second
  double deepest = 0;   // metres
  double ms = 0;        // a step
};

double ms_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
      .count();
}

Outcome run_bullet(rigid::Scene (*make)(), int steps, int substeps) {
  const rigid::Scene scene = make();
  BulletScene peer(scene, substeps);
  Outcome outcome;
  for (int i = 0; i < steps; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    peer.step();
    outcome.ms += ms_since(begin) / steps;
    outcome.deepest = std::max(outcome.deepest, peer.deepest());
  }
  for (const BodyId id : scene.moving) {
    outcome.top = (peer.position(id) - scene.solver.world().position(id)).norm();
    outcome.furthest = std::max(outcome.furthest, outcome.top);
    outcome.fastest = std::max(outcome.fastest, peer.speed(id));
  }
  return outcome;
}

Outcome run_example(rigid::Scene (*make)(), int steps) {
  rigid::Scene scene = make();
  rigid::Watch watch(scene);
  Outcome outcome;
  for (int i = 0; i < steps; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    scene.solver.step();
    outcome.ms += ms_since(begin) / steps;
    watch.note(scene);
  }
  outcome.furthest = watch.furthest(scene);
  outcome.top = watch.ways(scene).back();
  outcome.deepest = watch.deepest;
  for (const BodyId id : scene.moving) {
    const double speed = scene.solver.bodies()[id.index].velocity.norm();
    outcome.fastest = std::max(outcome.fastest, speed);
  }
  return outcome;
}

void print(const char* scene, const char* solver, const Outcome& outcome) {
  std::printf("%-8s  %-24s  %9.5f  %9.5f  %10.5f  %9.5f  %8.3f\n", scene, solver, outcome.top,
              outcome.furthest, outcome.fastest, outcome.deepest, outcome.ms);
  std::fflush(stdout);
}

}  // namespace
}  // namespace carom::bench

int main(int argc, char** argv) {
  using namespace carom::bench;
  const int steps = argc > 1 ? std::atoi(argv[1]) : 1000;
  std::printf("%-8s  %-24s  %9s  %9s  %10s  %9s  %8s\n", "scene", "solver", "last, m", "furthest",
              "speed, m/s", "depth, m", "ms");
  for (const rigid::NamedScene& named : rigid::kScenes) {
    print(named.name, "example", run_example(named.make, steps));
    print(named.name, "Bullet", run_bullet(named.make, steps, 1));
    print(named.name, "Bullet, 10 steps a frame", run_bullet(named.make, steps, 10));
  }
}

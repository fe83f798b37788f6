// Rigid bodies on Carom's contacts: a stack, a wall, a pyramid and a house of cards that stand,
// hulls that fall on hills, marbles in a bowl, a box in a corner and a chain. The solver is in
// rigid_solver.h, the scenes in rigid_scenes.h.
//
//   rigid_bodies                          runs every scene for 100 steps and checks it
//   rigid_bodies SCENE STEPS [FILE.npz]   runs one scene, and records it
//
// `carom run FILE.npz --detail regions --page FILE.html` then plays the recording in a browser.
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string_view>

#include "rigid_scenes.h"
#include "scene_recorder.h"

namespace {

// Returns whether the scene did what it has to do.
bool run(const rigid::NamedScene& named, int steps, const char* file) {
  rigid::Scene scene = named.make();
  std::optional<rigid::SceneRecorder> recorder;
  if (file) recorder.emplace(scene.solver.world());
  for (const rigid::BallJoint& joint : scene.solver.joints()) {
    if (recorder) recorder->exclude(joint.a, joint.b);
  }
  rigid::Watch watch(scene);
  for (int i = 0; i < steps; ++i) {
    if (recorder) recorder->add_frame();
    scene.solver.step();
    watch.note(scene);
  }
  const double way = watch.furthest(scene);
  const bool holds = watch.deepest < named.most_depth && way < named.most_way;
  std::printf("%-6s %-12s %3zu bodies, overlaps up to %.4f m, ways up to %.4f m, %.4f m/s\n",
              holds ? "ok" : "FAILED", named.name, scene.moving.size(), watch.deepest, way,
              rigid::fastest(scene));
  return holds && (!recorder || recorder->write(file, 1.0 / 60));
}

}  // namespace

int main(int argc, char** argv) {
  bool all = true, any = false;
  for (const rigid::NamedScene& named : rigid::kScenes) {
    if (argc > 1 && std::string_view(argv[1]) != named.name) continue;
    any = true;
    all &= run(named, argc > 2 ? std::atoi(argv[2]) : 100, argc > 3 ? argv[3] : nullptr);
  }
  return all && any ? 0 : 1;
}

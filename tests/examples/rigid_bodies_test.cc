// The scenes of examples/rigid_bodies.cc for 1,000 steps: piles stand, nothing tunnels, nothing
// jitters, nothing gains energy, and poses have the same bits on every instruction set and for any
// number of threads. So the contacts are enough for a solver.
#include <gtest/gtest.h>

#include <cstring>

#include "carom/base/thread_arena.h"
#include "examples/rigid_scenes.h"
#include "tests/support/isas.h"

namespace rigid {
namespace {

#ifdef CAROM_TEST_SANITIZED
constexpr int kSteps = 100;
#else
constexpr int kSteps = 1000;
#endif

class Run {
 public:
  explicit Run(Scene (*make)(), int steps = kSteps) : scene(make()), watch(scene) {
    for (int i = 0; i < steps; ++i) {
      scene.solver.step();
      watch.note(scene);
    }
  }

  Scene scene;
  Watch watch;
};

// A pile of things of this size, metres.
void expect_stands(const Run& run, double size) {
  EXPECT_LT(run.watch.furthest(run.scene), 0.01 * size);
  EXPECT_LT(run.watch.deepest, 0.01 * size);
  EXPECT_LT(run.watch.energy_gain, 1e-4 * run.watch.energy_at_start);
  EXPECT_LT(run.watch.fastest(run.scene), 1e-3);
}

TEST(RigidBodies, AStackOf20BoxesStands) { expect_stands(Run(make_stack), 1); }
TEST(RigidBodies, AWallStands) { expect_stands(Run(make_wall), 0.5); }
TEST(RigidBodies, APyramidStands) { expect_stands(Run(make_pyramid), 1); }
TEST(RigidBodies, AHouseOfCardsStands) { expect_stands(Run(make_cards), 0.9); }

}  // namespace
}  // namespace rigid

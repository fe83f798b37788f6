// The scenes of examples/rigid_bodies.cc for 1,000 steps: piles stand, nothing tunnels, nothing
// jitters, nothing gains energy, and poses have the same bits on every instruction set and for any
// number of threads. So the contacts are enough for a solver.
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "examples/rigid_scenes.h"
#include "tests/support/isas.h"

namespace rigid {
namespace {

#ifdef CAROM_TEST_SANITIZED
constexpr int kSteps = 50;
#else
constexpr int kSteps = 1000;
#endif

class PlayedScene {
 public:
  explicit PlayedScene(Scene (*make)(), int steps = kSteps) : scene(make()), watch(scene) {
    for (int i = 0; i < steps; ++i) {
      scene.solver.step();
      watch.note(scene);
    }
  }

  Eigen::Vector3d position(size_t i) const {
    return scene.solver.world().position(scene.moving[i]);
  }

  Scene scene;
  Watch watch;
};

// A pile of things of this size, in metres. The depth is the spring of the contacts.
void expect_stands(const PlayedScene& run, double size) {
  EXPECT_LT(run.watch.furthest(run.scene), 0.01 * size);
  EXPECT_LT(run.watch.deepest, 0.002 * size);
  EXPECT_LT(run.watch.energy_gain, 1e-6 * run.watch.energy_at_start);
  EXPECT_LT(fastest(run.scene), 0.005);
}

TEST(RigidBodies, AStackOf20BoxesStands) { expect_stands(PlayedScene(make_stack), 1); }
TEST(RigidBodies, AWallStands) { expect_stands(PlayedScene(make_wall), 0.5); }
TEST(RigidBodies, APyramidStands) { expect_stands(PlayedScene(make_pyramid), 1); }
TEST(RigidBodies, AHouseOfCardsStands) { expect_stands(PlayedScene(make_cards), 0.6); }

// In half-spaces, and in a mesh, where the three sides are contacts of one pair.
TEST(RigidBodies, ABoxInACornerDoesNotJitter) {
  const Vector3f rests_at = Quaternionf::FromTwoVectors(Vector3f(1, 1, 1), Vector3f::UnitZ()) *
                            Vector3f(0.5f, 0.4f, 0.3f);
  for (const auto make : {make_corner, make_mesh_corner}) {
    const PlayedScene run(make);
    EXPECT_EQ(run.scene.solver.contacts().size(), 3u);
    EXPECT_LT(fastest(run.scene), 1e-4);
    EXPECT_LT(run.watch.deepest, 1e-3);
    EXPECT_LT(run.watch.energy_gain, 1e-6 * run.watch.energy_at_start);
    EXPECT_LT((run.position(0) - rests_at.cast<double>()).norm(), 0.001);
  }
}

TEST(RigidBodies, HullsStayOnTheHills) {
  const PlayedScene run(make_hulls);
  for (size_t i = 0; i < run.scene.moving.size(); ++i) {
    const Eigen::Vector3d at = run.position(i);
    EXPECT_GT(at.z(), hills(static_cast<float>(at.x()), static_cast<float>(at.y()))) << i;
  }
  EXPECT_EQ(run.scene.moving.size(), 500u);
  EXPECT_LT(run.watch.deepest, 0.2);
  EXPECT_EQ(run.watch.energy_gain, 0);
  if (kSteps == 1000) {
    EXPECT_LT(fastest(run.scene), 3);  // a few still roll
  }
}

TEST(RigidBodies, MarblesStayInTheBowl) {
  const PlayedScene run(make_marbles);
  for (size_t i = 0; i < run.scene.moving.size(); ++i) {
    const Eigen::Vector3d at = run.position(i);
    EXPECT_GT(at.z(), bowl(static_cast<float>(at.x()), static_cast<float>(at.y()))) << i;
    EXPECT_LT(at.head(2).norm(), 3.5) << i;
  }
  EXPECT_LT(run.watch.deepest, 0.04);
  EXPECT_EQ(run.watch.energy_gain, 0);
}

TEST(RigidBodies, AChainHangsTogether) {
  const PlayedScene run(make_chain);
  for (const BallJoint& joint : run.scene.solver.joints()) EXPECT_LT(joint.gap(), 0.01f);
  for (const carom::Contact& contact : run.scene.solver.world().contacts()) {
    EXPECT_FALSE(run.scene.solver.world().is_excluded(run.scene.solver.world().id_of(contact.a),
                                                      run.scene.solver.world().id_of(contact.b)));
  }
  EXPECT_LT(run.watch.energy_gain, 0.01 * run.watch.energy_at_start);
  EXPECT_LT(run.watch.deepest, 0.04);
}

// Points of piles at rest, those included that only come near.
TEST(RigidBodies, PointsOfPilesContinueThoseOfTheStepBefore) {
  for (const auto make : {make_stack, make_wall, make_cards}) {
    PlayedScene played(make, 60);
    size_t points = 0, kept = 0;  // kept: under the same name
    for (int i = 0; i < 20; ++i) {
      const carom::World& world = played.scene.solver.world();
      const std::vector<carom::ContactIdentity> before(world.identities().begin(),
                                                       world.identities().end());
      played.scene.solver.step();
      for (size_t k = 0; k < world.contacts().size(); ++k) {
        const carom::ContactIdentity& identity = world.identities()[k];
        for (size_t point = 0; point < world.contacts()[k].manifold_count; ++point) {
          ++points;
          const uint32_t place = identity.previous_point[point];
          if (place == carom::kNoPrevious) continue;
          kept += before[place / 4].names.point[place % 4] == identity.names.point[point];
        }
      }
    }
    EXPECT_GT(points, 1000u);
    EXPECT_GE(static_cast<double>(kept), 0.99 * static_cast<double>(points));
  }
}

// ------------------------------------------------------------ the same bits

std::vector<std::array<uint64_t, 5>> bits_after(const NamedScene& named, int steps, int threads) {
  tbb::task_arena arena(threads);
  std::vector<std::array<uint64_t, 5>> bits;
  arena.execute([&] {
    const PlayedScene run(named.make, steps);
    for (size_t i = 0; i < run.scene.moving.size(); ++i) {
      const Eigen::Vector3d at = run.position(i);
      const carom::Orientation q = run.scene.solver.world().orientation(run.scene.moving[i]);
      const std::array<float, 4> turned = {q.x(), q.y(), q.z(), q.w()};
      const auto halves = std::bit_cast<std::array<uint64_t, 2>>(turned);
      bits.push_back({std::bit_cast<uint64_t>(at.x()), std::bit_cast<uint64_t>(at.y()),
                      std::bit_cast<uint64_t>(at.z()), halves[0], halves[1]});
    }
  });
  return bits;
}

// By then everything touches something.
int few_steps(const NamedScene& named) { return named.make == make_hulls ? 60 : 40; }

TEST(RigidBodies, SameBitsOnEveryInstructionSet) {
  for (const NamedScene& named : kScenes) {
    SCOPED_TRACE(named.name);
    const auto expected = bits_after(named, few_steps(named), 1);
    carom::test::for_each_isa([&] { EXPECT_EQ(bits_after(named, few_steps(named), 1), expected); });
  }
}

TEST(RigidBodies, SameBitsOnTwoThreads) {
  for (const NamedScene& named : kScenes) {
    SCOPED_TRACE(named.name);
    EXPECT_EQ(bits_after(named, few_steps(named), 2), bits_after(named, few_steps(named), 1));
  }
}

}  // namespace
}  // namespace rigid

// Results kept from step to step: how many there are, and that they equal new ones.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/world/crowds.h"

namespace carom::test {
namespace {

size_t pairs_of(const World& world, uint32_t index) {
  return static_cast<size_t>(
      std::count_if(world.pairs().begin(), world.pairs().end(),
                    [&](const Pair& pair) { return pair.a == index || pair.b == index; }));
}

TEST(Carry, AStillSceneKeepsEverything) {
  for (const PositionType positions : {PositionType::float32, PositionType::float64}) {
    WorldSettings settings;
    settings.positions = positions;
    settings.persist_events = true;
    World world(settings);
    add_crowd(world, {.filters = true});
    const StepReport first = world.step();
    EXPECT_EQ(first.tested, first.pairs);
    EXPECT_EQ(first.kept, 0u);
    EXPECT_GT(first.pairs, 100u);
    const Results before = results(world);
    for (int i = 0; i < 3; ++i) {
      const StepReport& report = world.step();
      EXPECT_EQ(report.kept, first.pairs);
      EXPECT_EQ(report.tested, 0u);
      EXPECT_EQ(report.pairs, first.pairs);
      EXPECT_EQ(report.overlaps, first.overlaps);
      EXPECT_EQ(report.contacts, first.contacts);
      const Results now = results(world);
      EXPECT_EQ(now.pairs, before.pairs);
      EXPECT_EQ(now.overlaps, before.overlaps);
      EXPECT_EQ(now.contacts, before.contacts);
      EXPECT_EQ(world.events().size(), first.overlaps);
      for (const Event& event : world.events()) EXPECT_EQ(event.kind, EventKind::persist);
    }
  }
}

TEST(Carry, AStillStepFindsNoBoundsAndNoPairs) {
  World world({.persist_events = true});
  const std::vector<BodyId> ids = add_crowd(world, {});
  world.step();
  const StepReport& report = world.step();
  for (const Stage stage :
       {Stage::bounds, Stage::broadphase, Stage::pairs, Stage::narrowphase, Stage::results}) {
    EXPECT_FALSE(report.ran(stage)) << name(stage);
    EXPECT_EQ(report.stage_ns[static_cast<int>(stage)], 0u);
  }
  EXPECT_TRUE(report.ran(Stage::changes));
  EXPECT_TRUE(report.ran(Stage::events));
  EXPECT_EQ(world.events().size(), report.overlaps);
  // From the second still step on, even the events repeat.
  EXPECT_FALSE(world.step().ran(Stage::events));
  EXPECT_EQ(world.events().size(), report.overlaps);

  // Any change of a body ends the still steps.
  world.set_position(ids[0], world.position(ids[0]) + Eigen::Vector3d(0.25, 0, 0));
  EXPECT_TRUE(world.step().ran(Stage::bounds));
  EXPECT_FALSE(world.step().ran(Stage::bounds));
  world.remove(ids[1]);
  EXPECT_TRUE(world.step().ran(Stage::bounds));
  EXPECT_FALSE(world.step().ran(Stage::bounds));
  world.add({});
  EXPECT_TRUE(world.step().ran(Stage::bounds));
  world.set_sensor(ids[0], true);
  EXPECT_TRUE(world.step().ran(Stage::bounds));
  EXPECT_FALSE(world.step().ran(Stage::bounds));
  world.remove(world.add({}));  // not there at either step
  world.step();
  EXPECT_FALSE(world.step().ran(Stage::bounds));
}

TEST(Carry, OneMoverRetestsItsOwnPairsAlone) {
  World world;
  const std::vector<BodyId> ids = add_crowd(world, {});
  world.step();
  for (size_t i = 0; i < ids.size(); i += 17) {
    world.set_position(ids[i], world.position(ids[i]) + Eigen::Vector3d(0, 0.125, 0));
    const StepReport& report = world.step();
    EXPECT_EQ(report.tested, pairs_of(world, ids[i].index));
    EXPECT_EQ(report.kept, report.pairs - report.tested);
  }
}

TEST(Carry, AMovedBoxCornerRetestsItsPairs) {
  World world;
  const std::vector<BodyId> ids = add_crowd(world, {});
  world.boxes();
  world.step();
  for (const BodyId id : ids) {
    if (!std::holds_alternative<Aabb>(world.shape(id))) continue;
    world.boxes().upper(world.box_slot(id))[2] += 0.125f;
    const StepReport& report = world.step();
    EXPECT_EQ(report.tested, pairs_of(world, id.index));
  }
}

TEST(Carry, BoxesAndRowsMayHaveChangedWhenTheirArraysAreAskedForAtFirst) {
  World world;
  const std::vector<BodyId> ids = add_crowd(world, {.oriented = true});
  const auto bodies_with = [&](auto has) {
    return std::ranges::count_if(ids, [&](BodyId id) { return has(kind_of(world.shape(id))); });
  };
  const auto is_box = [](ShapeKind kind) { return kind == ShapeKind::aabb; };
  const auto has_rows = [](ShapeKind kind) { return row_count(kind) > 0; };
  ASSERT_GT(bodies_with(is_box), 10);
  ASSERT_GT(bodies_with(has_rows), 10);
  world.step();
  world.step();
  EXPECT_EQ(world.report().tested, 0u);
  world.boxes();
  world.step();
  const size_t tested_of_boxes = world.report().tested;
  EXPECT_GT(tested_of_boxes, 0u);
  EXPECT_LT(tested_of_boxes, world.report().pairs);
  world.boxes();
  world.step();
  EXPECT_EQ(world.report().tested, 0u);
  world.shape_rows();
  world.step();
  EXPECT_GT(world.report().tested, 0u);
  world.step();
  EXPECT_EQ(world.report().tested, 0u);
}

TEST(Carry, ATurnedBodyRetestsItsPairs) {
  World world({.detail = Detail::manifold});
  const std::vector<BodyId> ids = add_crowd(world, {.oriented = true, .halfspaces = 2});
  world.shape_rows();
  world.step();
  Random random(1);
  for (const BodyId id : ids) {
    const ShapeKind kind = kind_of(world.shape(id));
    if (row_count(kind) == 0) continue;
    if (random.chance(0.5)) {
      world.arrays().orientation[4 * id.index + random.below(4)] += 0.125f;
    } else {
      const size_t row = world.first_row(id) + random.below(row_count(kind));
      world.shape_rows().rows[4 * row + random.below(3)] += 0.125f;
    }
    const StepReport& report = world.step();
    EXPECT_EQ(report.tested, pairs_of(world, id.index));
    EXPECT_EQ(report.kept, report.pairs - report.tested);
  }
}

TEST(Carry, AReplacedBodyIsTestedAgain) {
  World world;
  world.add({.shape = Sphere{1}});
  const BodyDesc desc = {.shape = Sphere{1}, .position = {0.5, 0, 0}};
  const BodyId id = world.add(desc);
  world.step();
  world.remove(id);
  world.add(desc);
  EXPECT_EQ(world.step().tested, 1u);
  EXPECT_EQ(world.step().kept, 1u);
}

// Writes the poses of a large crowd straight into the arrays: all of them in most steps, then few,
// then none.
class WrittenPoses {
 public:
  static constexpr size_t kBodies = 9000;

  explicit WrittenPoses(bool carries) : world_({.carry_results = carries}) {
    add_crowd(world_, {.count = kBodies, .side = 21, .oriented = true, .velocities = true});
  }

  // The report of a step in which one body of so many moves; 0: none.
  const StepReport& step(size_t every) {
    const BodyArrays arrays = world_.arrays();
    for (size_t i = 0; every > 0 && i < arrays.count; i += every) {
      for (int axis = 0; axis < 3; ++axis) {
        arrays.record32[4 * i + axis] += static_cast<float>(random_.uniform(-0.02, 0.02));
      }
    }
    return world_.step();
  }
  const World& world() const { return world_; }

 private:
  World world_;
  Random random_{8};
};

TEST(Carry, WherePosesAreWrittenAndAllMove) {
  WrittenPoses carrying(true), testing(false);
  for (const size_t every : {1, 1, 1, 1, 1, 0, 0, 0, 1, 1, 1, 20, 0, 20, 1, 1, 1, 2, 2}) {
    carrying.step(every);
    testing.step(every);
    ASSERT_TRUE(results(carrying.world()) == results(testing.world()));
    ASSERT_GT(carrying.world().contacts().size(), 1000u);
  }
}

TEST(Carry, OneStepAfterAllHaveMovedNothingIsKept) {
  WrittenPoses written(true);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(written.step(1).kept, 0u);
  EXPECT_EQ(written.step(20).kept, 0u) << "nobody knows where the others were";
  EXPECT_GT(written.step(20).kept, written.world().pairs().size() / 2);
  EXPECT_EQ(written.step(0).tested, 0u);
}

// A change is a change of bits: writing the same pose again, or restoring it before the step, is
// none; changing the sign of zero is one.
TEST(Carry, ChangesAreChangesOfBits) {
  World world;
  const BodyId id = world.add({.shape = Sphere{1}});
  world.add({.shape = Sphere{1}});
  world.step();
  world.set_position(id, {5, 5, 5});
  world.set_position(id, {0, 0, 0});
  EXPECT_EQ(world.step().kept, 1u);
  world.set_position(id, {-0.0, 0, 0});
  EXPECT_EQ(world.step().tested, 1u);
  world.set_shape(id, Sphere{1});
  EXPECT_EQ(world.step().pairs, 1u);
  EXPECT_EQ(world.step().kept, 1u);
}

TEST(Carry, OnAndOffGiveTheSameBytes) {
  for (const PositionType positions : {PositionType::float32, PositionType::float64}) {
    for (const double share : {0.0, 0.05, 0.5, 1.0}) {
      WorldSettings settings;
      settings.positions = positions;
      World carrying(settings);
      settings.carry_results = false;
      World testing(settings);
      const CrowdSpec spec{.filters = true, .velocities = true};
      const std::vector<BodyId> ids = add_crowd(carrying, spec);
      add_crowd(testing, spec);
      Random one(5), two(5);
      for (int frame = 0; frame < 10; ++frame) {
        carrying.step();
        testing.step();
        EXPECT_TRUE(results(carrying) == results(testing)) << "frame " << frame;
        EXPECT_EQ(testing.report().kept, 0u);
        if (frame > 0 && share < 1) {
          EXPECT_GT(carrying.report().kept, 0u);
        }
        move_some(carrying, ids, share, one);
        move_some(testing, ids, share, two);
      }
    }
  }
}

// --- Velocities ---

TEST(Velocities, AreTakenAlongTheNormal) {
  World world;
  const BodyId a = world.add({.shape = Sphere{1}});
  const BodyId b = world.add({.shape = Sphere{1}, .position = {1, 0, 0}});
  world.step();
  EXPECT_FALSE(world.report().ran(Stage::velocities));
  EXPECT_EQ(world.contacts()[0].normal_velocity, 0);

  world.set_linear_velocity(a, {3, 100, -100});
  EXPECT_EQ(world.linear_velocity(a), Eigen::Vector3f(3, 100, -100));
  EXPECT_EQ(world.linear_velocity(b), Eigen::Vector3f::Zero());
  world.step();
  EXPECT_TRUE(world.report().ran(Stage::velocities));
  EXPECT_EQ(world.contacts()[0].normal_velocity, -3) << "approaching";

  // Writes in the array change the velocity only, so the contact is kept.
  const std::span<Eigen::Vector3f> velocities = world.linear_velocities();
  ASSERT_EQ(velocities.size(), 2u);
  velocities[b.index] = {10, 0, 0};
  world.step();
  EXPECT_EQ(world.contacts()[0].normal_velocity, 7) << "parting";
  EXPECT_EQ(world.report().kept, 1u);

  world.set_position(b, {0, 2, 0});
  world.step();
  EXPECT_EQ(world.contacts()[0].normal_velocity, -100);
}

TEST(Velocities, OfBodiesThatCameLaterAreZero) {
  World world;
  world.add({.shape = Sphere{1}, .linear_velocity = {1, 0, 0}});
  world.add({.shape = Sphere{1}, .position = {1, 0, 0}});
  EXPECT_EQ(world.linear_velocities().size(), 2u);
  world.step();
  EXPECT_EQ(world.contacts()[0].normal_velocity, -1);
}

TEST(Velocities, AreNotUsedBelowDetailContact) {
  WorldSettings settings;
  settings.detail = Detail::overlap;
  World world(settings);
  world.add({.shape = Sphere{1}, .linear_velocity = {1, 0, 0}});
  world.add({.shape = Sphere{1}});
  world.step();
  EXPECT_FALSE(world.report().ran(Stage::velocities));
}

}  // namespace
}  // namespace carom::test

// A world runs and stores only what its bodies and settings need.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <initializer_list>

#include "carom/base/jobs.h"
#include "tests/support/isas.h"
#include "tests/support/own_jobs.h"
#include "tests/world/crowds.h"

namespace carom::test {
namespace {

std::string stages_run(const StepReport& report) {
  std::string text;
  for (int i = 0; i < kStageCount; ++i) {
    const auto stage = static_cast<Stage>(i);
    if (report.ran(stage)) text += (text.empty() ? "" : " ") + std::string(name(stage));
  }
  return text;
}

std::string first_step(const WorldSettings& settings, const CrowdSpec& spec) {
  World world(settings);
  add_crowd(world, spec);
  const StepReport& report = world.step();
  for (int i = 0; i < kStageCount; ++i) {
    if (!report.ran(static_cast<Stage>(i))) {
      EXPECT_EQ(report.stage_ns[i], 0u);
    }
  }
  return stages_run(report);
}

// How often three steps, in which all bodies move, ask for other threads.
size_t times_shared(const CrowdSpec& spec) {
  BackwardJobs jobs;
  const JobsScope scope(jobs);
  World world({.parallelism = Parallelism::arena});
  const std::vector<BodyId> ids = add_crowd(world, spec);
  Random random(2);
  for (int step = 0; step < 3; ++step) {
    move_some(world, ids, 1, random);
    world.step();
  }
  EXPECT_GT(world.contacts().size(), spec.count / 10);
  return jobs.runs();
}

// Waking a thread takes as long as a step of a small world.
TEST(PayForUse, SmallWorldsRunOnOneThread) {
  for (const size_t count : {10, 300, 1000, 3000}) {
    const double side = 1.7 * std::cbrt(static_cast<double>(count));
    EXPECT_EQ(times_shared({.count = count, .side = side, .boxes = false, .velocities = true}), 0u)
        << count;
  }
  EXPECT_GT(times_shared({.count = 20000, .side = 46, .boxes = false, .velocities = true}), 10u);
}

TEST(PayForUse, StagesThatRun) {
  WorldSettings settings;
  EXPECT_EQ(first_step(settings, {}), "changes bounds broadphase pairs narrowphase results events");
  EXPECT_EQ(first_step(settings, {.velocities = true}),
            "changes bounds broadphase pairs narrowphase results velocities events");
  settings.events = false;
  EXPECT_EQ(first_step(settings, {}), "changes bounds broadphase pairs narrowphase results");
  settings.carry_results = false;
  EXPECT_EQ(first_step(settings, {}), "bounds broadphase pairs narrowphase results");
  settings.detail = Detail::pairs;
  EXPECT_EQ(first_step(settings, {.velocities = true}), "bounds broadphase");
  settings = {};
  settings.detail = Detail::pairs;
  EXPECT_EQ(first_step(settings, {.velocities = true}), "bounds broadphase");
  settings.detail = Detail::manifold;
  EXPECT_EQ(first_step(settings, {.oriented = true, .halfspaces = 1, .velocities = true}),
            "changes bounds broadphase pairs narrowphase results velocities events");
}

// Without threads all of a stage is serial. With threads less is, where there is enough to share.
TEST(PayForUse, StagesSayWhatIsSerial) {
  for (const int threads : {1, 2}) {
    ThreadArena arena(threads);
    arena.run([&] {
      World world({.detail = Detail::manifold, .parallelism = arena.parallelism()});
      add_crowd(world, {.count = 8000, .side = 30, .velocities = true});
      const auto start = std::chrono::steady_clock::now();
      const StepReport& report = world.step();
      const auto time = std::chrono::steady_clock::now() - start;
      EXPECT_GT(report.stage_ns[static_cast<int>(Stage::velocities)], 0u);
      uint64_t all = 0, serial = 0;
      for (int i = 0; i < kStageCount; ++i) {
        EXPECT_LE(report.serial_ns[i], report.stage_ns[i]);
        all += report.stage_ns[i];
        serial += report.serial_ns[i];
      }
      EXPECT_LE(all, static_cast<uint64_t>(std::chrono::nanoseconds(time).count()));
      EXPECT_GT(serial, 0u);
      if (threads == 1) {
        EXPECT_EQ(serial, all);
      } else {
        EXPECT_LT(serial, all);
      }
    });
  }
}

TEST(PayForUse, DopsAreThereIfAskedForAndOfUse) {
  const CrowdSpec spec{.oriented = true};
  const auto bytes = [&](const WorldSettings& settings) {
    World world(settings);
    add_crowd(world, spec);
    world.step();
    return world.bytes();
  };
  const std::string with = "changes bounds broadphase pairs dops narrowphase results events";
  const std::string without = "changes bounds broadphase pairs narrowphase results events";
  EXPECT_EQ(first_step({}, spec), without);
  EXPECT_EQ(first_step({.dop_bounds = DopKind::k6}, spec), without);
  EXPECT_EQ(first_step({.detail = Detail::pairs, .dop_bounds = DopKind::k14}, spec),
            "bounds broadphase");
  EXPECT_EQ(bytes({.dop_bounds = DopKind::k6}), bytes({}));
  size_t last = bytes({});
  for (const DopKind kind : {DopKind::k14, DopKind::k18, DopKind::k26}) {
    EXPECT_EQ(first_step({.dop_bounds = kind}, spec), with);
    EXPECT_GE(bytes({.dop_bounds = kind}), last + 400 * 8 * sizeof(float) / 2);
    last = bytes({.dop_bounds = kind});
  }
}

TEST(PayForUse, DetailDecidesWhatThereIs) {
  for (const bool filters : {false, true}) {
    World worlds[] = {World({.detail = Detail::pairs}), World({.detail = Detail::overlap}),
                      World({.detail = Detail::contact}), World({.detail = Detail::manifold})};
    for (World& world : worlds) {
      add_crowd(world, {.filters = filters});
      world.step();
    }
    EXPECT_GT(worlds[2].contacts().size(), 0u);
    EXPECT_EQ(as_bytes(worlds[0].pairs()), as_bytes(worlds[2].pairs()));
    EXPECT_EQ(as_bytes(worlds[1].pairs()), as_bytes(worlds[2].pairs()));
    EXPECT_EQ(as_bytes(worlds[1].overlaps()), as_bytes(worlds[2].overlaps()));
    EXPECT_TRUE(worlds[0].overlaps().empty());
    EXPECT_TRUE(worlds[0].contacts().empty());
    EXPECT_TRUE(worlds[0].events().empty());
    EXPECT_EQ(worlds[0].report().tested, 0u);
    EXPECT_TRUE(worlds[1].contacts().empty());
    EXPECT_EQ(worlds[1].report().overlaps, worlds[2].report().overlaps);
    EXPECT_EQ(worlds[1].events().size(), worlds[2].events().size());
    EXPECT_LT(worlds[0].bytes(), worlds[1].bytes());
    EXPECT_LT(worlds[1].bytes(), worlds[2].bytes());
    EXPECT_LT(worlds[2].bytes(), worlds[3].bytes());
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(worlds[i].manifolds().empty());
    EXPECT_EQ(worlds[3].manifolds().size(), worlds[2].contacts().size());
  }
}

size_t bytes_with(const BodyDesc& last) {
  World world;
  for (int i = 0; i < 1000; ++i) world.add({.shape = Sphere{0.5f}, .position = {2.0 * i, 0, 0}});
  world.add(last);
  return world.bytes();
}

// Every optional property costs memory only from the first body on that uses it.
TEST(PayForUse, ColumnsThatNobodyNeedsDoNotExist) {
  const size_t plain = bytes_with({});
  EXPECT_EQ(bytes_with({.position = {1, 2, 3}}), plain);
  const auto grows_by = [&](const BodyDesc& body) { return bytes_with(body) - plain; };
  EXPECT_GE(grows_by({.shape = Aabb{}}), 1000 * sizeof(uint32_t));
  EXPECT_GE(grows_by({.linear_velocity = {1, 0, 0}}), 1000 * sizeof(Eigen::Vector3f));
  EXPECT_GE(grows_by({.angular_velocity = {1, 0, 0}}), 1000 * sizeof(Eigen::Vector3f));
  EXPECT_GE(grows_by({.detection = Detection::swept}), 1000 * sizeof(Detection));
  EXPECT_GE(grows_by({.motion = Motion::fixed}), 1000 * sizeof(Motion));
  EXPECT_GE(grows_by({.layer = 1}), 2 * 1000 * sizeof(uint32_t));
  EXPECT_GE(grows_by({.mask = 1}), 2 * 1000 * sizeof(uint32_t));
  EXPECT_GE(grows_by({.owner = 1}), 1000 * sizeof(uint32_t));
  EXPECT_GE(grows_by({.group = -1}), 1000 * sizeof(int32_t));
  EXPECT_GE(grows_by({.space = 1}), 1000 * sizeof(uint32_t));
  EXPECT_GE(grows_by({.sensor = true}), 1000u);
  EXPECT_GE(grows_by({.user = 1}), 1000 * sizeof(uint64_t));
  // Shapes with rows cost the index of the rows and the quaternion.
  for (const Shape& shape :
       {Shape(Box{}), Shape(Capsule{}), Shape(Triangle{}), Shape(Halfspace{})}) {
    EXPECT_GE(grows_by({.shape = shape}), 1000 * (sizeof(uint32_t) + 4 * sizeof(float)));
  }
}

TEST(PayForUse, ExcludedPairsCostMemoryWhileThereAreAny) {
  World world;
  const std::vector<BodyId> ids = add_crowd(world, {});
  for (int i = 0; i < 3; ++i) world.step();
  const size_t plain = world.memory().bodies;
  for (size_t i = 1; i < ids.size(); ++i) world.exclude(ids[i - 1], ids[i]);
  world.step();
  EXPECT_GE(world.memory().bodies, plain + (ids.size() - 1) * sizeof(Pair));
  for (size_t i = 1; i < ids.size(); ++i) world.include_again(ids[i - 1], ids[i]);
  world.step();
  EXPECT_EQ(world.memory().bodies, plain);
}

// Spheres and aabbs store no orientation, whatever the caller gives.
TEST(PayForUse, WithoutShapesThatTurnThereAreNoOrientations) {
  const Eigen::Quaternionf turn(1, 2, 3, 4);
  World turned, plain;
  for (BodyDesc body : make_crowd({.filters = true})) {
    plain.add(body);
    body.orientation = turn;
    turned.set_orientation(turned.add(body), turn);
  }
  for (int i = 0; i < 3; ++i) {
    plain.step();
    turned.step();
  }
  EXPECT_EQ(turned.bytes(), plain.bytes());
  EXPECT_EQ(turned.arrays().orientation, nullptr);
  EXPECT_EQ(turned.shape_rows().count, 0u);
  // The copy for finding changes is made with the columns.
  const size_t before = turned.memory().bodies;
  turned.add({.shape = Box{}});
  turned.step();
  EXPECT_GE(turned.memory().bodies, before + 400 * (sizeof(uint32_t) + 8 * sizeof(float)));
}

// A world in which no body looks ahead costs the same with any settings for looking ahead.
TEST(PayForUse, NobodyPaysForLookingAheadButThoseWhoDo) {
  const CrowdSpec spec{.oriented = true, .velocities = true};
  const std::string without =
      "changes bounds broadphase pairs narrowphase results velocities events";
  const std::string with =
      "changes bounds sweeps broadphase pairs narrowphase results impacts velocities events";
  World plain, settings({.dt = 10, .fast_share = 0, .impacts = Impacts::all});
  World passing;  // one body looked ahead, once
  for (World* world : {&plain, &settings, &passing}) add_crowd(*world, spec);
  const BodyId guest = passing.add({.position = {0, 0, 99}, .detection = Detection::continuous});
  plain.step();
  settings.step();
  EXPECT_EQ(stages_run(plain.report()), without);
  EXPECT_EQ(stages_run(settings.report()), without);
  EXPECT_EQ(stages_run(passing.step()), with);
  EXPECT_TRUE(results(plain) == results(settings));
  EXPECT_EQ(plain.bytes(), settings.bytes());
  EXPECT_GT(passing.memory().bounds, plain.memory().bounds + 400 * 6 * sizeof(float));
  passing.remove(guest);
  for (World* world : {&plain, &passing}) {
    for (int i = 0; i < 2; ++i) {
      world->set_position({7, 0}, {1.0 * i, 2, 3});
      world->step();
    }
  }
  EXPECT_EQ(stages_run(passing.report()), without);
  EXPECT_TRUE(results(passing) == results(plain));
  EXPECT_LE(passing.memory().bounds, plain.memory().bounds + 6 * sizeof(float)) << "of the guest";
  EXPECT_LE(passing.memory().bodies, plain.memory().bodies + 512) << "a byte a body";
}

// A slow automatic body costs only the check of its speed.
TEST(PayForUse, SlowAutomaticBodiesRunNoStage) {
  World world;
  add_crowd(world, {});
  world.add({.linear_velocity = {1e-9f, 0, 0}, .detection = Detection::automatic});
  world.set_shape({400, 0}, Sphere{1});
  EXPECT_EQ(stages_run(world.step()),
            "changes bounds broadphase pairs narrowphase results velocities events");
}

// The memory after some steps in which every body moved.
size_t bytes_in_use(const WorldSettings& settings) {
  World world(settings);
  const std::vector<BodyId> ids = add_crowd(world, {});
  const std::vector<BodyDesc> homes = make_crowd({});
  for (int i = 0; i < 6; ++i) {
    for (size_t k = 0; k < ids.size(); ++k) {
      world.set_position(ids[k], homes[k].position + Eigen::Vector3d(i % 2, 0, 0));
    }
    world.step();
  }
  return world.bytes();
}

TEST(PayForUse, WithoutCarryingOrEventsThereIsLessMemory) {
  const size_t all = bytes_in_use({});
  EXPECT_LT(bytes_in_use({.events = false}), all);
  EXPECT_LT(bytes_in_use({.carry_results = false}), all);
}

// Without carrying and events, no stage needs the last step's pairs.
TEST(PayForUse, WithoutCarryingAndEventsTheLastStepIsNotKept) {
  for_each_isa([] {
    for (const Detail detail : {Detail::pairs, Detail::overlap, Detail::contact}) {
      World world({.detail = detail, .events = false, .carry_results = false});
      add_crowd(world, {});
      world.step();
      const size_t bytes = world.bytes();
      for (int i = 0; i < 3; ++i) world.step();
      EXPECT_EQ(world.bytes(), bytes);
    }
  });
}

TEST(PayForUse, Float64CostsTwiceTheRecords) {
  World narrow, wide({.positions = PositionType::float64});
  for (World* world : {&narrow, &wide}) add_crowd(*world, {.boxes = false});
  EXPECT_GE(wide.bytes() - narrow.bytes(), 400 * 4 * (sizeof(double) - sizeof(float)));
}

}  // namespace
}  // namespace carom::test

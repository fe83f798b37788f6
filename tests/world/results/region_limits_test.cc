// Worlds at detail regions with limits of their own: contacts, points, names and what is left out
// are those of collide() with the same limits, also where they are carried from step to step.
#include <gtest/gtest.h>

#include <numeric>

#include "carom/base/thread_arena.h"
#include "carom/reference/reference.h"
#include "carom/results/result_arrays.h"
#include "tests/support/composites.h"
#include "tests/world/crowds.h"

namespace carom::test {
namespace {

constexpr RegionLimits kFewRegions{.cosine = 0.999, .most = 2};

// Bumpy ground, and compounds, small meshes and simple bodies in it.
std::vector<BodyId> add_pile(World& world) {
  Composites composites(11);
  Random& random = composites.random();
  std::vector<BodyId> ids;
  ids.push_back(world.add(
      {.shape = grid_mesh(8, 0.75f, [&](float, float) { return random.uniform(-0.2, 0.2); }),
       .position = {3, 3, 0},
       .motion = Motion::fixed}));
  for (size_t i = 0; i < 60; ++i) {
    BodyDesc body;
    body.shape = i % 3 == 0   ? Shape(composites.compound(0.8, 5))
                 : i % 3 == 1 ? Shape(composites.mesh(0.8, 10))
                              : random_shape(kOrientedKinds[random.below(4)], random);
    body.position = random_position(random, 6);
    body.position.z() /= 8;
    body.orientation = composites.orientation();
    ids.push_back(world.add(body));
  }
  return ids;
}

// The pairs of the world, tested by a call of their own.
struct Called {
  ContactRegions regions;
  size_t left_out = 0;

  Called(const World& world, std::span<const BodyId> ids) {
    std::vector<PlacedShape> bodies;
    for (const BodyId id : ids) {
      bodies.push_back({world.shape(id), world.position(id), world.orientation(id)});
    }
    const WorldSettings& settings = world.settings();
    const LaidOut view(bodies, {.positions = settings.positions});
    const ResultArrays rows(world.pairs().size(), Detail::manifold,
                            {ColumnRole::sub_shape, ColumnRole::name});
    EXPECT_TRUE(
        bool(collide(view.view(), view.view(), world.pairs(), Detail::regions, rows.columns(),
                     {.frame = WitnessFrame::body,
                      .contact_distance = settings.contact_distance,
                      .regions = &regions,
                      .region_limits = settings.region_limits})));
    for (const Contact& contact : regions.contacts) left_out += contact.left_out;
  }
};

std::string names_of(const World& world) {
  std::string names;
  for (const ContactIdentity& identity : world.identities()) {
    names += as_bytes(std::span<const uint64_t>(identity.names.point));
  }
  return names;
}

// Counts what the steps of a test had, so that it does not run empty.
struct StepsSeen {
  size_t left_out = 0;
  size_t kept_others = 0, kept_left_out = 0;  // of pairs of bodies at rest
};

void expect_called(const World& world, std::span<const BodyId> ids,
                   std::span<const uint8_t> has_moved, StepsSeen& seen) {
  const Called called(world, ids);
  ASSERT_EQ(as_bytes(world.contacts()),
            as_bytes(std::span(std::as_const(called.regions.contacts))));
  ASSERT_EQ(as_bytes(world.manifolds()),
            as_bytes(std::span(std::as_const(called.regions.manifolds))));
  ASSERT_EQ(names_of(world), as_bytes(std::span(std::as_const(called.regions.point_names))));
  ASSERT_EQ(world.report().left_out, called.left_out);
  seen.left_out += called.left_out;
  for (size_t i = 0; i < world.contacts().size();) {
    const std::span<const Contact> run = contact_run(world.contacts(), i);
    ASSERT_LE(run.size(), world.settings().region_limits.most);
    if (!has_moved[run[0].a] && !has_moved[run[0].b]) {
      seen.kept_others += run.size() - 1;
      seen.kept_left_out += run[0].left_out;
    }
    i += run.size();
  }
}

// Some bodies move in each step but the third, in which all rest.
void expect_called_every_step(const WorldSettings& settings) {
  World world(settings);
  const std::vector<BodyId> ids = add_pile(world);
  Random random(3);
  std::vector<uint8_t> has_moved(ids.size(), 1);
  StepsSeen seen;
  for (int step = 0; step < 6; ++step) {
    world.step();
    expect_called(world, ids, has_moved, seen);
    if (testing::Test::HasFatalFailure()) return;
    EXPECT_EQ(world.report().kept > 0, settings.carry_results && step > 0);
    has_moved.assign(ids.size(), 0);
    if (step == 2) continue;
    for (size_t i = 1; i < ids.size(); ++i) {
      has_moved[i] = random.chance(0.2);
      if (!has_moved[i]) continue;
      world.set_position(ids[i], world.position(ids[i]) + random.direction() * 0.05);
    }
  }
  EXPECT_GT(seen.left_out, 150u);
  EXPECT_GT(seen.kept_others, 50u);
  EXPECT_GT(seen.kept_left_out, 50u);
}

TEST(RegionLimits, OfAWorldAreThoseOfCollide) {
  for (const PositionType positions : kPositionTypes) {
    for (const float distance : {0.0f, 0.1f}) {
      for (const bool carries : {true, false}) {
        expect_called_every_step({.positions = positions,
                                  .detail = Detail::regions,
                                  .region_limits = kFewRegions,
                                  .contact_distance = distance,
                                  .carry_results = carries,
                                  .identities = true});
      }
    }
  }
}

TEST(RegionLimits, OfAWorldOnThreads) {
  ThreadArena arena(2);
  arena.run([&] {
    expect_called_every_step({.detail = Detail::regions,
                              .parallelism = arena.parallelism(),
                              .region_limits = kFewRegions,
                              .identities = true});
  });
}

// A box in a corner of three planes at rest: the limit counts in every step, and for its pair
// alone.
TEST(RegionLimits, CountWhatIsLeftOutInEveryStep) {
  const Mesh corner = mesh_of({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}},
                              {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}}, {.one_sided = true});
  for (const uint32_t most : {1u, 2u, 3u}) {
    World world({.detail = Detail::regions, .region_limits = {.most = most}});
    world.add({.shape = corner, .motion = Motion::fixed});
    world.add({.shape = Box{{0.5f, 0.5f, 0.5f}}, .position = {0.4375, 0.46875, 0.484375}});
    const BodyId ball = world.add({.shape = Sphere{0.25f}, .position = {1.5, 1.5, 0.125}});
    for (int step = 0; step < 4; ++step) {
      world.step();
      ASSERT_EQ(world.contacts().size(), most + 1);
      EXPECT_EQ(world.contacts()[0].left_out, 3 - most);
      EXPECT_EQ(world.report().left_out, 3 - most);
      for (const Contact& contact : world.contacts().subspan(1)) EXPECT_EQ(contact.left_out, 0);
      if (step == 1) world.set_position(ball, {1.5, 1.75, 0.125});
    }
    world.set_sensor(world.id_of(1), true);
    world.step();
    EXPECT_EQ(world.contacts().size(), 1u);
    EXPECT_EQ(world.report().left_out, 0u);
  }
}

// The limits are those of regions: a manifold does not depend on them, in the reference either.
TEST(RegionLimits, DoNotCountAtOtherDetails) {
  const Mesh steps =
      mesh_of({{-1, -1, 0}, {1, -1, 0}, {1, 0, 0}, {-1, 0, 0}, {1, 1, 1}, {-1, 1, 1}},
              {{0, 1, 2}, {0, 2, 3}, {3, 2, 4}, {3, 4, 5}});
  const std::vector<reference::Body> bodies = {
      {{0, 0}, {.shape = steps}},
      {{1, 0}, {.shape = Box{{0.5f, 0.5f, 0.5f}}, .position = {0, -0.4, 0.2}}}};
  const reference::Frame expected = reference::step(bodies, {.detail = Detail::manifold});
  const RegionLimits wide{.cosine = -0.5, .most = 16};
  const reference::Frame limited =
      reference::step(bodies, {.detail = Detail::manifold, .contacts = {.region_limits = wide}});
  World world({.detail = Detail::manifold, .region_limits = wide});
  for (const reference::Body& body : bodies) world.add(body.desc);
  world.step();
  ASSERT_EQ(expected.manifolds.size(), 1u);
  EXPECT_TRUE(as_bytes(std::span<const ManifoldPoints>(limited.manifolds)) ==
              as_bytes(std::span<const ManifoldPoints>(expected.manifolds)));
  EXPECT_TRUE(as_bytes(world.manifolds()) ==
              as_bytes(std::span<const ManifoldPoints>(expected.manifolds)));
}

}  // namespace
}  // namespace carom::test

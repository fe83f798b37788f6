// Normal velocities of contacts of bodies that turn, against the velocities of their witness points
// in double precision.
#include <gtest/gtest.h>

#include "carom/base/thread_arena.h"
#include "tests/support/composites.h"
#include "tests/world/crowds.h"

namespace carom::test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

// How many contacts there were in which turning counts, by whether the bodies have parts, and how
// many of them were apart.
struct TurningCounts {
  size_t simple = 0, meshes = 0, compounds = 0, apart = 0;
};

// The velocity of the point of a body: spheres and aabbs do not turn.
Vector3d velocity_at(const World& world, BodyId id, const Vector3f& arm, bool turns) {
  const Vector3d linear = world.linear_velocity(id).cast<double>();
  const ShapeKind kind = kind_of(world.shape(id));
  if (!turns || kind == ShapeKind::sphere || kind == ShapeKind::aabb) return linear;
  return linear + world.angular_velocity(id).cast<double>().cross(arm.cast<double>());
}

void expect_velocities(const World& world, std::span<const Contact> contacts,
                       TurningCounts& counts) {
  for (const Contact& contact : contacts) {
    const BodyId a = world.id_of(contact.a), b = world.id_of(contact.b);
    const auto along_normal = [&](bool turns) {
      const Vector3d v =
          velocity_at(world, b, contact.arm_b, turns) - velocity_at(world, a, contact.arm_a, turns);
      return v.dot(contact.normal.cast<double>());
    };
    const double expected = along_normal(true);
    const double size = world.linear_velocity(a).norm() + world.linear_velocity(b).norm() +
                        world.angular_velocity(a).norm() * contact.arm_a.norm() +
                        world.angular_velocity(b).norm() * contact.arm_b.norm();
    ASSERT_NEAR(contact.normal_velocity, expected, 1e-6 * size);
    if (std::abs(expected - along_normal(false)) < 0.01 * size) continue;
    const auto has = [&](ShapeKind kind) {
      return kind_of(world.shape(a)) == kind || kind_of(world.shape(b)) == kind;
    };
    counts.meshes += has(ShapeKind::mesh);
    counts.compounds += has(ShapeKind::compound);
    counts.simple += !has(ShapeKind::mesh) && !has(ShapeKind::compound);
    counts.apart += contact.separation > 0;
  }
}

// Bodies of all kinds that move and turn.
std::vector<BodyId> add_turning_bodies(World& world, bool looks_ahead) {
  std::vector<BodyDesc> bodies = make_crowd({.count = 160, .side = 6, .oriented = true});
  Composites composites(41);
  Random& random = composites.random();
  for (size_t i = 0; i < 60; ++i) {
    bodies.push_back({.shape = i % 2 ? Shape(composites.mesh(0.8)) : composites.compound(0.8),
                      .position = random_position(random, 6),
                      .orientation = composites.orientation()});
  }
  for (BodyDesc& body : bodies) {
    body.linear_velocity = (random.direction() * random.uniform(0, 3)).cast<float>();
    body.angular_velocity = (random.direction() * random.uniform(0, 9)).cast<float>();
    if (looks_ahead && random.chance(0.7)) body.detection = Detection::swept;
  }
  std::vector<BodyId> ids;
  world.add(bodies, ids);
  return ids;
}

TEST(TurningContacts, HaveTheVelocitiesOfTheirPoints) {
  for (const Detail detail : {Detail::contact, Detail::manifold, Detail::regions}) {
    for (const PositionType positions : kPositionTypes) {
      World world({.positions = positions, .detail = detail, .contact_distance = 0.1f});
      const std::vector<BodyId> ids = add_turning_bodies(world, false);
      Random random(42);
      TurningCounts counts;
      for (int step = 0; step < 4; ++step) {
        world.step();
        expect_velocities(world, world.contacts(), counts);
        ASSERT_FALSE(HasFatalFailure());
        // Velocities change between all steps. Poses do not between the first two: their contacts
        // are kept.
        for (const BodyId id : ids) {
          world.angular_velocities()[id.index] = (random.direction() * 5).cast<float>();
          if (random.chance(0.2)) world.set_angular_velocity(id, Vector3f::Zero());
        }
        if (step > 0) turn_some(world, ids, 0.3, random);
      }
      EXPECT_GT(counts.simple, 200u);
      EXPECT_GT(counts.meshes, 200u);
      EXPECT_GT(counts.compounds, 200u);
      EXPECT_GT(counts.apart, 200u);
    }
  }
}

// Contacts of several blocks of pairs: written, copied from the last step, and left in their
// places.
TEST(TurningContacts, OfManyBodiesOfWhichSomeMove) {
  struct Setting {
    int threads;
    Detail detail;
    bool identities;
  };
  for (const Setting& setting :
       {Setting{1, Detail::contact, false}, Setting{1, Detail::manifold, false},
        Setting{1, Detail::regions, true}, Setting{3, Detail::manifold, true}}) {
    ThreadArena arena(setting.threads);
    arena.run([&] {
      WorldSettings settings{.detail = setting.detail, .parallelism = arena.parallelism()};
      settings.identities = setting.identities;
      World world(settings);
      settings.carry_results = false;
      World testing(settings);  // keeps nothing
      const CrowdSpec crowd{.count = 9000, .side = 19, .oriented = true, .velocities = true};
      const std::vector<BodyId> ids = add_crowd(world, crowd);
      add_crowd(testing, crowd);
      Random one(43), two(43), random(44);
      TurningCounts counts;
      for (const double share : {1.0, 0.3, 0.01, 0.01, 0.0, 0.01}) {
        move_some(world, ids, share, one);
        move_some(testing, ids, share, two);
        // Velocities of bodies that rest change as well.
        for (const BodyId id : ids) {
          const Vector3f linear = (random.direction() * 3).cast<float>();
          const Vector3f angular = (random.direction() * 5).cast<float>();
          for (World* each : {&world, &testing}) {
            each->linear_velocities()[id.index] = linear;
            each->angular_velocities()[id.index] = angular;
          }
        }
        const StepReport& report = world.step();
        testing.step();
        ASSERT_TRUE(results(world) == results(testing));
        EXPECT_GT(report.pairs, size_t{3 * 4096});
        EXPECT_TRUE(report.ran(Stage::velocities));
        expect_velocities(world, world.contacts(), counts);
        ASSERT_FALSE(HasFatalFailure());
      }
      EXPECT_GT(counts.simple, 10000u);
      EXPECT_GT(world.report().kept, world.report().pairs / 2);
    });
  }
}

TEST(TurningContacts, SpeculativeOnesHaveThemToo) {
  for (const Detail detail : {Detail::contact, Detail::regions}) {
    World world({.detail = detail, .dt = 0.2});
    add_turning_bodies(world, true);
    TurningCounts counts;
    world.step();
    expect_velocities(world, world.speculative_contacts(), counts);
    for (const Contact& contact : world.speculative_contacts()) {
      EXPECT_LE(contact.separation + contact.normal_velocity * 0.2, 1e-5);
    }
    EXPECT_GT(counts.simple, 30u);
    EXPECT_GT(counts.meshes, 30u);
    EXPECT_GT(counts.compounds, 30u);
    EXPECT_GT(counts.apart, 60u);
  }
}

// A rod in the floor tips: its end, two metres from its middle, goes down.
TEST(TurningContacts, OfARodThatTips) {
  for (const bool as_mesh : {false, true}) {
    World world;
    const Shape ground = as_mesh ? Shape(flat_grid(8, 1)) : Shape(Halfspace{});
    world.add({.shape = ground, .motion = Motion::fixed});
    const BodyId rod = world.add({.shape = Capsule{{-2, 0, 0}, {2, 0, -0.25f}, 0.25f},
                                  .position = {0.3, 0.2, 0.4375},
                                  .linear_velocity = {5, 5, 0.25f}});
    world.step();
    ASSERT_EQ(world.contacts().size(), 1u);
    EXPECT_NEAR(world.contacts()[0].normal_velocity, 0.25, 1e-6);
    world.set_angular_velocity(rod, {0, 0.5f, 0});
    world.step();
    EXPECT_NEAR(world.contacts()[0].normal_velocity, 0.25 - 0.5 * 2, 1e-5);
  }
}

}  // namespace
}  // namespace carom::test

// Which contacts and points continue those of the last step.
#include <gtest/gtest.h>

#include <set>

#include "carom/base/thread_arena.h"
#include "carom/simd/isa.h"
#include "tests/support/composites.h"
#include "tests/world/crowds.h"

namespace carom::test {
namespace {

using Eigen::Vector3f;

constexpr CrowdSpec kIdentityCrowd{
    .oriented = true, .halfspaces = 2, .filters = true, .velocities = true};
constexpr WorldSettings kIdentitySettings{.detail = Detail::manifold, .identities = true};

// What a step leaves for the next one to be compared with.
struct Before {
  std::vector<Contact> contacts;
  std::vector<ContactIdentity> identities;

  explicit Before(const World& world)
      : contacts(world.contacts().begin(), world.contacts().end()),
        identities(world.identities().begin(), world.identities().end()) {}
};

bool is_same_pair(const Contact& x, const Contact& y) { return x.a == y.a && x.b == y.b; }

// Checks what must hold of any identities: previous points belong to the pair, none is continued
// twice, and one of the same name is continued if there is one.
void expect_consistent(const World& world, const Before& before, size_t& continued) {
  ASSERT_EQ(world.identities().size(), world.contacts().size());
  std::set<uint32_t> taken;
  for (size_t c = 0; c < world.contacts().size(); ++c) {
    const Contact& contact = world.contacts()[c];
    const ContactIdentity& identity = world.identities()[c];
    for (size_t k = 0; k < 4; ++k) {
      const bool used = k < contact.manifold_count;
      ASSERT_EQ(identity.names.point[k] != 0, used);
      const uint32_t previous = identity.previous_point[k];
      if (previous == kNoPrevious) continue;
      ASSERT_TRUE(used);
      ASSERT_TRUE(taken.insert(previous).second);
      ASSERT_LT(previous / 4, before.contacts.size());
      const Contact& old = before.contacts[previous / 4];
      ASSERT_TRUE(is_same_pair(contact, old));
      ASSERT_LT(previous % 4, old.manifold_count);
      ++continued;
    }
    if (identity.previous != kNoPrevious) {
      ASSERT_TRUE(is_same_pair(contact, before.contacts[identity.previous]));
    }
  }
}

TEST(Identities, AreConsistentWhileBodiesMove) {
  for (const Detail detail : {Detail::manifold, Detail::regions}) {
    World world({.detail = detail, .contact_distance = 0.05f, .identities = true});
    const std::vector<BodyId> ids = add_crowd(world, kIdentityCrowd);
    Random random(5);
    size_t continued = 0, points = 0;
    world.step();
    for (int frame = 0; frame < 15; ++frame) {
      const Before before(world);
      move_some(world, ids, 0.3, random);
      world.step();
      expect_consistent(world, before, continued);
      for (const Contact& contact : world.contacts()) points += contact.manifold_count;
      ASSERT_FALSE(HasFatalFailure());
    }
    EXPECT_GT(continued, points / 2);
  }
}

TEST(Identities, OfAStillStepContinueThemselves) {
  World world(kIdentitySettings);
  add_crowd(world, kIdentityCrowd);
  world.step();
  for (const ContactIdentity& identity : world.identities()) {
    EXPECT_EQ(identity.previous, kNoPrevious);
    for (const uint32_t previous : identity.previous_point) EXPECT_EQ(previous, kNoPrevious);
  }
  for (int frame = 0; frame < 3; ++frame) {
    world.step();
    ASSERT_GT(world.contacts().size(), 100u);
    for (uint32_t c = 0; c < world.contacts().size(); ++c) {
      const ContactIdentity& identity = world.identities()[c];
      EXPECT_EQ(identity.previous, c);
      for (uint32_t k = 0; k < 4; ++k) {
        EXPECT_EQ(identity.previous_point[k],
                  k < world.contacts()[c].manifold_count ? point_place(c, k) : kNoPrevious);
      }
    }
  }
}

// A box that slides over the ground keeps its four corners, wherever contacts before it come from.
TEST(Identities, OfABoxThatSlidesAndTurns) {
  World world(kIdentitySettings);
  const BodyId ground = world.add({.shape = Halfspace{}});
  const BodyId box = world.add({.shape = Box{{1, 2, 0.5f}}, .position = {0, 0, 0.4375}});
  std::set<uint64_t> names;
  (void)ground;
  for (int step = 0; step < 100; ++step) {
    world.set_position(box, {0.01 * step, 0.003 * step, 0.4375});
    const Eigen::AngleAxisf turn(0.002f * float(step), Vector3f::UnitZ());
    world.set_orientation(box, Orientation(Eigen::Quaternionf(turn)));
    world.step();
    ASSERT_EQ(world.contacts().size(), 1u);
    ASSERT_EQ(world.contacts()[0].manifold_count, 4);
    for (size_t k = 0; k < 4; ++k) {
      names.insert(world.identities()[0].names.point[k]);
      if (step > 0) {
        EXPECT_NE(world.identities()[0].previous_point[k], kNoPrevious);
      }
    }
  }
  EXPECT_EQ(names.size(), 4u);
}

TEST(Identities, ARemovedBodyContinuesNothing) {
  World world({.identities = true});
  world.add({.shape = Sphere{1}});
  const BodyId second = world.add({.shape = Sphere{1}, .position = {1, 0, 0}});
  world.step();
  world.step();
  ASSERT_EQ(world.identities().size(), 1u);
  EXPECT_EQ(world.identities()[0].previous, 0u);
  ASSERT_TRUE(world.remove(second));
  const BodyId third = world.add({.shape = Sphere{1}, .position = {1, 0, 0}});
  ASSERT_EQ(third.index, second.index);
  world.step();
  ASSERT_EQ(world.identities().size(), 1u);
  EXPECT_EQ(world.identities()[0].previous, kNoPrevious);
}

// Where results are carried, what continues what is the same as where everything is tested anew.
TEST(Identities, DoNotDependOnCarriedResults) {
  WorldSettings settings = kIdentitySettings;
  World carrying(settings);
  settings.carry_results = false;
  World testing(settings);
  const std::vector<BodyId> ids = add_crowd(carrying, kIdentityCrowd);
  add_crowd(testing, kIdentityCrowd);
  Random one(5), two(5);
  for (int frame = 0; frame < 10; ++frame) {
    carrying.step();
    testing.step();
    ASSERT_EQ(as_bytes(carrying.identities()), as_bytes(testing.identities())) << frame;
    move_some(carrying, ids, 0.2, one);
    move_some(testing, ids, 0.2, two);
  }
}

TEST(Identities, AreTheSameOnEveryIsaAndOnThreads) {
  const auto all = [](Detail detail) {
    World world({.detail = detail, .contact_distance = 0.1f, .identities = true});
    const std::vector<BodyId> ids = add_crowd(world, kIdentityCrowd);
    world.add({.shape = flat_grid(6, 1), .position = {0, 0, 1}, .motion = Motion::fixed});
    Random random(5);
    std::string bytes;
    for (int frame = 0; frame < 4; ++frame) {
      world.step();
      bytes += as_bytes(world.identities());
      move_some(world, ids, 0.5, random);
    }
    return bytes;
  };
  for (const Detail detail : {Detail::contact, Detail::manifold, Detail::regions}) {
    const std::string expected = all(detail);
    ASSERT_GT(expected.size(), 1000u);
    for (const Isa isa : usable_isas()) {
      ASSERT_TRUE(force_isa(isa));
      EXPECT_EQ(all(detail), expected);
    }
    unforce_isa();
    ThreadArena arena(3);
    arena.run([&] { EXPECT_EQ(all(detail), expected); });
  }
}

TEST(Identities, AreThereOnlyIfAskedFor) {
  World world;
  add_crowd(world, kIdentityCrowd);
  world.step();
  EXPECT_FALSE(world.contacts().empty());
  EXPECT_TRUE(world.identities().empty());
}

}  // namespace
}  // namespace carom::test

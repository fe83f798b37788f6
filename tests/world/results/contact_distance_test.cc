// Contacts before bodies touch: random histories against the reference, and what they must not
// change.
#include <gtest/gtest.h>

#include "carom/base/thread_arena.h"
#include "carom/simd/isa.h"
#include "tests/support/rounds.h"
#include "tests/world/histories.h"

namespace carom::test {
namespace {

void run_history(const WorldSettings& settings, uint32_t seed, bool looks_ahead,
                 Coverage& coverage) {
  SCOPED_TRACE(::testing::Message() << "seed " << seed);
  History history(settings, seed, seed % 4 == 0 ? Kinds::spheres_and_aabbs : Kinds::all);
  if (looks_ahead) history.look_ahead();
  if (seed % 3 != 0) history.keep_distance();
  history.coverage = coverage;
  const double side = history.uniform(3, 8);
  for (int i = 0; i < 60; ++i) history.add(history.random_body(side, true));
  for (int step = 0; step < 8; ++step) {
    history.move(history.uniform(0, 1), 0.2);
    history.turn(history.uniform(0, 1));
    for (int i = 0; i < 3; ++i) history.change_random_body(side, true);
    history.remove_random();
    history.add(history.random_body(side, true));
    if (looks_ahead) history.change_motions(0.3);
    history.step_and_check();
    if (::testing::Test::HasFailure()) return;
  }
  coverage = history.coverage;
}

WorldSettings settings_of(uint32_t seed) {
  constexpr Detail kDetails[] = {Detail::contact, Detail::manifold, Detail::regions};
  WorldSettings settings;
  settings.positions = seed % 2 ? PositionType::float64 : PositionType::float32;
  settings.broadphase = seed % 5 ? BroadphaseMethod::automatic : BroadphaseMethod::grid;
  settings.carry_results = seed % 7 != 0;
  settings.detail = kDetails[seed % 3];
  settings.contact_distance = seed % 4 < 2 ? 0.3f : 0;
  if (seed % 6 == 0) settings.dop_bounds = DopKind::k18;
  return settings;
}

TEST(ContactDistance, HistoriesMatchTheReference) {
  Coverage coverage;
  for (uint32_t seed = 0; seed < rounds(300); ++seed) {
    run_history(settings_of(seed), seed, false, coverage);
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(coverage.near, rounds(10000));
  EXPECT_GT(coverage.kept, coverage.pairs / 10);
  for (size_t points = 1; points <= 4; ++points) {
    EXPECT_GT(coverage.manifolds[points], rounds(1000)) << points;
  }
}

TEST(ContactDistance, HistoriesThatLookAheadMatchTheReference) {
  Coverage coverage;
  for (uint32_t seed = 0; seed < rounds(60); ++seed) {
    run_history(settings_of(seed), seed, true, coverage);
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(coverage.near, rounds(1000));
  EXPECT_GT(coverage.speculative, rounds(100));
}

TEST(ContactDistance, HistoriesMatchTheReferenceOnEveryIsaAndOnThreads) {
  Coverage coverage;
  for (const Isa isa : usable_isas()) {
    ASSERT_TRUE(force_isa(isa));
    for (uint32_t seed = 500; seed < 506; ++seed) {
      run_history(settings_of(seed), seed, false, coverage);
    }
  }
  unforce_isa();
  ThreadArena arena(4);
  arena.run([&] {
    for (uint32_t seed = 600; seed < 606; ++seed) {
      run_history(settings_of(seed), seed, false, coverage);
    }
  });
}

constexpr CrowdSpec kDistanceCrowd{
    .oriented = true, .halfspaces = 2, .filters = true, .velocities = true};

// Contacts of separate pairs are left out.
std::vector<Contact> touching(const World& world) {
  std::vector<Contact> contacts;
  for (const Contact& contact : world.contacts()) {
    if (contact.separation <= 0) contacts.push_back(contact);
  }
  return contacts;
}

TEST(ContactDistance, ChangesNoOverlapAndNoEvent) {
  World with({.contact_distance = 0.25f}), without;
  const std::vector<BodyId> ids = add_crowd(with, kDistanceCrowd);
  add_crowd(without, kDistanceCrowd);
  Random one(3), two(3);
  size_t near = 0;
  for (int frame = 0; frame < 6; ++frame) {
    with.step();
    without.step();
    EXPECT_EQ(with.report().overlaps, without.report().overlaps);
    ASSERT_EQ(with.events().size(), without.events().size());
    for (size_t i = 0; i < with.events().size(); ++i) {
      Event event = with.events()[i];
      event.contact = without.events()[i].contact;  // indices count the others, too
      EXPECT_EQ(std::memcmp(&event, &without.events()[i], sizeof event), 0);
    }
    const std::vector<Contact> contacts = touching(with);
    EXPECT_EQ(as_bytes(std::span<const Contact>(contacts)), as_bytes(without.contacts()));
    near += with.contacts().size() - contacts.size();
    move_some(with, ids, 0.5, one);
    move_some(without, ids, 0.5, two);
  }
  EXPECT_GT(near, 300u);
}

TEST(ContactDistance, AMarginChangesNoContact) {
  World with({.detail = Detail::manifold, .contact_distance = 0.1f, .margin = 0.2f});
  World without({.detail = Detail::manifold, .contact_distance = 0.1f});
  const std::vector<BodyId> ids = add_crowd(with, kDistanceCrowd);
  add_crowd(without, kDistanceCrowd);
  Random one(3), two(3);
  for (int frame = 0; frame < 10; ++frame) {
    with.step();
    without.step();
    EXPECT_EQ(as_bytes(with.contacts()), as_bytes(without.contacts())) << frame;
    EXPECT_EQ(as_bytes(with.manifolds()), as_bytes(without.manifolds())) << frame;
    move_some(with, ids, 0.3, one);
    move_some(without, ids, 0.3, two);
  }
}

// The larger distance of the two bodies counts.
TEST(ContactDistance, OfTwoBodies) {
  const auto has_contact = [](float of_world, float of_a, float of_b, double gap) {
    World world({.contact_distance = of_world});
    world.add({.shape = Sphere{1}, .contact_distance = of_a});
    world.add({.shape = Sphere{1}, .position = {2 + gap, 0, 0}, .contact_distance = of_b});
    world.step();
    EXPECT_TRUE(world.overlaps().empty() || world.overlaps()[0] == 0);
    EXPECT_TRUE(world.events().empty());
    if (!world.contacts().empty()) {
      EXPECT_EQ(world.contacts()[0].separation, static_cast<float>(gap));
    }
    return !world.contacts().empty();
  };
  EXPECT_TRUE(has_contact(0.5f, 0, 0, 0.5));
  EXPECT_FALSE(has_contact(0.5f, 0, 0, 0.5625));
  EXPECT_TRUE(has_contact(0, 0.5f, 0.25f, 0.5));
  EXPECT_TRUE(has_contact(0, 0.25f, 0.5f, 0.5));
  EXPECT_FALSE(has_contact(0, 0.5f, 0.5f, 0.75));
  EXPECT_TRUE(has_contact(0.125f, 0, 0.75f, 0.75));
  EXPECT_FALSE(has_contact(0, 0, 0, 0.125));
}

// A box that hovers over the ground has the points of one that lies on it.
TEST(ContactDistance, GivesWholeManifolds) {
  World world({.detail = Detail::manifold, .contact_distance = 0.25f});
  world.add({.shape = Box{{1, 2, 0.5f}}, .position = {10, 20, 0.625}});
  world.add({.shape = Halfspace{}});
  world.add({.shape = Box{{4, 4, 0.5f}}, .position = {10, 20, 1.75}});
  world.step();
  ASSERT_EQ(world.contacts().size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(world.contacts()[i].separation, 0.125f);
    ASSERT_EQ(world.contacts()[i].manifold_count, 4);
    for (const float separation : world.manifolds()[i].separation) EXPECT_EQ(separation, 0.125f);
  }
}

TEST(ContactDistance, CostsNoMemoryUnlessItIsUsed) {
  World with({.contact_distance = 0.1f}), without;
  add_crowd(with, kDistanceCrowd);
  add_crowd(without, kDistanceCrowd);
  with.step();
  without.step();
  EXPECT_GE(with.memory().bounds,
            without.memory().bounds + 6 * sizeof(float) * kDistanceCrowd.count);
}

}  // namespace
}  // namespace carom::test

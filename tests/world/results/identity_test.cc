// Which contacts and points continue those of the last step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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
  std::vector<ManifoldPoints> manifolds;

  explicit Before(const World& world)
      : contacts(world.contacts().begin(), world.contacts().end()),
        identities(world.identities().begin(), world.identities().end()),
        manifolds(world.manifolds().begin(), world.manifolds().end()) {}
};

bool is_same_pair(const Contact& x, const Contact& y) { return x.a == y.a && x.b == y.b; }

// A point of a contact, in one of two steps.
struct NamedPoint {
  uint32_t place;
  uint64_t name;
  Vector3f at;
  float reach;  // how far away a point of another name may be
};

std::vector<NamedPoint> points_of(const Before& step, const Contact& pair) {
  std::vector<NamedPoint> points;
  for (uint32_t c = 0; c < step.contacts.size(); ++c) {
    const Contact& contact = step.contacts[c];
    if (!is_same_pair(contact, pair)) continue;
    for (uint32_t k = 0; k < contact.manifold_count; ++k) {
      const std::array<float, 3>& at = step.manifolds[c].point[k];
      points.push_back({point_place(c, k),
                        step.identities[c].names.point[k],
                        {at[0], at[1], at[2]},
                        std::min(contact.arm_a.norm(), contact.arm_b.norm()) / 4});
    }
  }
  return points;
}

// How points found those that they continue.
struct Matches {
  size_t by_name = 0, by_name_past_a_nearer = 0, by_distance = 0, too_far = 0;
};

// The rule as its header states it: points of the same name first, then the nearest ones that are
// left.
void expect_rule(const Before& before, const Before& now, const Contact& pair, Matches& matches) {
  std::vector<NamedPoint> left = points_of(before, pair);
  std::vector<NamedPoint> rest;
  const auto previous = [&](const NamedPoint& point) {
    return now.identities[point.place / 4].previous_point[point.place % 4];
  };
  for (const NamedPoint& point : points_of(now, pair)) {
    const auto same = std::find_if(left.begin(), left.end(),
                                   [&](const NamedPoint& old) { return old.name == point.name; });
    if (same == left.end()) {
      rest.push_back(point);
      continue;
    }
    ASSERT_EQ(previous(point), same->place);
    ++matches.by_name;
    const float distance = (same->at - point.at).norm();
    matches.by_name_past_a_nearer += std::any_of(left.begin(), left.end(), [&](const auto& old) {
      return (old.at - point.at).norm() < distance;
    });
    left.erase(same);
  }
  for (const NamedPoint& point : rest) {
    const auto nearest =
        std::min_element(left.begin(), left.end(), [&](const NamedPoint& x, const NamedPoint& y) {
          return (x.at - point.at).norm() < (y.at - point.at).norm();
        });
    const float distance = nearest == left.end() ? INFINITY : (nearest->at - point.at).norm();
    if (std::abs(distance - point.reach) <= 1e-5f * point.reach) return;  // rounding decides
    if (distance < point.reach) {
      ASSERT_EQ(previous(point), nearest->place);
      ++matches.by_distance;
      left.erase(nearest);
    } else {
      ASSERT_EQ(previous(point), kNoPrevious);
      matches.too_far += nearest != left.end();
    }
  }
}

// Checks what must hold of any identities: previous points belong to the pair, and none is
// continued twice.
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
    Matches matches;
    world.step();
    for (int frame = 0; frame < 15; ++frame) {
      const Before before(world);
      move_some(world, ids, 0.3, random);
      world.step();
      expect_consistent(world, before, continued);
      const Before now(world);
      for (size_t c = 0; c < now.contacts.size(); ++c) {
        const bool is_first = c == 0 || !is_same_pair(now.contacts[c], now.contacts[c - 1]);
        if (is_first) expect_rule(before, now, now.contacts[c], matches);
        points += now.contacts[c].manifold_count;
      }
      ASSERT_FALSE(HasFatalFailure());
    }
    EXPECT_GT(continued, points / 2);
    EXPECT_GT(matches.by_name, points / 2);
    EXPECT_GT(matches.by_name_past_a_nearer, 10u);
    EXPECT_GT(matches.by_distance, 10u);
    EXPECT_GT(matches.too_far, 10u);
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

// Hulls that fly within a tolerance: shells of the last step prove most depths, and none is wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "carom/base/thread_arena.h"
#include "oracle/hull_faces.h"
#include "tests/support/hulls.h"
#include "tests/support/isas.h"
#include "tests/support/rounds.h"
#include "tests/world/crowds.h"
#include "tests/world/tolerance.h"

namespace carom::test {
namespace {

constexpr float kTolerance = 0.01f;

// Bodies that go straight ahead and turn, each by several tolerances a step.
class FlyingHulls {
 public:
  FlyingHulls(const WorldSettings& settings, size_t count, uint64_t seed)
      : world_(settings), random_(seed), side_(std::cbrt(static_cast<double>(count)) * 0.9) {
    for (size_t points : {8, 24, 48}) {
      shapes_.push_back(oracle::hull_of(round_points(points, {0.5f, 0.5f, 0.4f}, random_)));
      shapes_.push_back(oracle::hull_of(round_points(points, {0.4f, 0.5f, 0.5f}, random_)));
    }
    for (size_t i = 0; i < count; ++i) add();
  }

  World& world() { return world_; }

  void step() {
    for (Flight& flight : flights_) {
      if (flight.rests) continue;
      const BodyId id = flight.id;
      world_.set_position(id, world_.position(id) + flight.way);
      world_.set_orientation(id, world_.orientation(id) * flight.turn);
    }
    world_.step();
  }

  // Bodies come, go, stop, jump, and become hulls of as many other points.
  void disturb() {
    for (int i = 0; i < 3; ++i) {
      Flight& flight = flights_[random_.below(flights_.size())];
      const size_t what = random_.below(5);
      if (what == 0) {
        world_.remove(flight.id);
        flight = flights_.back();
        flights_.pop_back();
        add();
      } else if (what == 1) {
        flight.rests = !flight.rests;
      } else if (what == 2) {
        world_.set_position(flight.id, place());
      } else if (what == 3) {
        flight.shape ^= 1;
        world_.set_shape(flight.id, shapes_[flight.shape]);
      } else {
        flight.way = -flight.way;
      }
    }
  }

 private:
  struct Flight {
    BodyId id;
    size_t shape;
    Eigen::Vector3d way;
    Eigen::Quaternionf turn;
    bool rests = false;
  };

  Eigen::Vector3d place() {
    return {random_.uniform(0, side_), random_.uniform(0, side_), random_.uniform(0, side_)};
  }

  void add() {
    Flight flight;
    flight.shape = random_.below(shapes_.size());
    BodyDesc body;
    body.shape = shapes_[flight.shape];
    body.position = place();
    body.orientation = random_orientation(random_);
    flight.id = world_.add(body);
    flight.way = random_.direction() * random_.uniform(2, 5) * double{kTolerance};
    const auto angle = static_cast<float>(random_.uniform(0, 0.05));
    flight.turn = Eigen::AngleAxisf(angle, random_.direction().cast<float>());
    flights_.push_back(flight);
  }

  World world_;
  Random random_;
  double side_;
  std::vector<Hull> shapes_;
  std::vector<Flight> flights_;
};

TEST(ShellMemory, DepthsOfHullsThatFlyAreWithinTheTolerance) {
  size_t contacts = 0, by_shells = 0;
  for (uint64_t seed = 1; seed <= rounds(8, 2); ++seed) {
    FlyingHulls hulls(within(kTolerance), 200, seed);
    for (int i = 0; i < 15; ++i) {
      hulls.step();
      const World& world = hulls.world();
      for (const Contact& contact : world.contacts()) {
        ASSERT_NEAR(contact.separation, true_separation(world, {contact.a, contact.b}),
                    kTolerance + 1e-5f);
      }
      for (size_t k = 0; k < world.pairs().size(); ++k) {
        const double separation = true_separation(world, world.pairs()[k]);
        if (std::abs(separation) <= kTolerance) continue;
        ASSERT_EQ(world.overlaps()[k], separation < 0);
      }
      contacts += world.contacts().size();
      by_shells += world.report().by_shells;
      if (i % 2 == 1) hulls.disturb();
    }
  }
  EXPECT_GT(contacts, rounds(8, 2) * 1000);
  EXPECT_GT(by_shells, contacts * 7 / 10);
}

TEST(ShellMemory, TheSameOnThreadsAndEveryIsa) {
  std::vector<Results> expected;
  ThreadArena arena(2);
  for (const bool threads : {false, true}) {
    for_each_isa([&] {
      arena.run([&] {
        WorldSettings settings = within(kTolerance, {.detail = Detail::manifold});
        settings.parallelism = threads ? arena.parallelism() : Parallelism::none;
        FlyingHulls hulls(settings, 1500, 3);
        for (size_t i = 0; i < 6; ++i) {
          hulls.step();
          if (expected.size() == i) expected.push_back(results(hulls.world()));
          ASSERT_TRUE(results(hulls.world()) == expected[i]) << i;
          hulls.disturb();
        }
        EXPECT_GT(hulls.world().report().by_shells, hulls.world().contacts().size() / 2);
      });
    });
  }
}

TEST(ShellMemory, IsEmptyWhereThereIsNoToleranceOrProofsAreWanted) {
  for (const float tolerance : {0.0f, 1e-7f}) {
    FlyingHulls hulls(within(tolerance), 200, 5);
    size_t by_shells = 0;
    for (int i = 0; i < 12; ++i) {
      hulls.step();
      by_shells += hulls.world().report().by_shells;
    }
    EXPECT_EQ(by_shells, 0u) << tolerance;
  }
  WorldSettings certified = within(kTolerance);
  certified.accuracy.tier = Tier::certified;
  FlyingHulls hulls(certified, 200, 6);
  for (int i = 0; i < 3; ++i) hulls.step();
  EXPECT_EQ(hulls.world().report().by_shells, 0u);
}

}  // namespace
}  // namespace carom::test

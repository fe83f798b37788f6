// Bounds with a margin: more candidate pairs, less work, the same results.
#include <gtest/gtest.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "carom/base/thread_arena.h"
#include "carom/bounds/bounds.h"
#include "tests/support/pairs.h"
#include "tests/support/rounds.h"
#include "tests/support/special_floats.h"
#include "tests/world/crowds.h"
#include "world/motion/fat_bounds.h"

namespace carom::test {
namespace {

// An interval in one column, which serves all three axes.
class Fattened {
 public:
  explicit Fattened(float margin) : margin_(margin) {}

  std::pair<float, float> operator()(float lower, float upper, size_t count = 1) {
    const std::vector<float> lowers(count, lower), uppers(count, upper);
    const float* l = lowers.data();
    const float* u = uppers.data();
    fat_.update({{l, l, l}, {u, u, u}, count}, margin_, Parallelism::none);
    const BoundsView view = fat_.view();
    EXPECT_EQ(view.count, count);
    return {view.lower[1][count - 1], view.upper[2][count - 1]};
  }

 private:
  FatBounds fat_;
  float margin_;
};

using Interval = std::pair<float, float>;

// `got` is the interval, rounded outwards by at most a few units in the last place.
void expect_about(const Interval& got, double lower, double upper) {
  EXPECT_LE(got.first, lower);
  EXPECT_GE(got.second, upper);
  EXPECT_NEAR(got.first, lower, 0x1p-21 * std::abs(lower));
  EXPECT_NEAR(got.second, upper, 0x1p-21 * std::abs(upper));
}

TEST(FatBounds, StayUntilTheTrueBoundsLeaveThem) {
  Fattened fat(0.5f);
  const Interval first = fat(1, 2);
  expect_about(first, 0.5, 2.5);
  EXPECT_EQ(fat(1.25f, 2.25f), first);
  EXPECT_EQ(fat(1.5f, 2.5f), first);
  const Interval second = fat(1.75f, 2.75f);
  expect_about(second, 1.25, 3.25);
  EXPECT_EQ(fat(1.25f, 2), second);
  EXPECT_EQ(fat(1.0f, 2), first);
}

TEST(FatBounds, FollowBodiesThatShrink) {
  Fattened fat(1);
  const Interval large = fat(-100, 100);
  expect_about(large, -101, 101);
  EXPECT_EQ(fat(-99, 99), large);
  expect_about(fat(-1, 1), -2, 2);
}

TEST(FatBounds, EmptyAndNanPassThroughAndAreNotKept) {
  Fattened fat(1);
  expect_about(fat(0, 1), -1, 2);
  EXPECT_EQ(fat(kInfinity, -kInfinity), Interval(kInfinity, -kInfinity));
  expect_about(fat(0.5f, 1), -0.5f, 2);
  EXPECT_EQ(fat(0.5f, 0.25f), Interval(0.5f, 0.25f));
  EXPECT_TRUE(std::isnan(fat(kNan, 1).first));
  EXPECT_TRUE(std::isnan(fat(0, kNan).second));
  expect_about(fat(0, 1), -1, 2);
}

TEST(FatBounds, AreRoundedOutwards) {
  Random random(1);
  const auto number = [&] {
    const int exponent = static_cast<int>(random.below(254)) - 149;
    return static_cast<float>(std::ldexp(random.uniform(-1, 1), exponent));
  };
  for (int i = 0; i < 100000; ++i) {
    const float margin = std::abs(number());
    const float v = number();
    if (margin == 0) continue;
    const auto [lower, upper] = Fattened(margin)(v, v);
    // long double is exact for most sums, and rounds less than the margin's own rounding.
    ASSERT_LE(lower, static_cast<long double>(v) - margin) << v << ' ' << margin;
    ASSERT_GE(upper, static_cast<long double>(v) + margin) << v << ' ' << margin;
    ASSERT_LE(lower, v);
    ASSERT_GE(upper, v);
  }
  Fattened far(FLT_MAX);
  EXPECT_EQ(far(-FLT_MAX, FLT_MAX), Interval(-kInfinity, kInfinity));
}

TEST(FatBounds, RowsMayComeAndGo) {
  Fattened fat(1);
  const Interval first = fat(0, 0, 5000);
  expect_about(first, -1, 1);
  EXPECT_EQ(fat(0, 0, 3), first);
  EXPECT_EQ(fat(0.5f, 0.5f, 3), first);
  expect_about(fat(0.5f, 0.5f, 4), -0.5, 1.5);
}

// Two worlds with the same bodies, one with a margin and one without.
class Twins {
 public:
  Twins(WorldSettings settings, float margin, const CrowdSpec& spec, uint64_t seed)
      : plain_(settings), random_(seed), spec_(spec) {
    settings.margin = margin;
    fat_ = World(settings);
    crowd_ = make_crowd(spec);
    for (const BodyDesc& body : crowd_) add(body);
  }

  const World& fat() const { return fat_; }

  void change() {
    const double share = random_.chance(0.3) ? 0.02 : 0.6;
    if (random_.chance(0.8)) move(share, random_.chance(0.5) ? 0.01 : 0.2);
    if (random_.chance(0.2)) move(0.05, spec_.side);
    for (size_t i = random_.below(4); i > 0; --i) {
      const size_t which = random_.below(ids_.size());
      both([&](World& world) { world.remove(ids_[which]); });
      std::swap(ids_[which], ids_.back());
      ids_.pop_back();
    }
    for (size_t i = random_.below(4); i > 0; --i) add(crowd_[random_.below(crowd_.size())]);
    const BodyId id = ids_[random_.below(ids_.size())];
    const auto size = static_cast<float>(random_.uniform(-0.1, 1));
    switch (random_.below(spec_.oriented ? 9 : 6)) {
      case 0:
        both([&](World& world) { world.set_shape(id, Sphere{size}); });
        break;
      case 1:
        both([&](World& world) { world.set_shape(id, Aabb::from_half_extents({size, 1, 0.2f})); });
        break;
      case 2:
        both([&](World& world) { world.set_position(id, {kNan, 0, 0}); });
        break;
      case 3:
        both([&](World& world) { world.set_filter(id, 1, 1, 3); });
        break;
      case 4:
        both([&](World& world) { world.set_sensor(id, random_.below(2) == 0); });
        break;
      case 6:
        both([&](World& world) { world.set_orientation(id, random_orientation(random_)); });
        break;
      case 7:
        both([&](World& world) {
          world.set_shape(id,
                          random_shape(kAllKinds[random_.below(std::size(kAllKinds))], random_));
        });
        break;
      case 8:
        both([&](World& world) { world.set_orientation(id, {0, 0, 0, 0}); });
        break;
      default:;
    }
  }

  void step_and_check() {
    plain_.step();
    fat_.step();
    ASSERT_EQ(as_bytes(fat_.contacts()), as_bytes(plain_.contacts()));
    ASSERT_EQ(as_bytes(fat_.manifolds()), as_bytes(plain_.manifolds()));
    ASSERT_EQ(as_bytes(fat_.events()), as_bytes(plain_.events()));
    ASSERT_EQ(as_bytes(fat_.quarantined()), as_bytes(plain_.quarantined()));
    ASSERT_TRUE(std::is_sorted(fat_.pairs().begin(), fat_.pairs().end()));
    const bool decided = fat_.settings().detail != Detail::pairs;
    size_t plain = 0;
    for (size_t i = 0; i < fat_.pairs().size(); ++i) {
      const bool both_have =
          plain < plain_.pairs().size() && plain_.pairs()[plain] == fat_.pairs()[i];
      if (decided) {
        ASSERT_EQ(fat_.overlaps()[i], both_have ? plain_.overlaps()[plain] : 0);
      }
      plain += both_have;
    }
    ASSERT_EQ(plain, plain_.pairs().size()) << "pairs are lost";
  }

 private:
  template <class Change>
  void both(const Change& change) {
    const Random before = random_;
    change(plain_);
    random_ = before;
    change(fat_);
  }

  void add(const BodyDesc& body) {
    const BodyId id = plain_.add(body);
    EXPECT_EQ(fat_.add(body), id);
    ids_.push_back(id);
  }

  void move(double share, double distance) {
    for (const BodyId id : ids_) {
      if (!random_.chance(share)) continue;
      Eigen::Vector3d to = plain_.position(id) + distance * random_.direction();
      if (!to.allFinite() || to.norm() > 2 * spec_.side) to = random_position(random_, spec_.side);
      plain_.set_position(id, to);
      fat_.set_position(id, to);
    }
  }

  World plain_, fat_;
  Random random_;
  CrowdSpec spec_;
  std::vector<BodyDesc> crowd_;
  std::vector<BodyId> ids_;
};

void run_history(const WorldSettings& settings, float margin, uint64_t seed, size_t count = 150) {
  SCOPED_TRACE(::testing::Message() << "seed " << seed << ", margin " << margin);
  const CrowdSpec spec{.count = count,
                       .side = std::cbrt(static_cast<double>(count)),
                       .oriented = seed % 4 < 2,
                       .halfspaces = seed % 4 == 1 ? size_t{3} : size_t{0},
                       .filters = seed % 3 == 0,
                       .velocities = seed % 2 == 0,
                       .seed = seed + 1};
  Twins twins(settings, margin, spec, seed);
  for (int i = 0; i < 20; ++i) {
    twins.step_and_check();
    if (::testing::Test::HasFatalFailure()) return;
    if (i % 7 != 3) twins.change();
  }
}

TEST(Margin, RandomHistoriesGiveTheSameResults) {
  constexpr float kMargins[] = {0.05f, 0.3f, 1e-6f, 5, 1e30f};
  for (uint64_t seed = 0; seed < test::rounds(400); ++seed) {
    WorldSettings settings;
    settings.positions = seed % 2 ? PositionType::float64 : PositionType::float32;
    settings.broadphase = seed % 5 < 3 ? BroadphaseMethod::grid : BroadphaseMethod::sweep;
    settings.carry_results = seed % 7 != 0;
    settings.detail = seed % 4 == 3   ? Detail::overlap
                      : seed % 8 == 4 ? Detail::pairs
                      : seed % 4 == 1 ? Detail::manifold
                                      : Detail::contact;
    run_history(settings, kMargins[seed % 5], seed);
    ASSERT_FALSE(HasFailure());
  }
}

TEST(Margin, TheSameOnThreads) {
  ThreadArena arena(4);
  arena.run([&] {
    for (uint64_t seed = 0; seed < 3; ++seed) {
      run_history({.parallelism = arena.parallelism()}, 0.1f, seed, 5000);
    }
  });
}

// A speck in front of a huge sphere: the test in float64 calls them touching, but their float32
// bounds are separate.
TEST(Margin, PairsWhoseBoundsLieApartDoNotOverlap) {
  for (const float margin : {0.0f, 1.0f}) {
    World world({.margin = margin});
    world.add({.shape = Sphere{1e10f}, .position = {-1e10, 0, 0}});
    world.add({.shape = Sphere{0}, .position = {1e-30, 0, 0}});
    world.step();
    EXPECT_EQ(world.pairs().size(), margin > 0 ? 1u : 0u);
    EXPECT_EQ(world.report().overlaps, 0u);
    EXPECT_TRUE(world.contacts().empty());
  }
}

// Every body moves in its own direction, at up to 1 cm a step.
TEST(Margin, FewBodiesAreSearchedInADriftingCrowd) {
  const CrowdSpec spec{.count = 3000, .side = 15};
  World world({.detail = Detail::pairs, .margin = 0.5f});
  const std::vector<BodyId> ids = add_crowd(world, spec);
  Random random(1);
  std::vector<Eigen::Vector3d> ways(ids.size());
  for (Eigen::Vector3d& way : ways) way = random.uniform(0, 0.01) * random.direction();
  size_t searched = 0, steps = 0;
  for (int i = 0; i < 60; ++i) {
    world.step();
    if (i >= 10 && world.report().ran(Stage::broadphase))
      searched += world.report().search.searched;
    steps += i >= 10;
    for (size_t k = 0; k < ids.size(); ++k) {
      world.set_position(ids[k], world.position(ids[k]) + ways[k]);
    }
  }
  EXPECT_LT(searched, steps * ids.size() / 4);
}

TEST(Margin, CostsMemoryOnlyIfThereIsOne) {
  World plain, fat({.margin = 0.5f});
  for (World* world : {&plain, &fat}) {
    add_crowd(*world, {});
    world->step();
  }
  EXPECT_FALSE(plain.report().ran(Stage::margins));
  EXPECT_TRUE(fat.report().ran(Stage::margins));
  EXPECT_GE(fat.memory().bounds, plain.memory().bounds + 400 * 6 * sizeof(float));
}

}  // namespace
}  // namespace carom::test

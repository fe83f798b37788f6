// The deviations of whole scenes at the fast tier and within a tolerance, and how they are
// measured.
#include "cli/accuracy/scene_fidelity.h"

#include <cmath>

#include "accuracy/scenes/deviation.h"
#include "accuracy/scenes/trials.h"
#include "cli/scenes/loaded_scene.h"
#include "tests/cli/cli_test_util.h"
#include "tests/support/laddered_cube.h"

namespace carom::cli {
namespace {

using accuracy::Deviation;
using accuracy::FidelityEntry;
using accuracy::FidelityReport;
using accuracy::ReuseEntry;

TEST(SceneFidelity, TheFastTierAndTolerancesKeepTheirPromises) {
  FidelityReport report;
  auto scene =
      LoadedScene::open("brownian:n=500,frames=8,seed=1,density=0.3,shape=box,speed=0.5,spin=0.5");
  ASSERT_TRUE(scene);
  ASSERT_TRUE((*scene)->load(8));
  ASSERT_TRUE(accuracy::measure_fidelity(**scene, 1, report));

  ASSERT_EQ(report.fidelity.size(), 1u);
  const double radius = std::sqrt(0.75);
  for (const FidelityEntry& entry : report.fidelity) {
    EXPECT_GT(entry.pairs, 1000u);
    EXPECT_GT(entry.frame_ms, 0);
    EXPECT_GT(entry.frame_ms_standard, 0);
    EXPECT_LE(entry.contact_error_p99, entry.contact_error_worst);
  }
  EXPECT_EQ(report.fidelity[0].setting, "single precision");
  EXPECT_LT(report.fidelity[0].contact_error_worst, 0x1p-15 * radius);

  ASSERT_EQ(report.reuse.size(), 4u);
  for (const ReuseEntry& entry : report.reuse) {
    EXPECT_EQ(entry.error_bound, entry.tolerance);
    EXPECT_LE(entry.error_worst, entry.error_bound + 0x1p-18 * radius);
  }
  EXPECT_NEAR(report.reuse[3].tolerance, 0.1 * radius, 1e-6);
  EXPECT_GT(report.reuse[3].error_worst, 0);
}

TEST(SceneFidelity, TheBuiltInScenesCanBePlayed) {
  for (const bool is_short : {true, false}) {
    for (const std::string& text : accuracy::fidelity_scenes(is_short)) {
      EXPECT_TRUE(LoadedScene::open(text)) << text;
    }
  }
}

TEST(SceneFidelity, StandardDoesNotDeviateFromItself) {
  auto scene = LoadedScene::open("brownian:n=300,frames=5,density=0.4,shape=capsule");
  ASSERT_TRUE(scene);
  ASSERT_TRUE((*scene)->load(5));
  const auto standard = accuracy::run_standard(**scene);
  ASSERT_TRUE(standard);
  EXPECT_EQ(standard->frames.size(), 5u);
  const std::vector<accuracy::Trial> trials(2);
  const auto results = accuracy::run_trials(**scene, *standard, trials, {.rounds = 0});
  ASSERT_TRUE(results);
  const Deviation& deviation = results->back()->deviation;
  EXPECT_EQ(deviation.pairs, standard->candidates);
  EXPECT_EQ(deviation.lost + deviation.gained + deviation.events_moved, 0u);
  EXPECT_EQ(deviation.worst(), 0);
}

TEST(SceneFidelity, TrialsStopAtTheDeadline) {
  auto scene = LoadedScene::open("brownian:n=50,frames=3");
  ASSERT_TRUE(scene);
  const auto standard = accuracy::run_standard(**scene);
  ASSERT_TRUE(standard);
  const std::vector<accuracy::Trial> trials(3);
  accuracy::TrialPlan plan;
  plan.deadline = std::chrono::steady_clock::now();
  const auto results = accuracy::run_trials(**scene, *standard, trials, plan);
  ASSERT_TRUE(results);
  ASSERT_EQ(results->size(), 3u);
  for (const auto& result : *results) EXPECT_FALSE(result.has_value());
}

// Three balls of radius 1 on a line: the first two `gap` apart, the third by default far from both.
World three_balls(double gap, double third = 10) {
  World world(WorldSettings{});
  world.add({.shape = Sphere{1}, .position = {0, 0, 0}});
  world.add({.shape = Sphere{1}, .position = {2 + gap, 0, 0}});
  world.add({.shape = Sphere{1}, .position = {third, 0, 0}});
  world.step();
  return world;
}

Deviation deviation(const World& standard, const World& other) {
  const std::vector<accuracy::FrameResults> frames = {accuracy::results_of(standard)};
  accuracy::DeviationMeter meter(frames);
  meter.add(0, other);
  return meter.finish();
}

TEST(Deviations, SeparationsOfCommonContactsAreCompared) {
  const Deviation found = deviation(three_balls(-0.5), three_balls(-0.25));
  EXPECT_EQ(found.lost + found.gained + found.events_moved, 0u);
  EXPECT_EQ(found.contact_error_worst, 0.25);
  EXPECT_EQ(found.contact_error_p99, 0.25);
  EXPECT_EQ(found.worst(), 0.25);
}

TEST(Deviations, LostOverlapsAreAsBadAsTheyAreDeep) {
  const Deviation found = deviation(three_balls(-0.5), three_balls(0.125));
  EXPECT_EQ(found.lost, 1u);
  EXPECT_EQ(found.gained, 0u);
  EXPECT_EQ(found.lost_worst, 0.5);
  EXPECT_EQ(found.events_moved, 1u);
  EXPECT_EQ(found.worst(), 0.5);
}

// A box, and a box turned by 45 degrees, corner to face. Their bounds and the balls that stand for
// them overlap, the boxes do not. The meter asks the other world for the true shapes: models change
// only what that world finds.
TEST(Deviations, GainedOverlapsAreAsBadAsTheyAreApart) {
  WorldSettings settings;
  settings.accuracy.tolerance = 2;
  World plain(WorldSettings{});
  World balls(settings);
  for (World* world : {&plain, &balls}) {
    world->add({.shape = test::cube_with_ball(1.7321f, 0.7322), .position = {0, 0, 0}});
    world->add({.shape = test::cube_with_ball(1.7321f, 0.7322),
                .position = {2.2, 2.2, 0},
                .orientation = Eigen::Quaternionf(1, 0, 0, 0.41421356f)});
    world->step();
  }
  const Deviation found = deviation(plain, balls);
  EXPECT_EQ(found.gained, 1u);
  EXPECT_NEAR(found.gained_worst, 2.2 * std::sqrt(2.0) - 1 - std::sqrt(2.0), 1e-6);
}

TEST(Deviations, SensorsHaveNoSeparationToCompare) {
  const auto with_sensor = [](double gap) {
    World world(WorldSettings{});
    world.add({.shape = Sphere{1}, .position = {0, 0, 0}, .sensor = true});
    world.add({.shape = Sphere{1}, .position = {2 + gap, 0, 0}});
    world.step();
    return world;
  };
  const Deviation same = deviation(with_sensor(-0.5), with_sensor(-0.25));
  EXPECT_EQ(same.worst(), 0);
  const Deviation lost = deviation(with_sensor(-0.5), with_sensor(0.25));
  EXPECT_EQ(lost.lost, 1u);
  EXPECT_EQ(lost.lost_worst, 0.25);
}

}  // namespace
}  // namespace carom::cli

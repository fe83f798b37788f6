// carom generate, and the generators themselves.
#include <algorithm>
#include <cmath>
#include <utility>

#include "cli/scene_source.h"
#include "cli/state_hash.h"
#include "io/generate/generator.h"
#include "io/generate/random.h"
#include "io/scene.h"
#include "tests/cli/cli_test_util.h"

namespace carom::cli {
namespace {

using GenerateTest = CliTest;

std::unique_ptr<io::SceneReader> open(const std::string& text) {
  auto scene = open_source(text);
  EXPECT_TRUE(scene) << scene.error().message;
  return std::move(*scene);
}

std::string hash_of(const std::string& spec, uint64_t frames) {
  const auto scene = open(spec);
  StateHash hash;
  hash.add(std::span(scene->info().shapes.params));
  hash.add(std::span(scene->info().body_shape));
  io::SceneFrame frame;
  for (uint64_t i = 0; i < frames; ++i) {
    EXPECT_TRUE(scene->read_frame(frame));
    hash.add(std::span(std::as_const(frame).position32));
    hash.add(std::span(std::as_const(frame).position64));
    hash.add(std::span(std::as_const(frame).linear_velocity));
  }
  return hash.text();
}

// Golden values: a scene is the same with every compiler and on every machine, for good.
TEST_F(GenerateTest, ScenesNeverChange) {
  EXPECT_EQ(hash_of("brownian:n=1000", 5), "47c9b109cb582ce4");
  EXPECT_EQ(hash_of("brownian:n=1000,shape=sphere,positions=float64,seed=7", 5),
            "b6826cb62ba2e4a8");
  EXPECT_EQ(hash_of("varied:n=1000", 5), "4163794500e30071");
  EXPECT_EQ(hash_of("static:n=1000", 5), "b647eae9c47b591c");
  EXPECT_EQ(hash_of("still:n=1000", 2), "11af23cd1e077964");
}

TEST_F(GenerateTest, SeedsDiffer) {
  EXPECT_NE(hash_of("brownian:n=100,seed=1", 1), hash_of("brownian:n=100,seed=2", 1));
}

TEST_F(GenerateTest, TheFirstFrameComesAfterTheLast) {
  const auto scene = open("brownian:n=50,frames=3");
  io::SceneFrame first, frame;
  ASSERT_TRUE(scene->read_frame(first));
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(scene->read_frame(frame));
  EXPECT_EQ(frame.position32, first.position32);
  EXPECT_EQ(frame.linear_velocity, first.linear_velocity);
}

TEST_F(GenerateTest, RoundTripThroughAFile) {
  for (const std::string spec :
       {"brownian:n=60,frames=4", "varied:n=60,frames=4,shape=sphere",
        "static:n=60,frames=4,positions=float64,motion=static", "still:n=60,frames=2"}) {
    const CommandResult result = run_command({"generate", spec, "-o", path("scene.npz")});
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(result.out + result.err, "");
    const auto generated = open(spec);
    const auto stored = open(path("scene.npz"));
    EXPECT_EQ(stored->info().frames, generated->info().frames);
    EXPECT_EQ(stored->info().dt, generated->info().dt);
    EXPECT_EQ(stored->info().shapes.kind, generated->info().shapes.kind);
    EXPECT_EQ(stored->info().shapes.params, generated->info().shapes.params);
    EXPECT_EQ(stored->info().body_shape, generated->info().body_shape);
    EXPECT_EQ(stored->info().body_motion, generated->info().body_motion);
    io::SceneFrame a, b;
    for (uint64_t i = 0; i < generated->info().frames; ++i) {
      ASSERT_TRUE(stored->read_frame(a));
      ASSERT_TRUE(generated->read_frame(b));
      EXPECT_EQ(a.position32, b.position32);
      EXPECT_EQ(a.position64, b.position64);
      EXPECT_EQ(a.linear_velocity, b.linear_velocity);
    }
  }
}

TEST_F(GenerateTest, ARecordingHasThePairsOfItsScene) {
  for (const std::string spec : {"brownian:n=400,frames=4,density=0.5",
                                 "varied:n=300,frames=3,shape=sphere,positions=float64"}) {
    ASSERT_EQ(run_command({"generate", spec, "-o", path("scene.aabb")}).code, 0);
    const auto of_scene = run_command({"run", spec, "--detail", "pairs", "--json", "-"}).json();
    const auto of_recording =
        run_command({"run", path("scene.aabb"), "--detail", "pairs", "--json", "-"}).json();
    EXPECT_EQ(of_scene["pairs_per_frame"], of_recording["pairs_per_frame"]);
  }
}

double square(double x) { return x * x; }

TEST_F(GenerateTest, BrownianIsAsDescribed) {
  const auto scene = open("brownian:n=4000,frames=3");
  const double side = std::cbrt(4000 / 0.1);
  io::SceneFrame frame, next;
  ASSERT_TRUE(scene->read_frame(frame));
  ASSERT_TRUE(scene->read_frame(next));
  int turned = 0;
  double fastest = 0;
  for (size_t i = 0; i < 4000; ++i) {
    double speed2 = 0;
    for (size_t axis = 0; axis < 3; ++axis) {
      const double half = scene->info().shapes.params[i][axis];
      EXPECT_GE(half, 0.4999999);
      EXPECT_LE(half, 0.8660255);
      const size_t k = 3 * i + axis;
      EXPECT_LE(std::fabs(next.position32[k]) + half, side / 2 * 1.000001);
      speed2 += square(frame.linear_velocity[k]);
    }
    for (size_t k = 3 * i; k < 3 * i + 3; ++k) {
      const bool bounced = next.linear_velocity[k] == -frame.linear_velocity[k];
      if (next.linear_velocity[k] != frame.linear_velocity[k] && !bounced) {
        ++turned;
        break;
      }
    }
    fastest = std::fmax(fastest, std::sqrt(speed2));
  }
  EXPECT_NEAR(turned, 40, 4);  // 1 %, of which a few may be drawn twice
  EXPECT_LE(fastest, 0.75 * side);
  EXPECT_GE(fastest, 0.74 * side);
}

TEST_F(GenerateTest, VariedSizesAreLogUniform) {
  const auto scene = open("varied:n=20000,shape=sphere");
  int counts[5] = {};
  for (const auto& params : scene->info().shapes.params) {
    const double place = std::log(2.0 * params[0]) / std::log(316.0) * 5;
    ASSERT_GE(place, -1e-6);
    ASSERT_LE(place, 5.000001);
    ++counts[std::min(4, std::max(0, static_cast<int>(place)))];
  }
  for (const int count : counts) EXPECT_NEAR(count, 4000, 250);
}

TEST_F(GenerateTest, NineOfTenNeverMoveInStatic) {
  const auto scene = open("static:n=1000,frames=3");
  io::SceneFrame first, later;
  ASSERT_TRUE(scene->read_frame(first));
  ASSERT_TRUE(scene->read_frame(later));
  ASSERT_TRUE(scene->read_frame(later));
  int moved = 0;
  for (size_t i = 0; i < 1000; ++i) {
    moved += !std::equal(&first.position32[3 * i], &first.position32[3 * i] + 3,
                         &later.position32[3 * i]);
  }
  EXPECT_EQ(moved, 100);
  EXPECT_TRUE(scene->info().body_motion.empty());
  const auto marked = open("static:n=1000,motion=static");
  EXPECT_EQ(std::count(marked->info().body_motion.begin(), marked->info().body_motion.end(), 0),
            900);
}

TEST_F(GenerateTest, StillNeverMoves) {
  const auto scene = open("still:n=100,frames=3");
  io::SceneFrame first, later;
  ASSERT_TRUE(scene->read_frame(first));
  ASSERT_TRUE(scene->read_frame(later));
  EXPECT_EQ(first.position32, later.position32);
  EXPECT_EQ(later.linear_velocity, std::vector<float>(300, 0));
}

TEST_F(GenerateTest, CubeRoot) {
  for (const double x : {1e-9, 0.5, 1.0, 8.0, 1e5, 1e7, 1e16}) {
    EXPECT_NEAR(io::cube_root(x), std::cbrt(x), 1e-14 * std::cbrt(x));
  }
}

}  // namespace
}  // namespace carom::cli

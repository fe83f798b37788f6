// carom generate, and the scene generators themselves.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "cli/run/state_hash.h"
#include "cli/scenes/scene_source.h"
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
  const io::SceneShapes& shapes = scene->info().shapes;
  if (!shapes.vertices.empty()) hash.add(std::span(shapes.vertices));
  if (!shapes.child_position.empty()) hash.add(std::span(shapes.child_position));
  io::SceneFrame frame;
  for (uint64_t i = 0; i < frames; ++i) {
    EXPECT_TRUE(scene->read_frame(frame));
    hash.add(std::span(std::as_const(frame).position32));
    hash.add(std::span(std::as_const(frame).position64));
    hash.add(std::span(std::as_const(frame).linear_velocity));
    if (!scene->info().has_orientation) continue;
    hash.add(std::span(std::as_const(frame).orientation));
    hash.add(std::span(std::as_const(frame).angular_velocity));
  }
  return hash.text();
}

// Golden values: a scene must stay the same with every compiler and on every machine, for good.
TEST_F(GenerateTest, ScenesNeverChange) {
  EXPECT_EQ(hash_of("brownian:n=1000", 5), "47c9b109cb582ce4");
  EXPECT_EQ(hash_of("brownian:n=1000,shape=sphere,positions=float64,seed=7", 5),
            "b6826cb62ba2e4a8");
  EXPECT_EQ(hash_of("varied:n=1000", 5), "4163794500e30071");
  EXPECT_EQ(hash_of("static:n=1000", 5), "b647eae9c47b591c");
  EXPECT_EQ(hash_of("still:n=1000", 2), "11af23cd1e077964");
  EXPECT_EQ(hash_of("varied:n=1000,shape=box", 5), "03079dcb9c2193a2");
  EXPECT_EQ(hash_of("static:n=1000,shape=capsule,spin=20", 5), "7f43ce247eb284b6");
  EXPECT_EQ(hash_of("brownian:n=1000,shape=hull", 5), "29a92da234824389");
  EXPECT_EQ(hash_of("varied:n=100,shape=mesh", 5), "7ab2230ef1b09553");
  EXPECT_EQ(hash_of("static:n=100,shape=compound", 5), "366c7bfa31cda38e");
  EXPECT_EQ(hash_of("bullets:n=100", 5), "b4df9e541f34af8e");
}

TEST_F(GenerateTest, RoundAndMixedScenesNeverChange) {
  EXPECT_EQ(hash_of("brownian:n=1000,shape=cylinder", 5), "5bbed55ee24f3655");
  EXPECT_EQ(hash_of("varied:n=1000,shape=cone", 5), "e92cc964aec30b65");
  EXPECT_EQ(hash_of("static:n=1000,shape=ellipsoid", 5), "4a567585677a0af5");
  EXPECT_EQ(hash_of("brownian:n=1000,shape=mixed", 5), "de27c7b99b4b69e8");
  EXPECT_EQ(hash_of("static:n=1000,shape=mixed", 5), "dfb76bbd243f4c94");
}

TEST_F(GenerateTest, SeedsDiffer) {
  EXPECT_NE(hash_of("brownian:n=100,seed=1", 1), hash_of("brownian:n=100,seed=2", 1));
}

TEST_F(GenerateTest, TheFirstFrameComesAfterTheLast) {
  const auto scene = open("brownian:n=50,frames=3,shape=box");
  io::SceneFrame first, frame;
  ASSERT_TRUE(scene->read_frame(first));
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(scene->read_frame(frame));
  EXPECT_EQ(frame.position32, first.position32);
  EXPECT_EQ(frame.linear_velocity, first.linear_velocity);
  EXPECT_EQ(frame.orientation, first.orientation);
}

TEST_F(GenerateTest, RoundTripThroughAFile) {
  for (const std::string spec :
       {"brownian:n=60,frames=4", "varied:n=60,frames=4,shape=sphere",
        "static:n=60,frames=4,positions=float64,motion=static", "still:n=60,frames=2",
        "static:n=60,frames=4,shape=box", "brownian:n=60,frames=4,shape=capsule",
        "brownian:n=60,frames=2,shape=hull", "varied:n=60,frames=2,shape=mesh",
        "static:n=60,frames=2,shape=compound", "varied:n=60,frames=2,shape=cylinder",
        "brownian:n=60,frames=2,shape=cone", "static:n=60,frames=2,shape=ellipsoid",
        "brownian:n=200,frames=2,shape=mixed", "static:n=60,frames=2,shape=mixed"}) {
    const CommandResult result = run_command({"generate", spec, "-o", path("scene.npz")});
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(result.out + result.err, "");
    const auto generated = open(spec);
    const auto stored = open(path("scene.npz"));
    EXPECT_EQ(stored->info().frames, generated->info().frames);
    EXPECT_EQ(stored->info().dt, generated->info().dt);
    EXPECT_EQ(stored->info().shapes.kind, generated->info().shapes.kind);
    EXPECT_EQ(stored->info().shapes.params, generated->info().shapes.params);
    EXPECT_EQ(stored->info().shapes.vertices, generated->info().shapes.vertices);
    EXPECT_EQ(stored->info().shapes.triangles, generated->info().shapes.triangles);
    EXPECT_EQ(stored->info().shapes.child_shape, generated->info().shapes.child_shape);
    EXPECT_EQ(stored->info().body_shape, generated->info().body_shape);
    EXPECT_EQ(stored->info().body_motion, generated->info().body_motion);
    io::SceneFrame a, b;
    for (uint64_t i = 0; i < generated->info().frames; ++i) {
      ASSERT_TRUE(stored->read_frame(a));
      ASSERT_TRUE(generated->read_frame(b));
      EXPECT_EQ(a.position32, b.position32);
      EXPECT_EQ(a.position64, b.position64);
      EXPECT_EQ(a.linear_velocity, b.linear_velocity);
      EXPECT_EQ(a.orientation, b.orientation);
      EXPECT_EQ(a.angular_velocity, b.angular_velocity);
    }
  }
}

TEST_F(GenerateTest, ARecordingHasThePairsOfItsScene) {
  for (const std::string spec :
       {"brownian:n=400,frames=4,density=0.5",
        "varied:n=300,frames=3,shape=sphere,positions=float64",
        "static:n=300,frames=3,shape=box,density=0.5",
        "brownian:n=300,frames=3,shape=capsule,density=0.5,positions=float64",
        "varied:n=100,frames=2,shape=hull,density=0.5", "still:n=100,frames=2,shape=mesh,density=1",
        "brownian:n=100,frames=2,shape=compound,density=1",
        "varied:n=200,frames=2,shape=cylinder,density=0.5",
        "brownian:n=200,frames=2,shape=cone,density=0.5,positions=float64",
        "static:n=300,frames=2,shape=ellipsoid,density=0.5"}) {
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
  EXPECT_NEAR(turned, 40, 4);  // 1 %; a body may be drawn twice
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

std::vector<io::SceneFrame> all_frames(const std::string& spec) {
  const auto scene = open(spec);
  std::vector<io::SceneFrame> frames(scene->info().frames);
  for (io::SceneFrame& frame : frames) EXPECT_TRUE(scene->read_frame(frame));
  return frames;
}

Eigen::Quaterniond orientation(const io::SceneFrame& frame, size_t body) {
  return Eigen::Quaternionf(&frame.orientation[4 * body]).cast<double>();
}

Eigen::Vector3d angular_velocity(const io::SceneFrame& frame, size_t body) {
  return Eigen::Vector3f(&frame.angular_velocity[3 * body]).cast<double>();
}

TEST_F(GenerateTest, CubesAndSpheresHaveNoOrientation) {
  for (const std::string shape : {"cube", "sphere"}) {
    const auto scene = open("brownian:n=10,shape=" + shape);
    io::SceneFrame frame;
    ASSERT_TRUE(scene->read_frame(frame));
    EXPECT_FALSE(scene->info().has_orientation || scene->info().has_angular_velocity);
    EXPECT_TRUE(frame.orientation.empty() && frame.angular_velocity.empty());
  }
}

// Boxes start in the poses of the cubes, with the same bounds as shape=cube.
TEST_F(GenerateTest, BoxesAreTheCubes) {
  for (const std::string generator : {"brownian", "varied", "still"}) {
    const auto cubes = open(generator + ":n=300");
    const auto boxes = open(generator + ":n=300,shape=box");
    io::SceneFrame cube, box;
    ASSERT_TRUE(cubes->read_frame(cube));
    ASSERT_TRUE(boxes->read_frame(box));
    EXPECT_EQ(cube.position32, box.position32);
    for (size_t i = 0; i < 300; ++i) {
      const Eigen::Matrix3d turn = orientation(box, i).toRotationMatrix().cwiseAbs();
      const io::SceneShapes& shapes = boxes->info().shapes;
      const Eigen::Vector3f half(shapes.params[boxes->info().body_shape[i]].data());
      const Eigen::Vector3f bounds(cubes->info().shapes.params[i].data());
      if (generator != "varied") {
        EXPECT_EQ(half, Eigen::Vector3f::Constant(0.5f));
      }
      EXPECT_TRUE((turn * half.cast<double>()).isApprox(bounds.cast<double>(), 1e-6));
    }
  }
}

TEST_F(GenerateTest, CapsulesAreAsLongAsTheirEdge) {
  const auto scene = open("brownian:n=30,shape=capsule");
  ASSERT_EQ(scene->info().shapes.kind,
            std::vector<uint8_t>{static_cast<uint8_t>(ShapeKind::capsule)});
  const std::array<float, 8> expected = {0, -0.25f, 0, 0, 0.25f, 0, 0.25f};
  EXPECT_EQ(scene->info().shapes.params.front(), expected);
}

TEST_F(GenerateTest, RoundShapesAreAsLongAsTheirEdge) {
  const auto first_params = [](const std::string& shape) {
    return open("brownian:n=30,shape=" + shape)->info().shapes.params;
  };
  using Params = std::vector<std::array<float, 8>>;
  EXPECT_EQ(first_params("cylinder"), (Params{{0.25f, 0.5f}}));
  EXPECT_EQ(first_params("cone"), (Params{{0.25f, 0.5f}}));
  EXPECT_EQ(first_params("ellipsoid"), (Params{{0.5f, 0.375f, 0.25f}}));
}

TEST_F(GenerateTest, RoundingsAreOfShapesThatHaveThem) {
  EXPECT_EQ(open("brownian:n=30,shape=box,rounding=0.25")->info().shapes.rounding,
            std::vector<float>{0.25f});
  EXPECT_TRUE(open("brownian:n=30,shape=box")->info().shapes.rounding.empty());
  const auto mixed = open("brownian:n=90,shape=mixed,rounding=0.25");
  const io::SceneShapes& shapes = mixed->info().shapes;
  ASSERT_EQ(shapes.rounding.size(), shapes.kind.size());
  for (size_t i = 0; i < shapes.kind.size(); ++i) {
    EXPECT_EQ(shapes.rounding[i], io::takes_rounding(shapes.kind[i]) ? 0.25f : 0.0f);
  }
  EXPECT_EQ(run_command({"run", "brownian:n=90,frames=2,shape=mixed,rounding=0.1"}).err, "");
  for (const std::string shape : {"cube", "sphere", "capsule", "mesh"}) {
    const CommandResult refused =
        run_command({"run", "brownian:n=9,shape=" + shape + ",rounding=0.1"});
    EXPECT_NE(refused.err.find("'rounding' needs a shape that has one"), std::string::npos);
  }
}

TEST_F(GenerateTest, MixedScenesHaveAllKindsThatTurnAndSpheres) {
  const auto scene = open("static:n=900,shape=mixed");
  const io::SceneInfo& info = scene->info();
  std::array<int, kShapeKindCount> bodies{}, movers{};
  for (size_t i = 0; i < info.bodies; ++i) {
    const uint8_t kind = info.shapes.kind[info.body_shape[i]];
    ++bodies[kind];
    movers[kind] += i % 10 == 0;
  }
  for (const ShapeKind kind : io::kMixedShapes) {
    EXPECT_EQ(bodies[static_cast<size_t>(kind)], 100) << name(kind);
    EXPECT_EQ(movers[static_cast<size_t>(kind)], 10) << name(kind);
  }
  EXPECT_EQ(open("brownian:n=900,shape=mixed")->info().body_shape[145], 1u);
  EXPECT_EQ(run_command({"run", "varied:n=90,frames=2,shape=mixed"}).err, "");
  const CommandResult refused =
      run_command({"generate", "brownian:n=9,shape=mixed", "-o", path("scene.aabb")});
  EXPECT_NE(refused.code, 0);
  EXPECT_NE(refused.err.find("bodies of several kinds"), std::string::npos) << refused.err;
}

// Made shapes, children included, stay inside the ball whose diameter is the edge.
TEST_F(GenerateTest, MadeShapesKeepTheirSize) {
  for (const std::string shape : {"hull", "mesh", "compound"}) {
    const auto scene = open("brownian:n=30,shape=" + shape);
    const io::SceneShapes& shapes = scene->info().shapes;
    EXPECT_EQ(*std::max_element(scene->info().body_shape.begin(), scene->info().body_shape.end()),
              15u);
    ASSERT_FALSE(shapes.vertices.empty());
    for (const auto& vertex : shapes.vertices) {
      const float length = Eigen::Vector3f(vertex.data()).norm();
      EXPECT_LE(length, 0.5f * (shape == "compound" ? 0.25f : 1) + 1e-6f);
    }
    EXPECT_EQ(shapes.child_shape.size(), shape == "compound" ? 4 * 16u : 0u);
    const CommandResult bodies = run_command({"run", "brownian:n=30,frames=2,shape=" + shape});
    EXPECT_EQ(bodies.err, "");  // no body is left out
  }
}

TEST_F(GenerateTest, MadeMeshesAreWatertight) {
  ASSERT_EQ(
      run_command({"generate", "varied:n=20,frames=1,shape=mesh", "-o", path("scene.npz")}).code,
      0);
  const auto report = run_command({"check", path("scene.npz"), "--json", "-"}).json();
  ASSERT_EQ(report["shapes"].size(), 20u);
  for (const auto& shape : report["shapes"]) {
    EXPECT_EQ(shape["triangles"], 32);
    EXPECT_EQ(shape["watertight"], true);
    EXPECT_EQ(shape["inside_out"], false);
    EXPECT_EQ(shape["duplicate_vertices"]["count"], 0);
  }
}

TEST_F(GenerateTest, OrientationsAreUniform) {
  const auto frames = all_frames("still:n=20000,frames=1,shape=box");
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
  for (size_t i = 0; i < 20000; ++i) {
    const Eigen::Matrix3d turn = orientation(frames[0], i).toRotationMatrix();
    mean += turn / 20000;
    squares += turn.cwiseAbs2() / 20000;
  }
  EXPECT_LT(mean.cwiseAbs().maxCoeff(), 0.02);
  EXPECT_LT((squares.array() - 1.0 / 3).abs().maxCoeff(), 0.02);
}

TEST_F(GenerateTest, BodiesTurnByTheirAngularVelocity) {
  constexpr double kTime = 40 * 0.05;
  const auto frames = all_frames("varied:n=100,frames=41,dt=0.05,spin=3,shape=capsule");
  double fastest = 0;
  for (size_t i = 0; i < 100; ++i) {
    const Eigen::Vector3d velocity = angular_velocity(frames.front(), i);
    const Eigen::AngleAxisd turn(velocity.norm() * kTime, velocity.normalized());
    const Eigen::Quaterniond expected = turn * orientation(frames.front(), i);
    EXPECT_LT(expected.angularDistance(orientation(frames.back(), i)), 2e-6);
    fastest = std::fmax(fastest, velocity.norm());
    for (const io::SceneFrame& frame : frames) {
      EXPECT_NEAR(orientation(frame, i).norm(), 1, 2e-7);
      EXPECT_EQ(angular_velocity(frame, i), velocity);
    }
  }
  EXPECT_LE(fastest, 3);
  EXPECT_GE(fastest, 2.8);
}

TEST_F(GenerateTest, WhatRestsDoesNotTurn) {
  const auto frames = all_frames("static:n=1000,frames=3,shape=box");
  for (size_t i = 0; i < 1000; ++i) {
    const bool turns = i % 10 == 0;
    EXPECT_EQ(!turns, orientation(frames[0], i).coeffs() == orientation(frames[2], i).coeffs());
    EXPECT_EQ(!turns, angular_velocity(frames[0], i).isZero(0));
  }
  for (const char* spec : {"still:n=50,frames=3,shape=box", "brownian:n=50,speed=0,shape=capsule",
                           "brownian:n=50,spin=0,shape=box"}) {
    const auto resting = all_frames(spec);
    EXPECT_EQ(resting.front().orientation, resting.back().orientation) << spec;
    EXPECT_EQ(resting.back().angular_velocity, std::vector<float>(150, 0)) << spec;
  }
}

// Without linear speed, rotation alone changes the overlaps from frame to frame.
TEST_F(GenerateTest, RunsTurnTheBodies) {
  for (const std::string shape :
       {"box", "capsule", "hull", "mesh", "compound", "cylinder", "cone", "ellipsoid", "mixed"}) {
    const std::string spec = "brownian:n=200,frames=3,density=0.5,shape=" + shape;
    const auto run = [](const std::string& scene) {
      const CommandResult result = run_command({"run", scene, "--json", "-"});
      EXPECT_EQ(result.code, 0) << result.err;
      return result.json();
    };
    ASSERT_EQ(run_command({"generate", spec, "-o", path("scene.npz")}).code, 0);
    EXPECT_EQ(run(spec)["state_hash"], run(path("scene.npz"))["state_hash"]);
    const auto contacts = [&](const std::string& keys) {
      return run(spec + ",speed=0,dt=1," + keys)["contacts_per_frame"];
    };
    EXPECT_EQ(contacts("spin=0")[0], contacts("spin=0")[2]);
    EXPECT_EQ(contacts("spin=0")[0], contacts("spin=2")[0]);
    EXPECT_NE(contacts("spin=0")[2], contacts("spin=2")[2]);
  }
}

TEST_F(GenerateTest, CubeRoot) {
  for (const double x : {1e-9, 0.5, 1.0, 8.0, 1e5, 1e7, 1e16}) {
    EXPECT_NEAR(io::cube_root(x), std::cbrt(x), 1e-14 * std::cbrt(x));
  }
}

}  // namespace
}  // namespace carom::cli

// Which bodies a step looks after, and from which motion on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "oracle/hull_faces.h"
#include "tests/support/composites.h"
#include "tests/support/hulls.h"
#include "tests/support/special_floats.h"
#include "tests/world/crowds.h"
#include "world/motion/bounding_radii.h"
#include "world/motion/inner_diameter.h"
#include "world/motion/sweeps.h"

namespace carom::test {
namespace {

using Eigen::Vector3f;

constexpr float kHalfTurn = 3.14159f;

Compound two_balls(float radius) {
  return compound_of({{.shape = Sphere{1}}, {.shape = Sphere{radius}, .position = {2, 0, 0}}});
}

Hull box_hull(const Vector3f& half) { return oracle::hull_of(box_corners(half)); }

double inner_diameter_of(const Shape& shape) {
  BodyStore bodies(PositionType::float32);
  bodies.add({.shape = shape});
  const Collidables view = bodies.view();
  return inner_diameter(BodyReader{view}, 0);
}

TEST(InnerDiameter, OfEveryKind) {
  EXPECT_EQ(inner_diameter_of(Sphere{0.5f}), 1);
  EXPECT_EQ(inner_diameter_of(Capsule{{0, 0, -9}, {0, 0, 9}, 0.25f}), 0.5);
  EXPECT_EQ(inner_diameter_of(Aabb{{-1, -2, 3}, {5, 5, 3.5f}}), 0.5);
  EXPECT_EQ(inner_diameter_of(Box{{3, 0.125f, 2}}), 0.25);
  EXPECT_EQ(inner_diameter_of(Halfspace{}), kInfinity);
  EXPECT_EQ(inner_diameter_of(Triangle{.corners = {{{0, 0, 0}, {9, 0, 0}, {0, 9, 0}}}}), 0);
  EXPECT_EQ(inner_diameter_of(flat_grid(3, 1)), 0);
  EXPECT_EQ(inner_diameter_of(two_balls(0.25f)), 0.5);
  EXPECT_EQ(inner_diameter_of(compound_of({{.shape = Sphere{1}}, {.shape = flat_grid(1, 1)}})), 0);
  EXPECT_NEAR(inner_diameter_of(box_hull({1, 2, 0.5f})), 1, 1e-4);
  EXPECT_EQ(inner_diameter_of(oracle::hull_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})), 0) << "flat";
  const Points cube = cube_corners(1);
  for (const DopKind kind : {DopKind::k6, DopKind::k14, DopKind::k18, DopKind::k26}) {
    EXPECT_NEAR(inner_diameter_of(Dop::of_points(cube, kind)), 2, 1e-6);
  }
}

// A slab cuts off the middle: no ball about the middle fits inside.
TEST(InnerDiameter, OfADopWithoutItsMiddleIsZero) {
  Dop dop = Dop::of_points(cube_corners(1), DopKind::k14);
  dop.lower[3] = 1;
  EXPECT_EQ(inner_diameter_of(dop), 0);
}

TEST(InnerDiameter, OfShapesThatAreNotValidDoesNoHarm) {
  for (const Shape& shape :
       {Shape(Sphere{kNan}), Shape(Box{{1, kNan, 1}}), Shape(Hull{}), Shape(Mesh{}),
        Shape(Compound{}), Shape(Capsule{{0, 0, 0}, {1, 0, 0}, -1}),
        Shape(Aabb{{1, 0, 0}, {0, 1, 1}})}) {
    EXPECT_FALSE(inner_diameter_of(shape) > 0);
  }
}

// One body with these velocities, in a world whose interval is one second.
struct OneBody {
  explicit OneBody(const BodyDesc& body, WorldSettings settings = {.dt = 1})
      : world(settings), id(world.add(body)) {}

  size_t swept() { return world.step().swept; }

  World world;
  BodyId id;
};

size_t swept_with(const Shape& shape, const Vector3f& v, const Vector3f& w = Vector3f::Zero(),
                  float fast_share = 0.5f) {
  return OneBody({.shape = shape,
                  .linear_velocity = v,
                  .angular_velocity = w,
                  .detection = Detection::automatic},
                 {.dt = 1, .fast_share = fast_share})
      .swept();
}

TEST(Detections, AutomaticBodiesAreContinuousWhenFast) {
  const Sphere ball{0.5f};
  const Vector3f none = Vector3f::Zero();
  EXPECT_EQ(swept_with(ball, {0, 0, 0}), 0u);
  EXPECT_EQ(swept_with(ball, {0.5f, 0, 0}), 0u) << "as far as the share, not further";
  EXPECT_EQ(swept_with(ball, {0.5001f, 0, 0}), 1u);
  EXPECT_EQ(swept_with(ball, {0.5001f, 0, 0}, none, 0.6f), 0u);
  EXPECT_EQ(swept_with(ball, {1e-30f, 0, 0}, none, 0), 1u);
  EXPECT_EQ(swept_with(ball, {0.4f, 0, 0}, {99, 0, 0}), 0u) << "spheres do not turn";
  EXPECT_EQ(swept_with(Aabb{{-1, -1, 0}, {1, 1, 0.5f}}, {0, 0, 0.26f}, {99, 0, 0}), 1u);
  const Capsule rod{{0, 0, -2}, {0, 0, 2}, 0.25f};
  EXPECT_EQ(swept_with(rod, {0, 0, 0}, {0.1f, 0, 0}), 0u);
  EXPECT_EQ(swept_with(rod, {0, 0, 0}, {0.12f, 0, 0}), 1u) << "its ends do";
  EXPECT_EQ(swept_with(rod, {0, 0.1f, 0}, {0.1f, 0, 0}), 1u) << "both count";
  EXPECT_EQ(swept_with(flat_grid(2, 1), {0, 0, 1e-6f}), 1u) << "nothing fits into a sheet";
  EXPECT_EQ(swept_with(flat_grid(2, 1), {0, 0, 0}), 0u) << "but it rests";
  EXPECT_EQ(swept_with(Halfspace{}, {0, 0, -99}), 0u);
  EXPECT_EQ(swept_with(two_balls(0.25f), {0.26f, 0, 0}), 1u);
}

TEST(Detections, TheOthersAreWhatTheySay) {
  for (const Vector3f& v : {Vector3f(0, 0, 0), Vector3f(99, 0, 0)}) {
    const auto swept = [&](Detection detection) {
      return OneBody({.shape = Sphere{1}, .linear_velocity = v, .detection = detection}).swept();
    };
    EXPECT_EQ(swept(Detection::discrete), 0u);
    EXPECT_EQ(swept(Detection::swept), 1u);
    EXPECT_EQ(swept(Detection::continuous), 1u);
  }
}

TEST(Detections, TheIntervalCanChange) {
  OneBody one(
      {.shape = Sphere{0.5f}, .linear_velocity = {1, 0, 0}, .detection = Detection::automatic});
  EXPECT_EQ(one.swept(), 1u);
  one.world.set_dt(0.25);
  EXPECT_EQ(one.world.settings().dt, 0.25);
  EXPECT_EQ(one.swept(), 0u);
  one.world.set_dt(0);
  EXPECT_EQ(one.swept(), 0u);
}

TEST(Detections, PropertiesAreKept) {
  World world;
  const BodyId a = world.add({});
  const BodyId b = world.add({.angular_velocity = {1, 2, 3}, .detection = Detection::swept});
  EXPECT_EQ(world.detection(a), Detection::discrete);
  EXPECT_EQ(world.detection(b), Detection::swept);
  EXPECT_EQ(world.angular_velocity(a), Vector3f(0, 0, 0));
  EXPECT_EQ(world.angular_velocity(b), Vector3f(1, 2, 3));
  world.set_detection(a, Detection::continuous);
  world.set_angular_velocity(a, {4, 5, 6});
  EXPECT_EQ(world.detection(a), Detection::continuous);
  EXPECT_EQ(world.angular_velocities()[a.index], Vector3f(4, 5, 6));
  world.angular_velocities()[b.index] = {7, 8, 9};
  EXPECT_EQ(world.angular_velocity(b), Vector3f(7, 8, 9));
  world.remove(a);
  const BodyId c = world.add({});
  ASSERT_EQ(c.index, a.index);
  EXPECT_EQ(world.detection(c), Detection::discrete) << "nothing is left of the one before";
  EXPECT_EQ(world.angular_velocity(c), Vector3f(0, 0, 0));
  EXPECT_TRUE(world.linear_velocities()[0].isZero());
}

TEST(Detections, OnlyLivingBodiesCount) {
  World world;
  std::vector<BodyId> ids;
  for (int i = 0; i < 5; ++i) {
    ids.push_back(world.add({.position = {9.0 * i, 0, 0}, .detection = Detection::swept}));
  }
  EXPECT_EQ(world.step().swept, 5u);
  world.remove(ids[4]);
  world.remove(ids[1]);
  EXPECT_EQ(world.step().swept, 3u);
  world.set_detection(ids[0], Detection::discrete);
  world.set_detection(ids[2], Detection::continuous);
  EXPECT_EQ(world.step().swept, 2u);
  world.remove(ids);
  EXPECT_EQ(world.step().swept, 0u);
  EXPECT_FALSE(world.report().ran(Stage::sweeps));
}

TEST(Detections, MotionsThatAreNotFiniteAreSetAside) {
  const auto report_with = [](const Vector3f& v, const Vector3f& w, double dt, const Shape& shape) {
    OneBody one({.shape = shape,
                 .linear_velocity = v,
                 .angular_velocity = w,
                 .detection = Detection::continuous},
                {.dt = dt});
    return one.world.step();
  };
  const Shape ball = Sphere{1}, box = Box{{1, 1, 1}};
  for (const float bad : {kNan, kInfinity, -kInfinity}) {
    EXPECT_EQ(report_with({0, bad, 0}, {0, 0, 0}, 1, ball).unswept, 1u);
    EXPECT_EQ(report_with({0, bad, 0}, {0, 0, 0}, 1, ball).swept, 0u);
    EXPECT_EQ(report_with({0, 0, 0}, {0, 0, bad}, 1, box).unswept, 1u);
    EXPECT_EQ(report_with({0, 0, 0}, {0, 0, bad}, 1, ball).unswept, 0u) << "it does not turn";
  }
  EXPECT_EQ(report_with({3e38f, 0, 0}, {0, 0, 0}, 2, ball).unswept, 1u) << "too far";
  EXPECT_EQ(report_with({3e38f, 0, 0}, {0, 0, 0}, 0.5, ball).unswept, 0u);
  EXPECT_EQ(report_with({0, 0, 0}, {0, 3e38f, 0}, 2, box).unswept, 1u);
  EXPECT_EQ(report_with({0, 0, 0}, {0, 0, 0}, 1, Sphere{-1}).quarantined, 1u);
}

TEST(Sweeps, AreVelocityTimesTheInterval) {
  BodyStore bodies(PositionType::float32);
  bodies.add({.shape = Box{{1, 1, 1}},
              .linear_velocity = {0.1f, -3, 7e8f},
              .angular_velocity = {kHalfTurn, 0, -1},
              .detection = Detection::swept});
  bodies.add({.shape = Sphere{1}, .linear_velocity = {1, 1, 1}, .angular_velocity = {1, 1, 1}});
  Sweeps sweeps;
  const double dt = 1.0 / 60;
  sweeps.update(bodies, dt, 0.5f, Parallelism::none);
  EXPECT_TRUE(sweeps.changed());
  for (int axis = 0; axis < 3; ++axis) {
    const double v = bodies.linear_velocity(0)[axis], w = bodies.angular_velocity(0)[axis];
    EXPECT_EQ(sweeps.sweep(0).displacement[axis], static_cast<float>(v * dt));
    EXPECT_EQ(sweeps.sweep(0).rotation[axis], static_cast<float>(w * dt));
  }
  EXPECT_TRUE(sweeps.turns(0));
  EXPECT_FALSE(sweeps.turns(1)) << "a sphere";
  EXPECT_TRUE(sweeps.looks_ahead(0));
  EXPECT_FALSE(sweeps.looks_ahead(1));
  sweeps.update(bodies, dt, 0.5f, Parallelism::none);
  EXPECT_FALSE(sweeps.changed());
  bodies.linear_velocities()[1].x() = 1.5f;
  sweeps.update(bodies, dt, 0.5f, Parallelism::none);
  EXPECT_TRUE(sweeps.changed()) << "whoever moves may be met";
  sweeps.update(bodies, dt / 2, 0.5f, Parallelism::none);
  EXPECT_TRUE(sweeps.changed());
}

}  // namespace
}  // namespace carom::test

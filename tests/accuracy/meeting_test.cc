// The reference of carom tunnelling, against times known by hand and against a dense sequence of
// poses.
#include "accuracy/tunnelling/meeting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "accuracy/tunnelling/meetings.h"
#include "carom/shapes/mesh_geometry.h"
#include "oracle/convex_oracle.h"
#include "oracle/convex_random.h"

namespace carom::accuracy {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

MovingBody body(const Shape& shape, const Vector3d& position,
                const Vector3f& displacement = {0, 0, 0}, const Vector3f& rotation = {0, 0, 0}) {
  MovingBody moving;
  moving.desc.shape = shape;
  moving.desc.position = position;
  moving.sweep = {.displacement = displacement, .rotation = rotation};
  return moving;
}

MeetingTime meeting_of(const MovingBody& a, const MovingBody& b, int substeps = 100) {
  MeetingSearch search(substeps);
  return search(a, moving_parts(a), b, moving_parts(b));
}

// Tests (A, B) and (B, A).
void expect_meeting(const MovingBody& a, const MovingBody& b, Meeting meeting, double time) {
  for (const MeetingTime& found : {meeting_of(a, b), meeting_of(b, a)}) {
    EXPECT_EQ(found.meeting, meeting);
    if (std::isinf(time)) continue;
    EXPECT_LE(found.until, found.by);
    EXPECT_NEAR(found.until, time, 1e-8);
    EXPECT_NEAR(found.by, time, 1e-8);
  }
}

TEST(Meeting, BallsAndBoxes) {
  const MovingBody ball = body(Sphere{0.25f}, {-1, 0, 0}, {2, 0, 0});
  expect_meeting(ball, body(carom::Box{{0.25f, 1, 1}}, {0, 0, 0}), Meeting::certain, 0.25);
  expect_meeting(ball, body(carom::Box{{0.25f, 1, 1}}, {0, 0, 0}, {-2, 0, 0}), Meeting::certain,
                 0.125);
  expect_meeting(ball, body(carom::Box{{0.25f, 1, 1}}, {-0.75, 0, 0}), Meeting::certain, 0);
  expect_meeting(ball, body(carom::Box{{0.25f, 1, 1}}, {2, 0, 0}), Meeting::none, kNever);
  expect_meeting(ball, body(Halfspace{Vector3f::UnitX(), -3}, {0, 0, 0}), Meeting::none, kNever);
  expect_meeting(ball, body(Halfspace{-Vector3f::UnitX(), -0.5f}, {0, 0, 0}), Meeting::certain,
                 0.625);
}

TEST(Meeting, GrazesAreToldApart) {
  const MovingBody ball = body(Sphere{0.25f}, {-1, 0, 0}, {2, 0, 0});
  const auto passes_at = [](double gap) { return body(Sphere{0.25f}, {0, 0.5 + gap, 0}); };
  expect_meeting(ball, passes_at(1e-6), Meeting::none, kNever);
  expect_meeting(ball, passes_at(1e-8), Meeting::grazing, kNever);
  expect_meeting(ball, passes_at(-1e-8), Meeting::grazing, kNever);
  // The balls meet when their centres are half a metre apart.
  const double before = std::sqrt(0.25 - std::pow(0.5 - 1e-6, 2));
  expect_meeting(ball, passes_at(-1e-6), Meeting::certain, (1 - before) / 2);
}

// Only the rotation brings them together.
TEST(Meeting, ARodThatTurns) {
  const auto half_turn = static_cast<float>(std::numbers::pi);
  const MovingBody rod =
      body(carom::Box{{1, 0.01f, 0.01f}}, {0, 0, 0}, {0, 0, 0}, {0, 0, half_turn});
  const double angle = std::numbers::pi / 2 - std::asin((double{0.01f} + double{0.02f}) / 0.5);
  expect_meeting(rod, body(Sphere{0.02f}, {0, 0.5, 0}), Meeting::certain,
                 angle / double{half_turn});
  expect_meeting(rod, body(Sphere{0.02f}, {0, 1.1, 0}), Meeting::none, kNever);
}

TEST(Meeting, OneSidedTrianglesLetPassWhatComesFromBehind) {
  const auto mesh = [](bool one_sided) {
    const Vector3f corners[] = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    const std::array<uint32_t, 3> triangles[] = {{0, 1, 2}};
    return body(Mesh{*make_mesh(corners, triangles, {.one_sided = one_sided})}, {0, 0, 0});
  };
  const MovingBody down = body(Sphere{0.125f}, {0, 0, 0.625}, {0, 0, -2});
  const MovingBody up = body(Sphere{0.125f}, {0, 0, -0.625}, {0, 0, 2});
  expect_meeting(down, mesh(true), Meeting::certain, 0.25);
  expect_meeting(up, mesh(true), Meeting::none, kNever);
  expect_meeting(up, mesh(false), Meeting::certain, 0.25);
}

// Tests a dense sequence of poses without skipping any; orientations are rounded to float32.
struct EveryPose {
  double least = kNever;
  double first = kNever;  // the first pose with an overlap beyond rounding

  EveryPose(const MovingBody& a, const MovingBody& b, int substeps) {
    for (int i = 0; i <= substeps; ++i) {
      const double t = static_cast<double>(i) / substeps;
      const oracle::ConvexOracle<double> at(a.desc.shape, pose_at(a, t), b.desc.shape,
                                            pose_at(b, t));
      const double gap = at.separation().value;
      least = std::min(least, gap);
      if (gap < -1e-6 && std::isinf(first)) first = t;
    }
  }
};

MovingBody random_body(ShapeKind kind, oracle::Random& random, oracle::ConvexRandom& shapes) {
  MovingBody moving = body(shapes.shape(kind, 1), random.direction() * random.uniform(2, 4));
  moving.sweep.displacement = (-moving.desc.position * random.uniform(0, 2)).cast<float>();
  moving.sweep.rotation = (random.direction() * random.uniform(0, 3)).cast<float>();
  moving.desc.orientation = Eigen::Quaternionf(Eigen::AngleAxisf(
      static_cast<float>(random.uniform(0, 3)), random.direction().cast<float>()));
  return moving;
}

TEST(Meeting, NothingThatAnyPoseShowsIsMissed) {
  constexpr int kPairs = 300, kPoses = 100;
  constexpr ShapeKind kKinds[] = {ShapeKind::sphere, ShapeKind::capsule, ShapeKind::box,
                                  ShapeKind::hull, ShapeKind::triangle};
  oracle::Random random(7);
  const oracle::ConvexStyle style;
  oracle::ConvexRandom shapes(style, random);
  size_t met = 0, missed_by_poses = 0, early = 0;
  for (int i = 0; i < kPairs; ++i) {
    const MovingBody a = random_body(kKinds[i % 5], random, shapes);
    const MovingBody b = random_body(kKinds[i / 5 % 5], random, shapes);
    const EveryPose poses(a, b, kPoses);
    const MeetingTime found = meeting_of(a, b, 1 + static_cast<int>(random.below(100)));
    met += found.meeting == Meeting::certain;
    if (std::isinf(poses.first)) {
      missed_by_poses += found.meeting == Meeting::certain;
      continue;
    }
    EXPECT_EQ(found.meeting, Meeting::certain) << i;
    EXPECT_LE(found.by, poses.first) << i;
    early += found.by < poses.first - 1.01 / kPoses;
    EXPECT_LE(found.by - found.until, 1e-10) << i;
  }
  EXPECT_GT(met, kPairs / 3);
  EXPECT_LT(met, kPairs * 9 / 10);
  // Dense poses miss overlaps that last for less than the time between two poses.
  EXPECT_LT(missed_by_poses + early, kPairs / 20);
}

}  // namespace
}  // namespace carom::accuracy

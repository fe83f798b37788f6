// One-sided triangles are hit only by bodies whose middle is in front of the back plane at the
// first touch.
#include <gtest/gtest.h>

#include "oracle/random.h"
#include "tests/support/impacts.h"

namespace carom::test {
namespace {

// How far the other body's middle is in front of the triangle's back plane at `time`; for a
// half-space, how much its normal points to the back. Zero for triangles without area.
double in_front(const MovedPair& pair, double time) {
  const auto& [a, b] = pair.bodies;
  const auto& triangle = std::get<Triangle>(a.shape);
  const MovingShape<double> sheet(a.shape, a.pose(), pair.sweep_a);
  const MovingShape<double> other(b.shape, b.pose(), pair.sweep_b);
  const auto& corners = sheet.points();
  const Vec3<double> front =
      sheet.turn(time)(normalized(cross(corners[1] - corners[0], corners[2] - corners[0])));
  if (other.is_halfspace()) return -dot(front, other.turn(time)(other.normal()));
  const Vec3<double> between = moving_pair<double>(pair).between(time);
  const Vec3<double> way =
      between + other.turn(time)(other.middle()) - sheet.turn(time)(corners[0]);
  return dot(front, way) + triangle.thickness;
}

// A triangle with another kind of body, and whether it must report an impact.
struct Approach {
  MovedPair pair;
  bool is_impact;
};

std::vector<Approach> approaches(ShapeKind other, size_t count) {
  std::vector<Approach> all;
  MotionMaker maker(plain_motions()[1], {ShapeKind::triangle, other}, 1);
  while (all.size() < count) {
    MovedPair pair = maker.next();
    std::get<Triangle>(pair.bodies.a.shape).one_sided = true;
    const ImpactBracket<double> touch = impact(pair);
    if (touch.meeting == Meeting::none) {
      all.push_back({pair, false});
      continue;
    }
    const double size = moving_pair<double>(pair).size();
    const double height = in_front(pair, touch.low);
    if (std::fabs(height) > 1e-6 * size) all.push_back({pair, height > 0});
  }
  return all;
}

TEST(OneSidedTriangles, AreMetFromTheFrontAlone) {
  for (const ShapeKind other : kConvexKinds) {
    if (other == ShapeKind::triangle) continue;
    SCOPED_TRACE(name(other));
    size_t impacts = 0, count = 0;
    for (const Approach& approach : approaches(other, 100)) {
      SCOPED_TRACE(show(approach.pair));
      const ImpactRow row = impact_of(approach.pair);
      EXPECT_EQ(row.is_impact(), approach.is_impact) << show(row);
      EXPECT_EQ(impact_of(swapped(approach.pair)).toi, row.toi);
      if (approach.is_impact) {
        EXPECT_EQ(judge(approach.pair, row.toi).fault, Fault::none) << show(row);
      }
      if (HasFailure()) return;
      impacts += row.is_impact();
      ++count;
    }
    EXPECT_GE(impacts, count / 8);
    EXPECT_LE(impacts, count * 7 / 8);
  }
}

// A body that enters through the back passes, even when it leaves through the front.
TEST(OneSidedTriangles, LetPassWhatComesFromBehind) {
  MovedPair pair{{triangle({0, 0, 0}, {Eigen::Vector3f(-2, -2, 0), Eigen::Vector3f(2, -2, 0),
                                       Eigen::Vector3f(0, 2, 0)}),
                  sphere(0, 0, -4, 1)},
                 {},
                 {}};
  std::get<Triangle>(pair.bodies.a.shape).one_sided = true;
  pair.sweep_b.displacement = {0, 0, 8};
  for (const float thickness : {0.0f, 0.5f}) {
    std::get<Triangle>(pair.bodies.a.shape).thickness = thickness;
    EXPECT_EQ(impact_of(pair).toi, kNever);
    EXPECT_EQ(impact_of(swapped(pair)).toi, kNever);
  }
  pair.bodies.b.position.z() = 4;
  pair.sweep_b.displacement = {0, 0, -8};
  EXPECT_NEAR(impact_of(pair).toi, 0.375, 1e-6);
  // The middle is behind the triangle at the start, and the body leaves to the front.
  pair.bodies.b.position.z() = -0.75;
  pair.sweep_b.displacement = {0, 0, 8};
  EXPECT_EQ(impact_of(pair).toi, kNever);
}

// The middle of a point lies in the plane when it gets there, so its way decides, however long it
// is beside the triangle; and where it turns, its way at that time.
TEST(OneSidedTriangles, LetPassPointsFromBehind) {
  oracle::Random random(71);
  for (const double size : {1e-20, 1.0, 1e15}) {
    for (int round = 0; round < 60; ++round) {
      const auto s = static_cast<float>(size);
      MovedPair pair{{triangle({0, 0, 0}, {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(s, 0, 0),
                                           Eigen::Vector3f(0, s, 0)}),
                      sphere(0, 0, 0, 0)},
                     {},
                     {}};
      auto& sheet = std::get<Triangle>(pair.bodies.a.shape);
      sheet.one_sided = true;
      const Eigen::Vector3d aim(random.uniform(0.1, 0.4) * size, random.uniform(0.1, 0.4) * size,
                                0);
      const double length = size * random.log_uniform(0.1, 1e4);
      Eigen::Vector3d way = random.direction() * length;
      if (std::fabs(way.z()) < 0.1 * length) way.z() = length;
      for (const float thickness : {0.0f, 0.25f * s}) {
        sheet.thickness = thickness;
        for (const bool from_behind : {false, true}) {
          if ((way.z() > 0) != from_behind) way = -way;
          // Through the plane that it meets first.
          const Eigen::Vector3d middle = aim - Eigen::Vector3d(0, 0, from_behind ? thickness : 0);
          pair.bodies.b.position = middle - 0.5 * way;
          pair.sweep_b.displacement = way.cast<float>();
          pair.sweep_b.rotation = {0, 0, 0};
          pair.sweep_a.rotation = {0, 0, 0};
          SCOPED_TRACE(show(pair));
          EXPECT_EQ(impact_of(pair).is_impact(), !from_behind);
          EXPECT_EQ(impact_of(swapped(pair)).is_impact(), !from_behind);
          pair.sweep_a.rotation = {0, 0, 0.5f};  // about the normal, so that it keeps its plane
          EXPECT_EQ(impact_of(pair).is_impact(), !from_behind);
          if (HasFailure()) return;
        }
      }
    }
  }
}

}  // namespace
}  // namespace carom::test

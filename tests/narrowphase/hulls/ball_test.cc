// Hulls decided by balls in and about them: the scalar form on every instruction set, and never
// otherwise than the hulls themselves.
#include <gtest/gtest.h>

#include "narrowphase/batch/batch.h"
#include "narrowphase/batch/column_memory.h"
#include "narrowphase/hulls/ball_scalar.h"
#include "narrowphase/scalar/scaled.h"
#include "shapes/hull_features.h"
#include "tests/narrowphase/hulls/scaled_hulls.h"
#include "tests/support/hull_pairs.h"
#include "tests/support/isas.h"
#include "tests/support/rounds.h"
#include "tests/support/run.h"

namespace carom::test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using oracle::Random;

Hull random_hull(size_t points, float size, Random& random) {
  const auto half = [&] { return size * static_cast<float>(random.uniform(0.4, 1)); };
  return oracle::hull_of(round_points(points, {half(), half(), half()}, random));
}

// Pairs whose distances are between none and the sum of their sizes.
std::vector<HullPair> random_pairs(size_t count, size_t points, double size, Random& random) {
  std::vector<HullPair> pairs;
  while (pairs.size() < count) {
    const auto extent = static_cast<float>(size);
    const Vector3f d = (random.direction() * size * random.uniform(0, 2.5)).cast<float>();
    pairs.push_back({random_hull(points, extent, random),
                     random_hull(points, extent, random),
                     {d, random_turn(random), random_turn(random)}});
  }
  return pairs;
}

scalar::BallDecision expected_decision(const HullPair& pair) {
  const scalar::HullShape<float> a{pair.a.geometry.get(), 1}, b{pair.b.geometry.get(), 1};
  const auto scale = scalar::scale_of_pair(a, b, pair.pose);
  return scalar::decide_by_balls(a.scaled(scale.down), b.scaled(scale.down),
                                 scalar::scaled_pose(pair.pose, scale), scale.up);
}

// The pairs as a set of bodies: A of pair i is body 2 i, at the origin.
std::vector<PlacedShape> bodies_of(std::span<const HullPair> pairs) {
  std::vector<PlacedShape> bodies;
  const auto add = [&](const Hull& hull, const scalar::Quaternion<float>& turn,
                       const Vector3f& at) {
    PlacedShape body{hull};
    body.position = at.cast<double>();
    body.orientation.coeffs() << turn.v, turn.w;
    bodies.push_back(body);
  };
  for (const HullPair& pair : pairs) {
    add(pair.a, pair.pose.a, Vector3f::Zero());
    add(pair.b, pair.pose.b, pair.pose.d);
  }
  return bodies;
}

struct Decisions {
  std::array<uint8_t, kPairsPerBlock> is_open{};
  TestColumns columns;
};

void decide(const Collidables& bodies, std::span<const Pair> pairs, Decisions& found) {
  BatchSide side;
  side.records = bodies.position.data;
  side.record_stride = bodies.position.stride;
  side.orientation = bodies.orientation;
  side.rows = bodies.rows;
  Batch batch;
  batch.a = batch.b = side;
  batch.pairs = pairs.data();
  batch.count = pairs.size();
  batch.detail = Detail::overlap;
  batch.pass = Pass::balls;
  batch.unsure = found.is_open.data();
  batch.out = found.columns.columns();
  run_hull_hull(batch);
}

void check_pairs(std::span<const HullPair> hulls, size_t& decided, size_t& overlaps) {
  const LaidOut bodies(bodies_of(hulls), call_with(PositionType::float32).layout_a);
  std::vector<Pair> pairs;
  std::vector<scalar::BallDecision> expected;
  for (uint32_t i = 0; i < hulls.size(); ++i) {
    pairs.push_back({2 * i, 2 * i + 1});
    expected.push_back(expected_decision(hulls[i]));
    if (!expected[i].is_sure) continue;
    ASSERT_EQ(exact_separation(hulls[i]).separation <= 0, expected[i].overlap) << i;
    ++decided;
    overlaps += expected[i].overlap;
  }
  for_each_isa([&] {
    Decisions found;
    decide(bodies.view(), pairs, found);
    for (size_t i = 0; i < hulls.size(); ++i) {
      ASSERT_EQ(found.is_open[i], expected[i].is_sure ? 0 : 1) << i;
      if (!expected[i].is_sure) continue;
      ASSERT_EQ(found.columns.columns().overlap[i], expected[i].overlap) << i;
    }
  });
}

TEST(Balls, DecideAsTheHullsDo) {
  Random random(1);
  size_t all = 0, decided = 0, overlaps = 0;
  for (const double size : {1e-30, 1e-6, 1.0, 1e6, 1e20, 1e30}) {
    SCOPED_TRACE(size);
    for (const size_t points : {4, 12, 64, 150}) {
      const size_t count = points == 150 ? rounds(3, 1) : rounds(60, 6);
      const std::vector<HullPair> pairs = random_pairs(count, points, size, random);
      all += size > 1e-28 && size < 1e28 ? count : 0;
      check_pairs(pairs, decided, overlaps);
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(decided, all / 4);
  EXPECT_GT(overlaps, decided / 8);
  EXPECT_LT(overlaps, decided * 7 / 8);
}

TEST(Balls, OfAnyNumberOfPairs) {
  Random random(2);
  const std::vector<HullPair> pairs = random_pairs(35, 12, 1, random);
  size_t decided = 0, overlaps = 0;
  for (size_t count = 0; count <= pairs.size(); ++count) {
    check_pairs(std::span(pairs).first(count), decided, overlaps);
  }
}

// In double precision, which is precise enough by far: radii are rounded by 2^-20.
TEST(Balls, HoldTheHullAndLieInIt) {
  Random random(3);
  std::vector<Hull> hulls = solid_hulls();
  for (size_t i = 0; i < rounds(100, 10); ++i) {
    const auto size = static_cast<float>(random.log_uniform(1e-6, 1e6));
    Hull hull = random_hull(4 + random.below(100), size, random);
    hulls.push_back(hull);
  }
  for (const Hull& hull : hulls) {
    const HullGeometry& geometry = *hull.geometry;
    const HullGeometry::Balls& balls = geometry.balls();
    const Vector3d middle = Vector3f(balls.outer.data()).cast<double>();
    const double outer = balls.outer[3];
    double furthest = 0, nearest = HUGE_VAL;
    for (const Vector3f& point : geometry.points()) {
      furthest = std::max(furthest, (point.cast<double>() - middle).norm());
    }
    ASSERT_TRUE(geometry.features());
    for (size_t f = 0; f < geometry.faces().size(); ++f) {
      const std::span<const uint32_t> corners = geometry.corners(geometry.faces()[f]);
      const auto corner = [&](size_t k) -> Vector3d {
        return geometry.points()[corners[k % corners.size()]].cast<double>() - middle;
      };
      Vector3d normal = Vector3d::Zero();  // some corners may lie on a line
      for (size_t k = 0; k < corners.size(); ++k) normal += corner(k).cross(corner(k + 1));
      nearest = std::min(nearest, normal.normalized().dot(corner(0)));
    }
    EXPECT_GE(outer, furthest);
    EXPECT_LE(outer, furthest * (1 + 1e-5));
    EXPECT_LE(balls.inner, nearest);
    EXPECT_GE(balls.inner, nearest - 1e-4 * double{geometry.size()});
  }
  for (const Hull& hull : hulls_of_unknown_faces()) {
    if (hull.geometry->features()) continue;
    EXPECT_EQ(hull.geometry->balls().inner, 0);
  }
}

// Contacts ask no balls. `reach`: of the distances, in sizes; some bodies are invalid.
void check_calls(double reach_from, double reach_to, size_t points, Random& random) {
  std::vector<TestPair> pairs;
  for (const HullPair& hulls : random_pairs(rounds(300, 80), points, 1, random)) {
    const std::array<HullPair, 1> one = {hulls};
    const std::vector<PlacedShape> bodies = bodies_of(one);
    TestPair pair{bodies[0], bodies[1]};
    pair.b.position = random.direction() * random.uniform(reach_from, reach_to);
    pair.b.position = stored(pair.b.position, PositionType::float32);
    if (random.chance(0.05)) pair.a.position.y() = NAN;
    if (random.chance(0.05)) pair.b.orientation.coeffs().setZero();
    pairs.push_back(pair);
  }
  Call call = call_with(PositionType::float32);
  const LaidOutRowPairs laid_out(pairs, call);
  const std::vector<Row> expected = laid_out.run(call);
  call.detail = Detail::overlap;
  for_each_isa([&] {
    const std::vector<Row> rows = laid_out.run(call);
    for (size_t i = 0; i < pairs.size(); ++i) {
      ASSERT_EQ(rows[i].overlap, expected[i].overlap) << i;
      ASSERT_EQ(rows[i].status == static_cast<uint8_t>(Status::invalid),
                expected[i].status == static_cast<uint8_t>(Status::invalid))
          << i;
    }
  });
}

TEST(Balls, ChangeNoDecisionOfACall) {
  Random random(4);
  for (const size_t points : {8, 16, 40}) {
    check_calls(0, 2.2, points, random);    // balls decide many
    check_calls(1.2, 1.5, points, random);  // and few
  }
}

// Points so far from each other that the square of their distance overflows.
TEST(Balls, OfHugeHullsDecideNothing) {
  const float far = 3e38f;
  const Points points = {{far, far, far}, {-far, far, -far}, {far, -far, -far}, {-far, -far, far}};
  const Hull hull{*make_hull(points, {})};
  EXPECT_GE(hull.geometry->balls().outer[3], far);
  const HullPair pair = {
      hull, hull, {Vector3f(far, 0, 0), {Vector3f::Zero(), 1}, {Vector3f::Zero(), 1}}};
  EXPECT_FALSE(expected_decision(pair).is_sure);
}

}  // namespace
}  // namespace carom::test

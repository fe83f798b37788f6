// Gaps of round cores in lanes of doubles against the scalar form, and the scalar form against the
// careful searches.
#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <numbers>
#include <vector>

#include "narrowphase/pairs/core_row.h"
#include "oracle/random.h"
#include "tests/support/isas.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

using Eigen::Vector3d;
using oracle::Random;
using scalar::PairPose;
using scalar::RoundGoal;

double draw_size(Random& random) {
  return static_cast<float>(random.chance(0.1) ? random.uniform(1e-3, 1e-2)
                                               : random.uniform(0.25, 1));
}
double draw_rounding(Random& random) {
  return random.chance(0.3) ? static_cast<float>(random.uniform(0.05, 0.3)) : 0;
}
scalar::CylinderShape<double> draw_cylinder(Random& random) {
  return {draw_size(random), random.chance(0.1) ? 0 : draw_size(random), draw_rounding(random)};
}
scalar::ConeShape<double> draw_cone(Random& random) {
  return {draw_size(random), random.chance(0.1) ? 0 : draw_size(random), draw_rounding(random)};
}
scalar::EllipsoidShape<double> draw_ellipsoid(Random& random) {
  return {{draw_size(random), draw_size(random), draw_size(random)}, draw_rounding(random)};
}
Vector3d draw_point(Random& random) {
  const Vector3d p = random.direction() * random.uniform(0.2, 1);
  return p.cast<float>().cast<double>();
}
scalar::CapsuleShape<double> draw_any_capsule(Random& random) {
  return {draw_point(random), draw_point(random), draw_size(random)};
}
scalar::BoxShape<double> draw_plain_box(Random& random) {
  return {{draw_size(random), draw_size(random), draw_size(random)}};
}
scalar::TriangleShape<double> draw_triangle(Random& random) {
  return {{draw_point(random), draw_point(random), draw_point(random)}, 0, false, 0, false};
}
scalar::HullShape<double> draw_round_hull(Random& random) {
  static std::vector<std::shared_ptr<const HullGeometry>> geometries;
  std::vector<Eigen::Vector3f> points;
  for (size_t i = 0; i < 16; ++i) points.push_back(random.direction().cast<float>());
  geometries.push_back(*make_hull(points, {}));
  return {geometries.back().get(), 1};
}

scalar::Quaternion<double> draw_any_turn(Random& random) {
  if (random.chance(0.1)) return {Vector3d::Zero(), 1};
  const Vector3d axis = random.direction();
  const double angle = random.uniform(0, std::numbers::pi);
  return {axis * std::sin(angle), std::cos(angle)};
}

enum class RoundPlace { mixed, touching };

template <class A, class B>
struct RoundPair {
  A a;
  B b;
  PairPose<double> pose;
};

template <class A, class B>
void place_cores(const RoundPair<A, B>& pair, double down, CorePair& cores) {
  scalar::make_core(pair.a.scaled(down), pair.pose.a, Vector3d::Zero(), cores.a);
  scalar::make_core(pair.b.scaled(down), pair.pose.b, pair.pose.d * down, cores.b);
}

template <class A, class B>
double separation_of(const RoundPair<A, B>& pair) {
  CorePair cores;
  place_cores(pair, 1, cores);
  return scalar::find_gap(cores.a, cores.b, {}).size - (cores.a.radius + cores.b.radius);
}

template <class DrawA, class DrawB>
auto draw_pair(Random& random, RoundPlace place, const DrawA& draw_a, const DrawB& draw_b) {
  const auto turn_a = draw_any_turn(random), turn_b = draw_any_turn(random);
  RoundPair<decltype(draw_a(random)), decltype(draw_b(random))> pair{
      draw_a(random), draw_b(random), {Vector3d::Zero(), turn_a, turn_b}};
  const Vector3d way = random.direction();
  pair.pose.d = way * random.uniform(0, 2.5);
  if (place == RoundPlace::mixed) return pair;
  double low = 0, high = 8;
  for (int round = 0; round < 30; ++round) {
    const double middle = (low + high) / 2;
    pair.pose.d = way * middle;
    (separation_of(pair) <= 0 ? low : high) = middle;
  }
  pair.pose.d += way * random.uniform(-1e-7, 1e-7);
  return pair;
}

bool are_bits_of(float a, float b) { return std::memcmp(&a, &b, sizeof a) == 0; }

struct FoundRounds {
  size_t apart = 0, found_apart = 0, overlapping = 0, found_overlapping = 0;
};

// Compares a row with the scalar form.
template <class A, class B>
void expect_scalar_form(const RoundPair<A, B>& pair, const CoreRowsWithPoints& rows, size_t row,
                        FoundRounds& count) {
  const double down = rows.column[CoreRows::kDown][row];
  const RoundGoal goal{rows.decides_separate, rows.decides_only};
  CorePair cores;
  place_cores(pair, down, cores);
  const scalar::RoundGjk gjk(cores.a, cores.b, &scalar::furthest_point, goal);
  scalar::CoreGap gap;
  const bool is_found = scalar::find_plain_round_gap(gjk, goal, gap);
  ASSERT_EQ(rows.is_found[row], is_found);
  const bool is_apart = separation_of(pair) > 0;
  (is_apart ? count.apart : count.overlapping) += 1;
  if (!is_found) return;
  (is_apart ? count.found_apart : count.found_overlapping) += 1;
  auto expected = scalar::core_separation(cores.a, cores.b, gap, pair.pose.d * down,
                                          {.decides_only = rows.decides_only});
  EXPECT_EQ(rows.is_unsure[row], expected.is_unsure);
  scalar::put_in_metres(expected, scalar::DoubleScale{1 / down, down});
  const scalar::Separation s = scalar::rounded(expected);
  EXPECT_TRUE(are_bits_of(rows.answer[0][row], s.separation));
  if (!rows.is_unsure[row]) {
    EXPECT_EQ(s.separation > 0, is_apart);
  }
  for (int axis = 0; axis < 3 && !rows.decides_only; ++axis) {
    const auto column = static_cast<size_t>(axis);
    EXPECT_TRUE(are_bits_of(rows.answer[1 + column][row], s.normal[axis]));
    EXPECT_TRUE(are_bits_of(rows.answer[4 + column][row], s.arm_a[axis]));
    EXPECT_TRUE(are_bits_of(rows.answer[7 + column][row], s.arm_b[axis]));
  }
}

template <class DrawA, class DrawB>
FoundRounds compare_rows(RoundPlace place, const RoundGoal& goal, const DrawA& draw_a,
                         const DrawB& draw_b) {
  Random random(7);
  FoundRounds count;
  const auto memory = std::make_unique<CoreRowsWithPoints>();
  CoreRowsWithPoints& rows = *memory;
  rows.decides_separate = goal.decides_separate;
  rows.decides_only = goal.decides_overlapping;
  for (const size_t most : {CoreRows::kMost, size_t{63}, size_t{9}, size_t{8}, size_t{1}}) {
    std::vector<decltype(draw_pair(random, place, draw_a, draw_b))> pairs;
    rows.count = 0;
    while (rows.count < most) {
      pairs.push_back(draw_pair(random, place, draw_a, draw_b));
      EXPECT_TRUE(add_core_row(pairs.back().a, pairs.back().b, pairs.back().pose, rows));
    }
    for_each_isa([&] {
      find_core_gaps()(rows);
      for (size_t row = 0; row < most; ++row) {
        SCOPED_TRACE(row);
        expect_scalar_form(pairs[row], rows, row, count);
      }
    });
  }
  return count;
}

// Lanes find nearly all distances but those of touching cores, and nearly all decisions. The others
// are those of thin shapes.
template <class DrawA, class DrawB>
void expect_answers(const DrawA& draw_a, const DrawB& draw_b) {
  for (const RoundGoal& goal : {RoundGoal{}, RoundGoal{true, false}, RoundGoal{true, true}}) {
    SCOPED_TRACE(testing::Message() << goal.decides_separate << goal.decides_overlapping);
    compare_rows(RoundPlace::touching, goal, draw_a, draw_b);
    const FoundRounds count = compare_rows(RoundPlace::mixed, goal, draw_a, draw_b);
    const size_t all = count.apart + count.overlapping;
    EXPECT_GT(count.apart * 5, all);
    EXPECT_GT(count.overlapping * 5, all);
    EXPECT_GE(count.found_apart * 100, count.apart * 95);
    if (goal.decides_overlapping) {
      EXPECT_GE(count.found_overlapping * 100, count.overlapping * 95);
    }
  }
}

TEST(RoundRows, OfCylindersAreThoseOfTheScalarForm) {
  expect_answers(draw_cylinder, draw_cone);
  expect_answers(draw_cylinder, draw_ellipsoid);
}
TEST(RoundRows, OfConesAreThoseOfTheScalarForm) {
  expect_answers(draw_cone, draw_cone);
  expect_answers(draw_cone, draw_ellipsoid);
  expect_answers(draw_cone, draw_triangle);
}
TEST(RoundRows, WithPointsAreThoseOfTheScalarForm) {
  expect_answers(draw_any_capsule, draw_ellipsoid);
  expect_answers(draw_plain_box, draw_cone);
  expect_answers(draw_round_hull, draw_ellipsoid);
}

// Where plain simplices find a distance, the careful search finds no other, and no gap along any
// way is greater.
template <class DrawA, class DrawB>
void expect_careful_distance(const DrawA& draw_a, const DrawB& draw_b) {
  Random random(8);
  size_t found = 0;
  for (uint32_t round = 0; round < rounds(500); ++round) {
    const auto pair = draw_pair(random, RoundPlace::mixed, draw_a, draw_b);
    CorePair cores;
    place_cores(pair, 0.25, cores);
    const FurthestPoint furthest = &scalar::furthest_point;
    const scalar::RoundGjk gjk(cores.a, cores.b, furthest, {});
    scalar::CoreGap gap;
    if (!scalar::find_plain_round_gap(gjk, {}, gap)) continue;
    ++found;
    const NearestWay careful = nearest_round_way(cores.a, cores.b, furthest);
    EXPECT_NEAR(gap.size, std::sqrt(dot(careful.way, careful.way)), 0x1p-27);
    const CoreVector on_b = gap.of_a + gap.normal * gap.size;
    EXPECT_NEAR(dot(gap.normal, support_point(cores.a, gap.normal, furthest) - gap.of_a), 0,
                0x1p-27);
    EXPECT_NEAR(dot(gap.normal, support_point(cores.b, -gap.normal, furthest) - on_b), 0, 0x1p-27);
  }
  EXPECT_GT(found, rounds(500) / 4);
}

TEST(RoundRows, DistancesAreThoseOfTheCarefulSearch) {
  expect_careful_distance(draw_cone, draw_cone);
  expect_careful_distance(draw_cylinder, draw_ellipsoid);
  expect_careful_distance(draw_plain_box, draw_ellipsoid);
  expect_careful_distance(draw_round_hull, draw_cone);
}

}  // namespace
}  // namespace carom::test

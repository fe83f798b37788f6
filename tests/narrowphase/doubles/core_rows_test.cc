// Gaps of cores in lanes of doubles against the scalar form, and the scalar form against the
// careful searches.
#include "narrowphase/doubles/core_rows.h"

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
using scalar::HullShape;
using scalar::PairPose;

enum class CoreForm { round, grid, flat, needle, cube };
constexpr std::array kCoreForms = {CoreForm::round, CoreForm::grid, CoreForm::flat,
                                   CoreForm::needle, CoreForm::cube};

std::shared_ptr<const HullGeometry> draw_geometry(Random& random, CoreForm form) {
  std::vector<Eigen::Vector3f> points;
  const size_t count = form == CoreForm::cube ? 8 : 4 + random.below(30);
  for (size_t i = 0; i < count; ++i) {
    Vector3d p = random.direction();
    if (form == CoreForm::grid) p = (p * 3).array().round() / 2;
    if (form == CoreForm::flat) p.z() *= 1e-6;
    if (form == CoreForm::needle) p = {p.x(), p.y() * 1e-5, p.z() * 1e-5};
    if (form == CoreForm::cube) p = {i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0};
    points.push_back(p.cast<float>());
  }
  return *make_hull(points, {});
}

// The geometry lives as long as the tests.
HullShape<double> draw_hull(Random& random, CoreForm form) {
  static std::vector<std::shared_ptr<const HullGeometry>> geometries;
  geometries.push_back(draw_geometry(random, form));
  return {geometries.back().get(), 1};
}

scalar::Quaternion<double> draw_turn(Random& random, bool is_upright) {
  if (is_upright) return {Vector3d::Zero(), 1};
  const double angle = random.uniform(0, 2 * std::numbers::pi);
  const Eigen::AngleAxisd turn(angle, random.direction());
  const Eigen::Quaterniond q(turn);
  return {q.vec(), q.w()};
}

template <class A>
scalar::CoreGap core_gap_of(const A& a, const HullShape<double>& b, const PairPose<double>& pose) {
  Core core_a, core_b;
  scalar::make_core(a, pose.a, Vector3d::Zero(), core_a);
  scalar::make_core(b, pose.b, pose.d, core_b);
  scalar::CoreGap gap = scalar::find_gap(core_a, core_b, {});
  gap.size -= core_a.radius;
  return gap;
}

enum class CorePlace { touching, shallow, apart, deep, corner };
constexpr std::array kCorePlaces = {CorePlace::touching, CorePlace::shallow, CorePlace::apart,
                                    CorePlace::deep, CorePlace::corner};

// Puts B on its way out of A.
template <class A>
void draw_place(Random& random, const A& a, const HullShape<double>& b, CorePlace place,
                PairPose<double>& pose) {
  const Vector3d way = random.direction();
  if (place == CorePlace::apart || place == CorePlace::deep) {
    pose.d = way * (place == CorePlace::apart ? random.uniform(2, 5) : random.uniform(0, 0.5));
    return;
  }
  double low = 0, high = 8;
  for (int round = 0; round < 60; ++round) {
    const double middle = (low + high) / 2;
    pose.d = way * middle;
    (core_gap_of(a, b, pose).size <= 0 ? low : high) = middle;
  }
  if (place == CorePlace::shallow) pose.d += way * random.uniform(-1e-6, 1e-6);
  if (place != CorePlace::corner) return;
  pose.d = way * (high + 0.5);
  const scalar::CoreGap gap = core_gap_of(a, b, pose);
  pose.d -= scalar::eigen_vector(gap.normal) * (gap.size - 1e-8);
}

bool has_same_bits(float a, float b) { return std::memcmp(&a, &b, sizeof a) == 0; }

struct FoundRows {
  size_t rows = 0, found = 0;
};

// Compares the answers of all rows with the scalar form.
template <class A>
void expect_scalar_form(const std::vector<A>& a, const std::vector<HullShape<double>>& b,
                        const std::vector<PairPose<double>>& poses, CoreRowsWithPoints& rows,
                        FoundRows& count) {
  find_core_gaps()(rows);
  const FurthestPoint furthest = &scalar::furthest_point;
  for (size_t row = 0; row < rows.count; ++row) {
    const double down = rows.column[CoreRows::kDown][row];
    const PairPose<double>& pose = poses[row];
    Core core_a, core_b;
    scalar::make_core(a[row].scaled(down), pose.a, Vector3d::Zero(), core_a);
    scalar::make_core(b[row].scaled(down), pose.b, pose.d * down, core_b);
    const scalar::PlainGjk gjk(core_a, core_b, furthest);
    scalar::CoreGap gap;
    const bool is_found =
        scalar::find_plain_gap(core_a, core_b, gjk, furthest, rows.decides_only, gap);
    ++count.rows;
    if (!rows.is_found[row]) {
      EXPECT_FALSE(is_found && rows.decides_only) << row;
      continue;
    }
    ++count.found;
    ASSERT_TRUE(is_found) << row;
    const Vector3d d = pose.d * down;
    auto expected =
        scalar::core_separation(core_a, core_b, gap, d, {.decides_only = rows.decides_only});
    EXPECT_EQ(rows.is_unsure[row], expected.is_unsure) << row;
    scalar::put_in_metres(expected, scalar::DoubleScale{1 / down, down});
    const scalar::Separation s = scalar::rounded(expected);
    EXPECT_TRUE(has_same_bits(rows.answer[0][row], s.separation)) << row;
    if (rows.decides_only) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const auto column = static_cast<size_t>(axis);
      EXPECT_TRUE(has_same_bits(rows.answer[1 + column][row], s.normal[axis])) << row;
      EXPECT_TRUE(has_same_bits(rows.answer[4 + column][row], s.arm_a[axis])) << row;
      EXPECT_TRUE(has_same_bits(rows.answer[7 + column][row], s.arm_b[axis])) << row;
    }
  }
}

template <class Draw>
FoundRows compare_rows(const Draw& draw, CorePlace place, bool decides_only) {
  Random random(3);
  FoundRows total;
  for (const CoreForm form : kCoreForms) {
    for (uint32_t round = 0; round < rounds(8); ++round) {
      using A = decltype(draw(random, form));
      std::vector<A> a;
      std::vector<HullShape<double>> b;
      std::vector<PairPose<double>> poses;
      const auto memory = std::make_unique<CoreRowsWithPoints>();
      CoreRowsWithPoints& rows = *memory;
      rows.decides_only = decides_only;
      // The most first, for sanitizers, which run few rounds.
      constexpr std::array<size_t, 8> kCounts = {CoreRows::kMost, 63, 9, 8, 7, 3, 2, 1};
      while (rows.count < kCounts[round % kCounts.size()]) {
        a.push_back(draw(random, form));
        b.push_back(draw_hull(random, form));
        const bool is_upright = random.chance(form == CoreForm::cube ? 0.7 : 0.1);
        constexpr bool kIsAabb = std::is_same_v<A, scalar::AabbShape<double>>;
        const auto turn_a = draw_turn(random, is_upright || kIsAabb);
        const auto turn_b = draw_turn(random, is_upright);
        PairPose<double> pose{Vector3d::Zero(), turn_a, turn_b};
        draw_place(random, a.back(), b.back(), place, pose);
        poses.push_back(pose);
        EXPECT_TRUE(add_core_row(a.back(), b.back(), pose, rows));
      }
      for_each_isa([&] { expect_scalar_form(a, b, poses, rows, total); });
    }
  }
  return total;
}

scalar::SphereShape<double> draw_sphere(Random& random, CoreForm) {
  return {static_cast<float>(random.uniform(0.1, 1))};
}
Vector3d draw_floats(Random& random, double low, double high) {
  const double x = random.uniform(low, high), y = random.uniform(low, high);
  const double z = random.uniform(low, high);
  return Vector3d(x, y, z).cast<float>().cast<double>();
}
scalar::CapsuleShape<double> draw_capsule(Random& random, CoreForm) {
  const Vector3d a = draw_floats(random, -1, 1), b = draw_floats(random, -1, 1);
  return {a, b, static_cast<float>(random.uniform(0.1, 0.5))};
}
scalar::BoxShape<double> draw_box(Random& random, CoreForm form) {
  if (form == CoreForm::cube) return {Vector3d(1, 1, 1)};
  return {draw_floats(random, 0.2, 1)};
}
scalar::AabbShape<double> draw_aabb(Random& random, CoreForm) {
  const Vector3d lower = draw_floats(random, -1, -0.2), upper = draw_floats(random, 0.2, 1);
  return {lower, upper};
}

// Lanes find most rows, but not where cores touch to the last bit, and seldom the contact of deep
// ones; all of these have to have the bits of the scalar form.
template <class Draw>
void expect_answers(const Draw& draw) {
  for (const CorePlace place : kCorePlaces) {
    for (const bool decides_only : {false, true}) {
      SCOPED_TRACE(testing::Message()
                   << "place " << static_cast<int>(place) << ", decides only " << decides_only);
      const FoundRows count = compare_rows(draw, place, decides_only);
      const bool is_seldom =
          place == CorePlace::touching || (place == CorePlace::deep && !decides_only);
      if (!is_seldom) {
        EXPECT_GT(count.found, count.rows / 2);
      }
      if (place == CorePlace::shallow && !decides_only) {
        EXPECT_GT(count.found, count.rows * 2 / 3);
      }
    }
  }
}

TEST(CoreRows, OfSpheresAreThoseOfTheScalarForm) { expect_answers(draw_sphere); }
TEST(CoreRows, OfCapsulesAreThoseOfTheScalarForm) { expect_answers(draw_capsule); }
TEST(CoreRows, OfAabbsAreThoseOfTheScalarForm) { expect_answers(draw_aabb); }
TEST(CoreRows, OfBoxesAreThoseOfTheScalarForm) { expect_answers(draw_box); }
TEST(CoreRows, OfHullsAreThoseOfTheScalarForm) { expect_answers(draw_hull); }

// Where plain searches find a gap, the careful ones find no other.
TEST(PlainGap, IsThatOfTheCarefulSearches) {
  const FurthestPoint furthest = &scalar::furthest_point;
  Random random(4);
  size_t apart = 0, overlapping = 0, rows = 0;
  for (const CoreForm form : kCoreForms) {
    for (const CorePlace place : kCorePlaces) {
      for (uint32_t round = 0; round < rounds(200); ++round) {
        const HullShape<double> a = draw_hull(random, form), b = draw_hull(random, form);
        const auto turn_a = draw_turn(random, false), turn_b = draw_turn(random, false);
        PairPose<double> pose{Vector3d::Zero(), turn_a, turn_b};
        draw_place(random, a, b, place, pose);
        Core core_a, core_b;
        scalar::make_core(a, pose.a, Vector3d::Zero(), core_a);
        scalar::make_core(b, pose.b, pose.d, core_b);
        const scalar::PlainGjk gjk(core_a, core_b, furthest);
        scalar::CoreGap gap;
        ++rows;
        if (!scalar::find_plain_gap(core_a, core_b, gjk, furthest, false, gap)) continue;
        const NearestWay nearest = nearest_way(core_a, core_b, furthest);
        const double distance = std::sqrt(dot(nearest.way, nearest.way));
        if (gap.size > 0) {
          ++apart;
          EXPECT_NEAR(gap.size, distance, 1e-11);
        } else {
          ++overlapping;
          const WayOut out = WayOutSearch(core_a, core_b, furthest).run(nearest.corners);
          EXPECT_NEAR(gap.size, out.gap, 1e-11);
        }
        EXPECT_NEAR(dot(gap.normal, gap.normal), 1, 1e-14);
        const CoreVector lowest = difference_point(core_a, core_b, gap.normal, furthest);
        EXPECT_NEAR(dot(gap.normal, lowest), gap.size, 1e-11);
      }
    }
  }
  EXPECT_GT(apart, rows / 10);
  EXPECT_GT(overlapping, rows / 20);
}

}  // namespace
}  // namespace carom::test

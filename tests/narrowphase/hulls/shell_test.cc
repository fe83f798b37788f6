// Shells: what they prove against exact distances, and depths of hulls that move against the search
// in double precision.
#include "narrowphase/hulls/shell.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "narrowphase/hulls/hull_steps.h"
#include "narrowphase/hulls/hull_steps_scalar.h"
#include "tests/narrowphase/hulls/scaled_hulls.h"
#include "tests/support/hulls.h"
#include "tests/support/isas.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using oracle::Random;
using scalar::HullShape;
using scalar::Separation;
using LongVector = Eigen::Matrix<long double, 3, 1>;

// --- What is proved of a surface ---

// A closed surface of any number of triangles: a polytope's faces, or folded at random.
struct Surface {
  Shell shell;
  ShellSpace space;
};

void add(Shell& shell, size_t i, size_t j, size_t k) {
  const size_t t = shell.triangle_count++;
  auto& group = shell.corner[t / Shell::kGroup];
  group[0][t % Shell::kGroup] = static_cast<uint8_t>(i);
  group[1][t % Shell::kGroup] = static_cast<uint8_t>(j);
  group[2][t % Shell::kGroup] = static_cast<uint8_t>(k);
}

// A double cone over a ring of so many corners.
Surface double_cone(size_t ring, Random& random) {
  Surface s;
  s.shell = {};
  const double flat = random.uniform(0, 1) < 0.3 ? 1e-3 : 1, jitter = random.uniform(0, 0.6);
  const Vector3d off = random.direction() * random.uniform(0, 1.1);
  const double size = std::exp(random.uniform(-6, 0.7));
  for (size_t i = 0; i < ring + 2; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(ring);
    Vector3d p(std::cos(angle), std::sin(angle), 0);
    if (i == ring) p = {0, 0, flat};
    if (i == ring + 1) p = {0, 0, -flat};
    p = (p + random.direction() * jitter * random.uniform(0, 1) + off) * size;
    for (size_t axis = 0; axis < 3; ++axis) {
      s.space.corner[axis][i] = static_cast<float>(p[static_cast<int>(axis)]);
    }
    s.shell.corners |= uint32_t{1} << i;
  }
  for (size_t i = 0; i < ring; ++i) {
    add(s.shell, i, (i + 1) % ring, ring);
    add(s.shell, (i + 1) % ring, i, ring + 1);
  }
  return s;
}

LongVector corner(const Surface& s, size_t triangle, size_t k) {
  return s.space.corner_at(s.shell.corner_of(triangle, k)).cast<long double>();
}

long double squared_to_segment(const LongVector& p, const LongVector& q) {
  const LongVector e = q - p;
  const long double ee = e.dot(e);
  const long double t = ee > 0 ? std::clamp<long double>(-p.dot(e) / ee, 0, 1) : 0;
  return (p + e * t).squaredNorm();
}

long double squared_distance(const Surface& s) {
  long double least = std::numeric_limits<long double>::max();
  for (size_t t = 0; t < s.shell.triangle_count; ++t) {
    const LongVector a = corner(s, t, 0), b = corner(s, t, 1), c = corner(s, t, 2);
    const LongVector n = (b - a).cross(c - a);
    least = std::min(
        {least, squared_to_segment(a, b), squared_to_segment(b, c), squared_to_segment(c, a)});
    const bool is_over = n.dot(a.cross(b)) > 0 && n.dot(b.cross(c)) > 0 && n.dot(c.cross(a)) > 0;
    if (is_over) least = std::min(least, n.dot(a) * n.dot(a) / n.squaredNorm());
  }
  return least;
}

// How often the surface winds around zero. Source: A. van Oosterom, J. Strackee, "The Solid Angle
// of a Plane Triangle", IEEE Transactions on Biomedical Engineering, 1983.
long double winding(const Surface& s) {
  long double sum = 0;
  for (size_t t = 0; t < s.shell.triangle_count; ++t) {
    const LongVector a = corner(s, t, 0), b = corner(s, t, 1), c = corner(s, t, 2);
    const long double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)),
                          la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4 * std::numbers::pi_v<long double>);
}

TEST(Shells, ProveNoMoreThanIsTrueOnEveryIsa) {
  for_each_isa([] {
    const HullSteps& lanes = hull_steps_in_lanes();
    Random random(31);
    const uint32_t count = rounds(6000);
    uint32_t around = 0, proved_around = 0, tight = 0;
    for (uint32_t round = 0; round < count; ++round) {
      Surface s = double_cone(3 + random.below(Shell::kMostCorners - 4), random);
      Surface other = s;
      const ShellCheck planes = scalar::check_planes(s.shell, s.space);
      const ShellCheck triangles = scalar::check_edges(s.shell, s.space);
      const ShellCheck planes_in_lanes = lanes.check_planes(other.shell, other.space);
      const ShellCheck triangles_in_lanes = lanes.check_edges(other.shell, other.space);
      EXPECT_EQ(planes.least_squared, planes_in_lanes.least_squared);
      EXPECT_EQ(planes.nearest, planes_in_lanes.nearest);
      EXPECT_EQ(planes.is_around, planes_in_lanes.is_around);
      EXPECT_EQ(triangles.least_squared, triangles_in_lanes.least_squared);
      EXPECT_EQ(triangles.nearest, triangles_in_lanes.nearest);
      const Vector3f point = random.direction().cast<float>();
      EXPECT_EQ(scalar::in_front(s.shell, s.space, point),
                lanes.in_front(other.shell, other.space, point));
      for (size_t t = 0; t < s.shell.triangle_count; ++t) {
        EXPECT_EQ(s.space.volume[t], other.space.volume[t]);
        EXPECT_EQ(s.space.normal_at(t), other.space.normal_at(t));
      }

      const long double exact = squared_distance(s), turns = winding(s);
      EXPECT_LE(planes.least_squared, exact);
      EXPECT_LE(triangles.least_squared, exact);
      EXPECT_GE(triangles.least_squared, planes.least_squared);
      if (planes.is_around) {
        EXPECT_NEAR(static_cast<double>(turns), 1, 1e-6);
      }
      const bool is_around = std::round(turns) == 1;
      around += is_around;
      proved_around += planes.is_around;
      tight += triangles.least_squared > 0.98f * static_cast<float>(exact);
    }
    EXPECT_GT(around, count / 4);
    EXPECT_LT(around, count / 4 * 3);
    EXPECT_GT(proved_around, around * 9 / 10);
    EXPECT_GT(tight, count / 2);
  });
}

// --- Corners ---

TEST(Shells, CornersAreDifferencesOfPointsOnEveryIsa) {
  for_each_isa([] {
    Random random(35);
    for (const size_t points : {4, 5, 15, 16, 17, 32, 33, 64, 65, 127, 128}) {
      const Hull hull = oracle::hull_of(round_points(points, {0.5f, 0.4f, 0.6f}, random));
      const SolidHull a(HullShape<float>{hull.geometry.get(), 1.5f});
      ASSERT_EQ(a.view().point_count, points);
      const scalar::Rotation<float> turn{Vector3f(0, 1, 0), Vector3f(0, 0, 1), Vector3f(1, 0, 0)};
      HullPoints b;
      hull_steps_in_lanes().place(a.view(), turn, {0.25f, 0, 0}, b);
      for (uint32_t round = 0; round < rounds(50); ++round) {
        Shell shell{};
        // Places that are not in use may hold anything.
        for (uint8_t& number : shell.of_a) number = static_cast<uint8_t>(random.below(256));
        for (uint8_t& number : shell.of_b) number = static_cast<uint8_t>(random.below(256));
        const size_t places = random.below(Shell::kMostCorners) + 1;
        for (size_t i = 0; i < places; ++i) {
          if (random.below(4) == 0) continue;
          shell.corners |= uint32_t{1} << i;
          shell.of_a[i] = static_cast<uint8_t>(random.below(points));
          shell.of_b[i] = static_cast<uint8_t>(random.below(points));
        }
        ShellSpace expected, found;
        scalar::place_corners(shell, a.view(), b.view(), expected);
        hull_steps_in_lanes().place_corners(shell, a.view(), b.view(), found);
        for (size_t i = 0; i < places; ++i) {
          if (!(shell.corners >> i & 1)) continue;
          EXPECT_EQ(expected.corner_at(i), found.corner_at(i));
          EXPECT_EQ(expected.corner_at(i), a.view().corner(shell.of_a[i]) - b[shell.of_b[i]]);
        }
      }
    }
  });
}

// --- Hulls that move ---

HullPair moving_pair(Random& random, size_t points) {
  const auto hull = [&] {
    const auto side = [&] { return static_cast<float>(random.uniform(0.3, 1)); };
    return oracle::hull_of(round_points(points, {side(), side(), side()}, random));
  };
  HullPair pair{hull(), hull(), {}};
  pair.pose.d = (random.direction() * random.uniform(0, 1.2)).cast<float>();
  pair.pose.a = random_turn(random);
  pair.pose.b = random_turn(random);
  return pair;
}

void move(HullPair& pair, double way, Random& random) {
  pair.pose.d += (random.direction() * way).cast<float>();
  pair.pose.a.v += (random.direction() * way).cast<float>();
  pair.pose.b.v += (random.direction() * way).cast<float>();
}

Separation shell_depth(const HullPair& pair, float slack, const HullSteps& steps, Shell& shell) {
  const SolidHull a(HullShape<float>{pair.a.geometry.get(), 1});
  const SolidHull b(HullShape<float>{pair.b.geometry.get(), 1});
  const DeepPair deep{&a.view(), &b.view(), pair.pose.d, pair.pose.a, pair.pose.b, slack, &shell};
  Separation found;
  shell_depths({&deep, 1}, steps, &found);
  return found;
}

// The overlap along the normal, in double precision.
double overlap_along(const HullPair& pair, const Vector3f& normal) {
  const auto greatest = [](const Hull& hull, const scalar::Quaternion<float>& q,
                           const Vector3d& way) {
    const Eigen::Quaterniond turn(q.w, q.v.x(), q.v.y(), q.v.z());
    double most = -std::numeric_limits<double>::max();
    for (const Vector3f& p : hull.geometry->points()) {
      most = std::max(most, way.dot(turn.normalized() * p.cast<double>()));
    }
    return most;
  };
  const Vector3d n = normal.cast<double>().normalized();
  return greatest(pair.a, pair.pose.a, n) + greatest(pair.b, pair.pose.b, -n) -
         n.dot(pair.pose.d.cast<double>());
}

TEST(Shells, DepthsAreWithinTheSlackWhileHullsMove) {
  Random random(32);
  const uint32_t count = rounds(150, 8);
  uint32_t overlaps = 0, found_depths = 0, by_old_shells = 0;
  for (uint32_t round = 0; round < count; ++round) {
    HullPair pair = moving_pair(random, 5 + random.below(60));
    const auto slack = static_cast<float>(std::exp(random.uniform(std::log(1e-3), std::log(0.1))));
    Shell shell{}, shell_of_lanes{};
    for (int step = 0; step < 20; ++step) {
      move(pair, slack * random.uniform(0, 4), random);
      const Separation found = shell_depth(pair, slack, scalar::kHullSteps, shell);
      const Separation in_lanes = shell_depth(pair, slack, hull_steps_in_lanes(), shell_of_lanes);
      ASSERT_EQ(found.is_unsure, in_lanes.is_unsure);
      const auto exact = exact_separation(pair);
      overlaps += exact.separation < -1e-3;
      by_old_shells += !found.is_unsure && !shell.is_new;
      shell.is_new = shell_of_lanes.is_new = false;
      if (found.is_unsure) {
        EXPECT_EQ(shell.triangle_count, 0);
        continue;
      }
      ++found_depths;
      ASSERT_EQ(found.separation, in_lanes.separation);
      ASSERT_EQ(found.normal, in_lanes.normal);
      ASSERT_EQ(found.arm_a, in_lanes.arm_a);
      ASSERT_EQ(found.arm_b, in_lanes.arm_b);
      ASSERT_LT(exact.separation, 0);
      EXPECT_NEAR(found.separation, exact.separation, slack + 4e-6);
      EXPECT_NEAR(found.normal.norm(), 1, 1e-6);
      EXPECT_LE(overlap_along(pair, found.normal), -exact.separation + slack + 4e-6);
      EXPECT_NEAR(
          (found.arm_b + pair.pose.d - found.arm_a - found.normal * found.separation).norm(), 0,
          2e-6);
    }
  }
  EXPECT_GT(overlaps, count * 20 / 3);
  EXPECT_GT(found_depths, overlaps * 8 / 10);
  EXPECT_GT(by_old_shells, found_depths * 6 / 10);
}

// Every corner of a triangle is in use, and the surface has each edge as often in one direction as
// in the other.
void expect_closed(const Shell& shell) {
  std::map<std::pair<size_t, size_t>, int> edges;
  for (size_t t = 0; t < shell.triangle_count; ++t) {
    for (size_t k = 0; k < 3; ++k) {
      const size_t from = shell.corner_of(t, k), to = shell.corner_of(t, (k + 1) % 3);
      ASSERT_TRUE(shell.corners >> from & 1);
      ++edges[{from, to}];
      --edges[{to, from}];
    }
  }
  for (const auto& [edge, count] : edges) ASSERT_EQ(count, 0);
}

// The surface may meet itself in one corner. A corner that no longer counted as in use had the
// place of whatever pair was tested before.
TEST(Shells, StayClosedHoweverHullsMove) {
  Random random(36);
  const HullSteps& steps = hull_steps_in_lanes();
  const HullPair other = [&] {
    HullPair pair = moving_pair(random, 40);
    pair.pose.d.setZero();
    return pair;
  }();
  size_t found_depths = 0;
  for (uint32_t round = 0; round < rounds(2500, 20); ++round) {
    HullPair pair = moving_pair(random, 8 + random.below(40));
    const auto slack = static_cast<float>(std::exp(random.uniform(std::log(3e-4), std::log(0.05))));
    Shell shell{}, alone{}, of_other{};
    for (int step = 0; step < 40; ++step) {
      move(pair, slack * random.uniform(0, 6), random);
      shell.is_new = alone.is_new = false;
      const Separation expected = shell_depth(pair, slack, steps, alone);
      of_other = {};
      shell_depth(other, 0.01f, steps, of_other);
      const Separation found = shell_depth(pair, slack, steps, shell);
      ASSERT_EQ(found.is_unsure, expected.is_unsure);
      if (found.is_unsure) continue;
      ++found_depths;
      ASSERT_EQ(found.separation, expected.separation);
      ASSERT_NO_FATAL_FAILURE(expect_closed(shell));
    }
  }
  EXPECT_GT(found_depths, rounds(2500, 20) * 10);
}

TEST(Shells, ContactsAreInBothHulls) {
  Random random(33);
  const uint32_t count = rounds(400, 20);
  uint32_t found_depths = 0;
  for (uint32_t round = 0; round < count; ++round) {
    const HullPair pair = moving_pair(random, 6 + random.below(40));
    Shell shell{};
    const Separation found = shell_depth(pair, 0.01f, hull_steps_in_lanes(), shell);
    if (found.is_unsure) continue;
    ++found_depths;
    EXPECT_TRUE(holds(pair.a, pair.pose.a, found.arm_a));
    EXPECT_TRUE(holds(pair.b, pair.pose.b, found.arm_b));
  }
  EXPECT_GT(found_depths, count / 4);
}

TEST(Shells, ProveNothingOfHullsThatAreApart) {
  Random random(34);
  for (uint32_t round = 0; round < rounds(300, 20); ++round) {
    HullPair pair = moving_pair(random, 6 + random.below(40));
    Shell shell{};
    shell_depth(pair, 0.01f, hull_steps_in_lanes(), shell);
    // From overlap to any distance, touching included.
    const auto exact = exact_separation(pair);
    const double gap = random.below(3) == 0 ? 1e-6 : std::exp(random.uniform(-12, 0));
    pair.pose.d += (exact.normal * (gap - exact.separation)).cast<float>();
    if (exact_separation(pair).separation < 0) continue;
    EXPECT_TRUE(shell_depth(pair, 0.01f, hull_steps_in_lanes(), shell).is_unsure);
    EXPECT_EQ(shell.triangle_count, 0);
    EXPECT_TRUE(shell.was_in_vain());
  }
}

TEST(Shells, OfOtherHullsOrOfNoNumbersAreMadeAnew) {
  const scalar::Quaternion<float> unturned{Vector3f::Zero(), 1};
  const Hull box = oracle::hull_of(box_corners({0.4f, 0.5f, 0.6f}));
  const Hull tip = oracle::hull_of(pyramid(1));
  const HullPair pair{box, box, {{0.3f, 0.2f, 0.1f}, unturned, {{0.1f, 0.2f, 0}, 1}}};
  Shell shell{};
  ASSERT_FALSE(shell_depth(pair, 0.05f, hull_steps_in_lanes(), shell).is_unsure);
  EXPECT_EQ(shell.points_of_a, 8);
  // Fewer points than the shell has numbers of.
  const HullPair fewer{tip, tip, {{0.3f, 0.2f, 0.1f}, unturned, {{0.1f, 0.2f, 0}, 1}}};
  shell.is_new = false;
  const Separation found = shell_depth(fewer, 0.05f, hull_steps_in_lanes(), shell);
  ASSERT_FALSE(found.is_unsure);
  EXPECT_TRUE(shell.is_new);
  EXPECT_EQ(shell.points_of_a, 5);
  EXPECT_NEAR(found.separation, exact_separation(fewer).separation, 0.05 + 4e-6);

  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e30f}) {
    HullPair spoilt = fewer;
    spoilt.pose.d.x() = bad;
    EXPECT_TRUE(shell_depth(spoilt, 0.01f, hull_steps_in_lanes(), shell).is_unsure);
  }
}

// Faces and edges of boxes that are not turned are parallel, and many points are in one plane.
TEST(Shells, ProveMostDepthsOfParallelBoxes) {
  Random random(40);
  const scalar::Quaternion<float> unturned{Vector3f::Zero(), 1};
  const Hull box = oracle::hull_of(box_corners({0.4f, 0.5f, 0.6f}));
  const uint32_t count = rounds(400, 40);
  uint32_t overlaps = 0, sure = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const Vector3f d = (random.direction() * random.uniform(0, 0.9)).cast<float>();
    const HullPair pair{box, box, {d, unturned, unturned}};
    const auto exact = exact_separation(pair);
    if (exact.separation > -1e-3) continue;
    ++overlaps;
    Shell shell{};
    const Separation found = shell_depth(pair, 0.02f, hull_steps_in_lanes(), shell);
    if (found.is_unsure) continue;
    ++sure;
    EXPECT_NEAR(found.separation, exact.separation, 0.02 + 4e-6);
  }
  EXPECT_GT(overlaps, count / 2);
  EXPECT_GT(sure, overlaps * 9 / 10);
}

// A depth that may be rounding is left to the search. The shell goes, so that no step tries it
// twice.
TEST(Shells, OfHullsThatHardlyOverlapAreInVain) {
  const scalar::Quaternion<float> unturned{Vector3f::Zero(), 1};
  const Hull box = oracle::hull_of(box_corners({0.5f, 0.5f, 0.5f}));
  for (const auto& [depth, is_found] : {std::pair{1.2e-5f, false}, std::pair{3e-5f, true}}) {
    const HullPair pair{box, box, {{1 - depth, 0.1f, 0.2f}, unturned, unturned}};
    Shell shell{};
    EXPECT_EQ(!shell_depth(pair, 0.05f, hull_steps_in_lanes(), shell).is_unsure, is_found);
    EXPECT_EQ(shell.was_in_vain(), !is_found);
  }
}

// Hulls at one place, and hulls without height, have many axes of least overlap.
TEST(Shells, OfSpecialHulls) {
  const Hull cube = oracle::hull_of(cube_corners());
  const scalar::Quaternion<float> unturned{Vector3f::Zero(), 1};
  for (const Vector3f& d : {Vector3f(0, 0, 0), Vector3f(0, 0, 1.5f), Vector3f(1, 1, 1),
                            Vector3f(1.99f, 0, 0), Vector3f(1e-4f, 0, 0)}) {
    const HullPair pair{cube, cube, {d, unturned, unturned}};
    Shell shell{};
    const Separation found = shell_depth(pair, 0.05f, hull_steps_in_lanes(), shell);
    if (found.is_unsure) continue;
    EXPECT_NEAR(found.separation, exact_separation(pair).separation, 0.05 + 4e-6) << d.transpose();
  }
}

}  // namespace
}  // namespace carom::test

// The quality of the random pairs of every two kinds: all kinds with a kernel occur, hits and
// misses are balanced, and contacts occur at every feature of every shape.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/support/kind_checks.h"
#include "tests/support/kind_pairs.h"

namespace carom::test {
namespace {

using Features = std::map<uint32_t, int>;

TEST(KindsCoverage, EveryPairOfKindsWithAKernelIsTested) {
  size_t count = 0;
  for (int a = 0; a < kShapeKindCount; ++a) {
    for (int b = 0; b < kShapeKindCount; ++b) {
      const auto kind_a = static_cast<ShapeKind>(a), kind_b = static_cast<ShapeKind>(b);
      EXPECT_EQ(supports(kind_a, kind_b), supports(kind_b, kind_a));
      if (is_composite(kind_a) || is_composite(kind_b)) continue;  // tested through their parts
      count += supports(kind_a, kind_b);
    }
  }
  EXPECT_EQ(supported_kind_pairs().size(), count);
}

TEST(KindsCoverage, KindsThatArePromisedAreSupported) {
  for (const KindPair& kinds : convex_kind_pairs()) {
    EXPECT_TRUE(supports(kinds.a, kinds.b)) << name(kinds);
  }
}

TEST(KindsCoverage, HitsAndMissesAreBalanced) {
  for (const ConvexFamily& family : convex_families()) {
    const bool touch = family.placement == ConvexPlacement::near_touch;
    const bool is_free = family.placement == ConvexPlacement::free || touch;
    if (!is_free || family.degenerate) continue;
    if (std::string(family.name) == "at 1e9") continue;  // float32 steps are 64 m there
    for (const KindPair& kinds : supported_kind_pairs()) {
      if (is_slow(kinds) && kinds.a > kinds.b) continue;  // one order is enough
      int hits = 0;
      const int count = is_slow(kinds) ? 100 : 400;
      for (const TestPair& pair : make_kind_pairs(family, kinds, PositionType::float32, count)) {
        hits += reference_result(pair, PositionType::float32).overlap;
      }
      SCOPED_TRACE(std::string(family.name) + ", " + name(kinds));
      EXPECT_GT(hits, count * (touch ? 0.2 : 0.3));
      EXPECT_LT(hits, count * (touch ? 0.8 : 0.7));
    }
  }
}

// Which of a shape's corners are furthest along n, as bits: one means a corner, two an edge, more a
// face.
uint32_t feature(const ConvexShape<long double>& shape, const Vec3<long double>& n) {
  long double most = dot(shape.points[0], n);
  for (const auto& p : shape.points) most = std::max(most, dot(p, n));
  uint32_t corners = 0;
  for (size_t i = 0; i < shape.points.size(); ++i) {
    const bool is_farthest = most - dot(shape.points[i], n) < 1e-5L * shape.bounding_radius;
    corners |= is_farthest ? 1u << i : 0;
  }
  return corners;
}

// The number of corners, edges and faces.
size_t feature_count(const ConvexShape<long double>& shape) {
  switch (shape.points.size()) {
    case 1:
      return 1;
    case 2:
      return 2 + 1;
    case 3:
      return 3 + 3 + 1;
    case 6:
      return 6 + 9 + 5;
    default:
      return 8 + 12 + 6;
  }
}

// The features of A with contacts, by A's number of corners (triangles have three or, if thick,
// six).
std::map<size_t, Features> features_of_a(const KindPair& kinds) {
  std::map<size_t, Features> found;
  for (const TestPair& pair : make_kind_pairs({.name = ""}, kinds, PositionType::float64, 2500)) {
    const ExactKinds exact(pair, PositionType::float64);
    const auto result = reference_result(pair, PositionType::float64);
    if (exact.oracle.a.is_halfspace) continue;
    const auto normal = vec3_as<long double>(result.normal);
    ++found[exact.oracle.a.points.size()][feature(exact.oracle.a, normal)];
  }
  return found;
}

TEST(KindsCoverage, ContactsOccurAtEveryFeature) {
  for (const KindPair& kinds : solved_kind_pairs()) {
    if (has_halfspace(kinds)) continue;  // half-spaces only meet corners
    if (is_slow(kinds)) continue;        // too many features, and slow
    SCOPED_TRACE(name(kinds));
    for (const auto& [corners, features] : features_of_a(kinds)) {
      ConvexShape<long double> shape{Vec3<long double>{}};
      shape.points.resize(corners);
      const bool is_prism = corners == 6;  // prisms are rarer, and have small sides
      EXPECT_GE(features.size(), feature_count(shape) - (is_prism ? 6 : 0)) << corners;
    }
  }
}

// Which of the 15 axes of two overlapping boxes the normal is: 0 to 2 faces of A, 3 to 5 faces of
// B, then the cross products of edges.
int axis_of(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, const Eigen::Vector3d& normal) {
  int best = -1;
  double largest = 0;
  const auto try_axis = [&](int index, const Eigen::Vector3d& axis) {
    const double share = std::fabs(axis.normalized().dot(normal));
    if (share > largest) largest = share, best = index;
  };
  for (int i = 0; i < 3; ++i) {
    try_axis(i, a.col(i));
    try_axis(3 + i, b.col(i));
    for (int j = 0; j < 3; ++j) try_axis(6 + 3 * i + j, a.col(i).cross(b.col(j)));
  }
  EXPECT_GT(largest, 1 - 1e-6);
  return best;
}

TEST(KindsCoverage, AllAxesOfTwoBoxes) {
  std::map<int, int> axes;
  for (const TestPair& pair : make_kind_pairs({.name = ""}, {ShapeKind::box, ShapeKind::box},
                                              PositionType::float64, 4000)) {
    const auto result = reference_result(pair, PositionType::float64);
    if (!result.overlap) continue;
    const auto turned = [](const PlacedShape& body) {
      return body.orientation.cast<double>().normalized().toRotationMatrix();
    };
    ++axes[axis_of(turned(pair.a), turned(pair.b), result.normal.cast<double>())];
  }
  EXPECT_EQ(axes.size(), 15u);
  for (const auto& [axis, count] : axes) EXPECT_GE(count, 10) << axis;
}

// Manifolds of every number of points occur, and are spread as wide as the faces.
TEST(KindsCoverage, ManifoldsOfEveryCount) {
  std::map<int, int> counts;
  for (const TestPair& pair : make_kind_pairs({.name = ""}, {ShapeKind::box, ShapeKind::box},
                                              PositionType::float64, 4000)) {
    ++counts[reference_result(pair, PositionType::float64).manifold_count];
  }
  for (int count = 0; count <= 4; ++count) EXPECT_GE(counts[count], 5) << count;
}

TEST(KindsCoverage, ExactlyTouchingAndDegenerate) {
  for (const KindPair& kinds : supported_kind_pairs()) {
    SCOPED_TRACE(name(kinds));
    int touching = 0;
    for (const ConvexFamily& family : convex_families()) {
      if (std::string(family.name) != "lattice") continue;
      const bool has_dop = kinds.a == ShapeKind::dop || kinds.b == ShapeKind::dop;
      const size_t count = has_dop ? 1000 : 4000;
      for (const TestPair& pair : make_kind_pairs(family, kinds, PositionType::float32, count)) {
        touching += reference_result(pair, PositionType::float32).separation == 0;
      }
    }
    EXPECT_GE(touching, 15);
  }
}

}  // namespace
}  // namespace carom::test

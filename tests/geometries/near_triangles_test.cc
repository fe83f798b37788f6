// Pairs of triangles are left out only if they are apart, and all ISAs leave out the same.
#include "geometries/near_triangles.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "oracle/convex_oracle.h"
#include "oracle/random.h"
#include "tests/support/isas.h"

namespace carom::test {
namespace {

using oracle::Random;

struct LooseTriangles {
  std::vector<float> vertices;
  std::vector<std::array<uint32_t, 3>> corners;

  LooseTriangles(size_t count, double spread, double size, Random& random) {
    for (uint32_t i = 0; i < count; ++i) {
      const Eigen::Vector3d at = spread * random.uniform(0, 1) * random.direction();
      for (uint32_t k = 0; k < 3; ++k) {
        const Eigen::Vector3d p = at + size * random.uniform(0, 1) * random.direction();
        for (int axis = 0; axis < 3; ++axis) vertices.push_back(static_cast<float>(p[axis]));
      }
      corners.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    // Some are lines and points.
    for (size_t i = 0; i < count; i += 7) corners[i][2] = corners[i][1];
    for (size_t i = 0; i < count; i += 14) corners[i][0] = corners[i][1];
    vertices.push_back(0);
  }

  TriangleArrays arrays() const { return {vertices.data(), corners.data(), corners.size()}; }
  Double3 corner(size_t triangle, size_t k) const {
    const float* v = vertices.data() + size_t{3} * corners[triangle][k];
    return {v[0], v[1], v[2]};
  }
};

using Corners = std::array<Double3, 3>;

// How far two triangles are apart along the normal of the first; 0 without one.
double gap_along_normal(const Corners& a, const Corners& b) {
  const Double3 u = minus(a[1], a[0]), v = minus(a[2], a[0]);
  const Double3 n = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                     u[0] * v[1] - u[1] * v[0]};
  const double length = std::sqrt(dot(n, n));
  if (length == 0) return 0;
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const Double3& corner : b) {
    const double height = dot(n, minus(corner, a[0])) / length;
    low = std::min(low, height);
    high = std::max(high, height);
  }
  return std::max(low, -high);
}

// To rounding in float32.
double separation_of(const Corners& a, const Corners& b) {
  const auto shape = [](const Corners& corners) {
    Triangle triangle;
    for (size_t k = 0; k < 3; ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        triangle.corners[k][axis] = static_cast<float>(corners[k][static_cast<size_t>(axis)]);
      }
    }
    return oracle::ConvexShape<long double>(Shape{triangle});
  };
  return static_cast<double>(exact_separation(shape(a), shape(b)));
}

TEST(NearTriangles, OnlyThoseThatAreApartAreLeftOut) {
  constexpr double kTurn[3][3] = {{0.36, 0.48, -0.8}, {-0.8, 0.6, 0}, {0.48, 0.64, 0.6}};
  FrameChange change;
  for (size_t i = 0; i < 3; ++i) change.turn[i] = {kTurn[i][0], kTurn[i][1], kTurn[i][2]};
  Random random(1);
  size_t left_out = 0, kept_near = 0, all = 0, crossing = 0;
  for (const double unit : {1e-38, 1e-20, 1.0, 1e20, 1e37}) {
    SCOPED_TRACE(unit);
    for (const size_t count : {0, 1, 3, 4, 5, 7, 8, 9, 15, 16, 17, 900}) {
      const LooseTriangles a(40, unit, unit, random), b(40, unit, unit, random);
      const Eigen::Vector3d offset = unit * random.direction();
      change.offset = {offset.x(), offset.y(), offset.z()};
      const double reach = std::array{0.0, 0.2, -0.1}[random.below(3)] * unit;
      const PairScale scale(2 * unit, 2 * unit, change.offset, reach);
      std::vector<ItemPair> pairs;
      for (size_t i = 0; i < count; ++i) {
        pairs.push_back(
            {static_cast<uint32_t>(random.below(40)), static_cast<uint32_t>(random.below(40))});
      }
      std::vector<ItemPair> expected;
      std::map<ItemPair, double> separation;
      for (const ItemPair& pair : pairs) {
        Corners x, y;
        for (size_t k = 0; k < 3; ++k) {
          x[k] = a.corner(pair.a, k);
          const Double3 p = b.corner(pair.b, k);
          for (size_t axis = 0; axis < 3; ++axis) {
            y[k][axis] = dot(change.turn[axis], p) + change.offset[axis];
          }
          // In units, so that products neither vanish nor overflow.
          for (size_t axis = 0; axis < 3; ++axis) {
            x[k][axis] /= unit;
            y[k][axis] /= unit;
          }
        }
        const double gap = std::max(gap_along_normal(x, y), gap_along_normal(y, x)) * unit;
        if (unit == 1) separation[pair] = separation_of(x, y);
        if (gap <= reach + 0x1p-19 * unit) expected.push_back(pair);
        all += gap > reach + 0x1p-14 * unit;
      }
      std::vector<ItemPair> first;
      std::vector<float> first_gaps;
      for_each_isa([&] {
        std::vector<ItemPair> kept = pairs;
        std::vector<float> gaps(pairs.size());
        const auto within = static_cast<float>(scale.grow);
        kept.resize(keep_near(a.arrays(), b.arrays(), change, scale, within, kept, gaps.data()));
        gaps.resize(kept.size());
        // In their order, and all that are near.
        auto at = kept.begin();
        for (const ItemPair& pair : expected) {
          at = std::find(at, kept.end(), pair);
          ASSERT_NE(at, kept.end());
          ++at;
        }
        for (size_t i = 0; unit == 1 && i < kept.size(); ++i) {
          EXPECT_LE(gaps[i], separation[kept[i]] * scale.down + scale.slack);
          crossing += gaps[i] < 0;
        }
        if (first.empty()) {
          first = kept;
          first_gaps = gaps;
          left_out += pairs.size() - kept.size();
          kept_near += kept.size();
        }
        EXPECT_EQ(kept, first);
        EXPECT_EQ(gaps, first_gaps);
      });
    }
  }
  EXPECT_GT(kept_near, 300u);
  EXPECT_GT(crossing, 50u);
  EXPECT_GT(left_out, 300u);
  EXPECT_GT(static_cast<double>(left_out), 0.99 * static_cast<double>(all));
}

TEST(NearTriangles, NothingIsLeftOutOfAnInfiniteReach) {
  Random random(2);
  const LooseTriangles a(20, 1, 1, random), b(20, 1, 1, random);
  const FrameChange change = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0x1p1000, 0, 0}};
  const PairScale scale(2, 2, change.offset, HUGE_VAL);
  std::vector<ItemPair> pairs;
  for (uint32_t i = 0; i < 20; ++i) pairs.push_back({i, 19 - i});
  std::vector<float> gaps(pairs.size());
  for_each_isa([&] {
    EXPECT_EQ(keep_near(a.arrays(), b.arrays(), change, scale, static_cast<float>(scale.grow),
                        pairs, gaps.data()),
              pairs.size());
  });
}

}  // namespace
}  // namespace carom::test

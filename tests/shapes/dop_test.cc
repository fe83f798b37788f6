// k-DOPs: their directions, and the smallest ones around points.
#include "carom/shapes/dop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "carom/bounds/dop_bounds.h"
#include "oracle/random.h"
#include "tests/support/hulls.h"

namespace carom::test {

using namespace oracle;
namespace {

constexpr DopKind kDopKinds[] = {DopKind::k6, DopKind::k14, DopKind::k18, DopKind::k26};

Eigen::Vector3i as_vector(const std::array<int8_t, 3>& d) { return {d[0], d[1], d[2]}; }

Points random_points(size_t count, uint64_t seed) {
  Random random(seed);
  Points points;
  for (size_t i = 0; i < count; ++i) {
    points.push_back((random.direction() * random.log_uniform(1e-3, 1e3)).cast<float>());
  }
  return points;
}

void expect_same(const Dop& a, const Dop& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.lower, b.lower);
  EXPECT_EQ(a.upper, b.upper);
}

TEST(Dop, DirectionsAreAsManyAsTheNameSays) {
  EXPECT_EQ(slab_directions(DopKind::k6).size(), 3u);
  EXPECT_EQ(slab_directions(DopKind::k14).size(), 7u);
  EXPECT_EQ(slab_directions(DopKind::k18).size(), 9u);
  EXPECT_EQ(slab_directions(DopKind::k26).size(), kMostSlabs);
}

TEST(Dop, DirectionsAreThoseOfACubeAndNoTwoAreParallel) {
  for (const DopKind kind : kDopKinds) {
    const auto directions = slab_directions(kind);
    EXPECT_EQ(directions.size(), slab_count(kind));
    size_t with_zeros[3] = {};
    for (size_t i = 0; i < directions.size(); ++i) {
      const Eigen::Vector3i d = as_vector(directions[i]);
      if (i < 3) {
        EXPECT_EQ(d, Eigen::Vector3i::Unit(static_cast<int>(i)));
      }
      EXPECT_LE(d.cwiseAbs().maxCoeff(), 1);
      ++with_zeros[(d.array() == 0).count()];
      for (size_t k = 0; k < i; ++k) EXPECT_FALSE(d.cross(as_vector(directions[k])).isZero());
    }
    EXPECT_EQ(with_zeros[2], 3u);
    EXPECT_EQ(with_zeros[1], kind == DopKind::k18 || kind == DopKind::k26 ? 6u : 0u);
    EXPECT_EQ(with_zeros[0], kind == DopKind::k14 || kind == DopKind::k26 ? 4u : 0u);
  }
}

TEST(Dop, RecordsHoldTheSlabsBeyondTheBounds) {
  EXPECT_EQ(dop_record_size(DopKind::k6), 0u);
  EXPECT_EQ(dop_record_size(DopKind::k14), 8u);
  EXPECT_EQ(dop_record_size(DopKind::k18), 16u);
  EXPECT_EQ(dop_record_size(DopKind::k26), 24u);
  EXPECT_EQ(place_in_record(3), 3u);
  EXPECT_EQ(place_in_record(9), 17u);
}

TEST(Dop, OfPointsIsTheNearestFloatAroundThem) {
  for (uint64_t seed = 0; seed < 200; ++seed) {
    const Points points = random_points(1 + seed % 20, seed);
    for (const DopKind kind : kDopKinds) {
      const Dop dop = Dop::of_points(points, kind);
      EXPECT_EQ(dop.kind, kind);
      for (size_t i = 0; i < slab_count(kind); ++i) {
        const auto d = as_vector(slab_directions(kind)[i]).cast<double>().eval();
        double lower = HUGE_VAL, upper = -HUGE_VAL;
        for (const Eigen::Vector3f& point : points) {
          lower = std::min(lower, d.dot(point.cast<double>()));
          upper = std::max(upper, d.dot(point.cast<double>()));
        }
        ASSERT_EQ(dop.lower[i], static_cast<float>(lower));
        ASSERT_EQ(dop.upper[i], static_cast<float>(upper));
      }
    }
  }
}

TEST(Dop, OrderAndRepetitionOfPointsDoNotMatter) {
  const Points points = random_points(30, 1);
  Points backwards = points, twice = points;
  std::reverse(backwards.begin(), backwards.end());
  twice.insert(twice.end(), points.begin(), points.end());
  for (const DopKind kind : kDopKinds) {
    const Dop dop = Dop::of_points(points, kind);
    expect_same(Dop::of_points(backwards, kind), dop);
    expect_same(Dop::of_points(twice, kind), dop);
  }
}

TEST(Dop, OfOnePointIsThatPoint) {
  const Points points = {{1, 2, 4}};
  const Dop dop = Dop::of_points(points, DopKind::k26);
  EXPECT_EQ(dop.lower, dop.upper);
  EXPECT_EQ(dop.lower, (std::array<float, kMostSlabs>{1, 2, 4, 7, 3, -1, -5, 3, 5, 6, -1, -3, -2}));
}

TEST(Dop, OfNoPointsIsZero) {
  for (const DopKind kind : kDopKinds) expect_same(Dop::of_points({}, kind), Dop{.kind = kind});
}

}  // namespace
}  // namespace carom::test

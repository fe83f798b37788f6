// Cylinders, cones, ellipsoids, rounded boxes and rounded hulls with every kind, beside an oracle
// that knows support points alone, within the bounds that the library states.
#include <gtest/gtest.h>

#include <optional>
#include <utility>

#include "oracle/support_pair.h"
#include "shapes/rounding.h"
#include "tests/support/kind_pairs.h"
#include "tests/support/rounds.h"
#include "tests/support/show.h"

namespace carom::test {
namespace {

using Number = long double;
using Vec = Vec3<Number>;
using Result = reference::PairResult;

// Separations, of the mean bounding radius.
constexpr Number kStated = 2e-6L;
// Points and the gap along the normal.
constexpr Number kStatedOfPoints = 1e-5L;

// Enough for nine pairs in ten; the bounds of others are wider.
constexpr size_t kMostTriangles = 30'000;

class RoundCheck {
 public:
  RoundCheck(const TestPair& pair, PositionType positions)
      : shapes_(pair.a.shape, stored_pose(pair.a, positions), pair.b.shape,
                stored_pose(pair.b, positions)),
        origin_b_(vec3_as<Number>(stored(pair.b.position, positions)) -
                  vec3_as<Number>(stored(pair.a.position, positions))),
        result_(reference_result(pair, positions)),
        scale_(shapes_.has_halfspace() ? 2 * shapes_.scale() - shapes_.plane_distance()
                                       : shapes_.scale()),
        exact_(shapes_.separation(kStated * scale_, kMostTriangles)) {
    const auto core_of = [positions](const PlacedShape& body) {
      return std::pair(without_rounding(body.shape), stored_pose(body, positions));
    };
    const auto [core_a, pose_a] = core_of(pair.a);
    const auto [core_b, pose_b] = core_of(pair.b);
    cores_.emplace(core_a, pose_a, core_b, pose_b);
    rounding_a_ = rounding_of(pair.a.shape);
    rounding_b_ = rounding_of(pair.b.shape);
    gap_ = std::max(std::fabs(exact_.low), std::fabs(exact_.high));
    const Number reach = shapes_.has_halfspace() ? length(origin_b_) + shapes_.plane_distance() : 0;
    arms_ = (reach + gap_) * 0x1p-22L;
  }

  bool has_tight_bounds() const { return exact_.high - exact_.low <= kStated * scale_ * 1.01L; }

  void all() const {
    EXPECT_NE(result_.status, Status::invalid);
    decision_and_separation();
    normal();
    witnesses();
    manifold();
  }

 private:
  static Pose stored_pose(const PlacedShape& body, PositionType positions) {
    Pose pose = body.pose();
    pose.position = stored(pose.position, positions);
    return pose;
  }

  Number tolerance(Number of_size) const {
    return of_size * (scale_ + gap_) + arms_ * 0x1p-2L + 32 * Number(0x1p-149);
  }

  void decision_and_separation() const {
    EXPECT_EQ(result_.overlap, result_.separation <= 0);
    EXPECT_GE(result_.separation, exact_.low - tolerance(kStated));
    EXPECT_LE(result_.separation, exact_.high + tolerance(kStated));
  }

  void normal() const {
    const Vec n = vec3_as<Number>(result_.normal);
    EXPECT_NEAR(static_cast<double>(length(n)), 1, 4 * 0x1p-23);
    EXPECT_GE(shapes_.gap_along(normalized(n)), exact_.low - tolerance(kStatedOfPoints));
  }

  void is_on_surface(const SupportPair& shapes, const Vec& on_a, const Vec& on_b) const {
    EXPECT_LE(shapes.distance_from_a(on_a), tolerance(kStatedOfPoints) + arms_);
    EXPECT_LE(shapes.distance_from_b(on_b), tolerance(kStatedOfPoints) + arms_);
  }

  void witnesses() const {
    const Vec a = vec3_as<Number>(result_.arm_a), b = vec3_as<Number>(result_.arm_b) + origin_b_;
    const Vec way = b - a - vec3_as<Number>(result_.normal) * Number(result_.separation);
    EXPECT_LE(length(way), tolerance(kStatedOfPoints) + arms_) << "from witness to witness";
    SCOPED_TRACE("witness points");
    is_on_surface(shapes_, a, b);
  }

  // The points of the cores, moved along the normal.
  void manifold() const {
    EXPECT_EQ(result_.manifold_count > 0, result_.overlap);
    EXPECT_LE(result_.manifold_count, 4u);
    for (size_t i = 0; i < result_.manifold_count; ++i) {
      SCOPED_TRACE("manifold point " + std::to_string(i));
      const Number separation = result_.manifold.separation[i];
      const Vec point = vec3_as<Number>(result_.manifold.point[i]);
      EXPECT_GE(separation, exact_.low - tolerance(kStated));
      const Vec n = vec3_as<Number>(result_.normal);
      is_on_surface(*cores_, point - n * rounding_a_, point + n * (separation + rounding_b_));
    }
  }

  SupportPair shapes_;
  std::optional<SupportPair> cores_;  // without roundings
  Number rounding_a_, rounding_b_;
  Vec origin_b_;
  Result result_;
  Number scale_;
  SeparationBounds exact_;
  Number gap_, arms_;
};

class RoundAccuracy : public testing::TestWithParam<ConvexFamily> {};

TEST_P(RoundAccuracy, IsWithinBounds) {
  uint64_t seed = 1;
  size_t count = 0, tight = 0;
  for (const KindPair& kinds : round_kind_pairs()) {
    if (kinds.a > kinds.b) continue;  // the other order is mirrored: kinds_properties_test.cc
    const PositionType positions = ++seed % 2 ? PositionType::float32 : PositionType::float64;
    SCOPED_TRACE(name(kinds));
    std::vector<TestPair> pairs =
        make_kind_pairs(GetParam(), kinds, positions, rounds(16, 1), seed);
    round_some(pairs, seed);
    for (const TestPair& pair : pairs) {
      const ShownIfFailed shown([&] { return show(pair) + "\n" + name(positions); });
      const RoundCheck check(pair, positions);
      check.all();
      if (HasFailure()) return;
      ++count;
      tight += check.has_tight_bounds();
    }
  }
  EXPECT_GE(tight, count * 3 / 4);
}

INSTANTIATE_TEST_SUITE_P(Families, RoundAccuracy, testing::ValuesIn(convex_families()),
                         family_name);

}  // namespace
}  // namespace carom::test

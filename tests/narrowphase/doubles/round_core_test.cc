// Cores of discs and ellipsoids, in double precision, beside an oracle that knows their support
// points alone.
#include <gtest/gtest.h>

#include "narrowphase/doubles/core_separation.h"
#include "narrowphase/scalar/quaternion_as.h"
#include "oracle/convex_random.h"
#include "oracle/support_pair.h"
#include "tests/support/rounds.h"
#include "tests/support/show.h"

namespace carom::test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using oracle::Random;
using oracle::SupportShape;
using Vec = oracle::Vec3<long double>;

// A shape of any kind about zero, turned.
struct TurnedShape {
  Shape shape;
  Eigen::Quaternionf turn;
};

SupportShape support_of(const TurnedShape& body, const Vector3d& position) {
  return oracle::support_shape(body.shape, {position, body.turn});
}

void make_core_of(const TurnedShape& body, const Vector3d& offset, Core& core) {
  const auto turn = scalar::quaternion_as<double>(body.turn.coeffs());
  std::visit(
      [&](const auto& shape) {
        const auto own = scalar::shape_as<double>(shape);
        if constexpr (requires { scalar::make_core(own, turn, offset, core); }) {
          scalar::make_core(own, turn, offset, core);
        }
      },
      body.shape);
}

class RandomShapes {
 public:
  explicit RandomShapes(uint64_t seed) : random_(seed), polytopes_({.aspect = 4}, random_) {}

  Random& random() { return random_; }
  TurnedShape round() { return {round_shape(), polytopes_.orientation()}; }
  TurnedShape any() {
    constexpr ShapeKind kPolytopes[] = {ShapeKind::sphere, ShapeKind::capsule, ShapeKind::box,
                                        ShapeKind::triangle, ShapeKind::hull};
    if (random_.chance(0.5)) return round();
    return {polytopes_.shape(kPolytopes[random_.below(std::size(kPolytopes))], 1),
            polytopes_.orientation()};
  }

 private:
  Shape round_shape() {
    const auto length = [this] { return static_cast<float>(random_.uniform(0.25, 1)); };
    switch (random_.below(3)) {
      case 0:
        return Cylinder{length(), length()};
      case 1:
        return Cone{length(), length()};
      default:
        return Ellipsoid{{length(), length(), length()}};
    }
  }

  Random random_;
  oracle::ConvexRandom polytopes_;
};

TEST(RoundCores, SeparationsAreThoseOfTheOracle) {
  RandomShapes shapes(60);
  constexpr double kSame = 2e-7;
  size_t overlaps = 0;
  const uint32_t count = rounds(40, 12);
  for (uint32_t round = 0; round < count; ++round) {
    TurnedShape a = shapes.round(), b = shapes.any();
    if (shapes.random().chance(0.5)) std::swap(a, b);
    const Vector3d d = shapes.random().direction() * shapes.random().uniform(0, 2.2);
    CorePair cores;
    make_core_of(a, Vector3d::Zero(), cores.a);
    make_core_of(b, d, cores.b);
    const scalar::CoreGap gap = scalar::find_gap(cores.a, cores.b, {});
    const auto found = core_separation(cores.a, cores.b, gap, d, {});
    const SupportShape of_a = support_of(a, Vector3d::Zero()), of_b = support_of(b, d);
    const auto expected = separation_by_supports(of_a, of_b, 2e-6L);
    overlaps += expected.high < 0;
    EXPECT_GT(found.separation, static_cast<double>(expected.low) - kSame) << round;
    EXPECT_LT(found.separation, static_cast<double>(expected.high) + kSame) << round;
    EXPECT_EQ(found.status, Status::ok) << round;
    EXPECT_NEAR(found.normal.norm(), 1, 1e-12);
    // The gap along the normal.
    const Vec n = oracle::vec3_as<long double>(found.normal);
    const long double along =
        (dot(n, of_b.furthest(-n)) - of_b.radius) - (dot(n, of_a.furthest(n)) + of_a.radius);
    EXPECT_NEAR(static_cast<double>(along), found.separation, kSame) << round;
    const oracle::SupportPair placed(a.shape, {Vector3d::Zero(), a.turn}, b.shape, {d, b.turn});
    const Vec on_a = oracle::vec3_as<long double>(found.arm_a);
    const Vec on_b = oracle::vec3_as<long double>(Vector3d(d + found.arm_b));
    EXPECT_NEAR(static_cast<double>(placed.distance_from_a(on_a)), 0, kSame) << round;
    EXPECT_NEAR(static_cast<double>(placed.distance_from_b(on_b)), 0, kSame) << round;
  }
  EXPECT_GT(overlaps, count / 5);
  EXPECT_LT(overlaps, count * 4 / 5);
}

}  // namespace
}  // namespace carom::test

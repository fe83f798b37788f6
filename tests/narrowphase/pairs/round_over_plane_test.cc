// The lowest points of round shapes over a plane: the closed forms of the kernels beside those of
// the cores in double precision.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "narrowphase/pairs/halfspace/halfspace_cone_scalar.h"
#include "narrowphase/pairs/halfspace/halfspace_cylinder_scalar.h"
#include "narrowphase/pairs/halfspace/halfspace_ellipsoid_scalar.h"
#include "narrowphase/pairs/round/round_scalar.h"
#include "oracle/random.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

using oracle::Random;
using scalar::Vector3d;

constexpr double kFlat = 1e-9;

template <class S>
void expect_lowest(const S& shape, const Vector3d& n) {
  const auto closed = lowest_point(shape, n, kFlat);
  const auto of_core = scalar::lowest_point_of_core(shape, n, kFlat);
  EXPECT_NEAR(closed.height, of_core.height, 1e-12);
  EXPECT_NEAR((closed.point - of_core.point).norm(), 0, 1e-7) << n.transpose();
  // The height is that of the point, but for what lies flat.
  EXPECT_NEAR(n.dot(closed.point), closed.height, kFlat);
}

template <class S>
void expect_lowest_points(const S& shape, Random& random) {
  for (uint32_t i = 0; i < rounds(2000); ++i) expect_lowest(shape, random.direction());
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) expect_lowest(shape, Vector3d::Unit(axis) * sign);
  }
  const double r = 0.6, rise = 1.6;  // the cone lies on its side
  const double size = std::hypot(r, rise);
  for (int i = 0; i < 20; ++i) {
    const double angle = 0.1 + i * std::numbers::pi / 10;
    const double out = -rise / size;
    expect_lowest(shape, {out * std::cos(angle), out * std::sin(angle), -r / size});
  }
}

TEST(RoundOverPlane, LowestPointsAreThoseOfCores) {
  Random random(1);
  expect_lowest_points(scalar::CylinderShape<double>{0.6, 0.8, 0}, random);
  expect_lowest_points(scalar::ConeShape<double>{0.6, 0.8, 0}, random);
  expect_lowest_points(scalar::EllipsoidShape<double>{{0.3, 0.6, 0.9}, 0}, random);
  expect_lowest_points(scalar::EllipsoidShape<double>{{0.3, 0.6, 0}, 0}, random);
}

}  // namespace
}  // namespace carom::test

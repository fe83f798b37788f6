#include "io/generate/rotation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace carom::io {
namespace {

Eigen::Quaterniond eigen(const Quaternion& q) { return Eigen::Quaterniond(q.data()); }
Eigen::Vector3d eigen(const Vec3& v) { return Eigen::Vector3d(v.data()); }

TEST(Rotation, IsThatOfTheMathsLibrary) {
  Random random(1, 1);
  for (const double greatest : {1e-9, 0.1, 1.0, 3.2, 50.0, 1e4}) {
    for (int i = 0; i < 100; ++i) {
      const Vec3 vector = random.in_ball(greatest);
      const double angle = eigen(vector).norm();
      const Eigen::Quaterniond expected(Eigen::AngleAxisd(angle, eigen(vector) / angle));
      const Quaternion q = rotation_by(vector);
      EXPECT_NEAR(eigen(q).norm(), 1, 1e-15);
      EXPECT_LT((eigen(q).coeffs() - expected.coeffs()).norm(), 2e-15 * std::fmax(1, angle));
    }
  }
  EXPECT_EQ(rotation_by({0, 0, 0}), (Quaternion{0, 0, 0, 1}));
}

TEST(Rotation, ProductTurnsByTheSecondFirst) {
  Random random(1, 2);
  for (int i = 0; i < 100; ++i) {
    const Quaternion a = random.rotation();
    const Quaternion b = random.rotation();
    EXPECT_LT((eigen(product(a, b)).coeffs() - (eigen(a) * eigen(b)).coeffs()).norm(), 1e-15);
  }
}

TEST(Rotation, HalfExtentsHoldTheTurnedBox) {
  Random random(1, 3);
  const Vec3 edges = {1, 2, 3};
  for (int i = 0; i < 100; ++i) {
    const Quaternion q = random.rotation();
    const Eigen::Matrix3d turn = eigen(normalized(q)).toRotationMatrix();
    const Eigen::Vector3d expected = turn.cwiseAbs() * eigen(edges) / 2;
    EXPECT_LT((eigen(half_extents_turned(edges, q)) - expected).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace carom::io

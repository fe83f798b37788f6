// Bounds of the reference for capsules, boxes, k-DOPs, triangles and half-spaces, against exact
// corners: they contain the shape and are tight.
#include <gtest/gtest.h>

#include "tests/support/float_modes.h"
#include "tests/support/kind_pairs.h"
#include "tests/support/oracle.h"
#include "tests/support/show.h"
#include "tests/support/special_floats.h"
#include "tests/support/textbook.h"

namespace carom::test {
namespace {

using Exact = ConvexShape<Real>;

// `bound` is below `exact` by at most 4e-6 of the size and the spacing of its floats. `exact`
// itself has only a hundred digits.
void expect_tight_below(float bound, const Real& exact, const Real& size) {
  EXPECT_LE(Real(bound), exact + size * Real(1e-60)) << hex(bound);
  if (!std::isfinite(bound)) return;
  const Real spacing = Real(std::nextafter(bound, kInfinity)) - Real(bound);
  EXPECT_GE(Real(bound), exact - size * Real(4e-6) - 4 * spacing) << hex(bound);
}

void expect_bounds_of_support(const PlacedShape& body, PositionType positions) {
  const ShownIfFailed shown([&] { return show(body) + ", " + name(positions); });
  const reference::Box box = reference::bounds(body.shape, body.pose(), positions);
  Pose pose = body.pose();
  pose.position = stored(body.position, positions);
  const Exact shape(body.shape, pose);
  const Real size = bounding_radius(body.shape);
  for (int axis = 0; axis < 3; ++axis) {
    Vec3<Real> direction;
    (axis == 0 ? direction.x : axis == 1 ? direction.y : direction.z) = 1;
    expect_tight_below(box.lower[axis], -shape.support(-direction), size);
    expect_tight_below(-box.upper[axis], -shape.support(direction), size);
  }
}

class KindsReferenceBounds : public testing::TestWithParam<ConvexFamily> {};

TEST_P(KindsReferenceBounds, ContainTheShapeAndAreTight) {
  for (const ShapeKind kind :
       {ShapeKind::capsule, ShapeKind::box, ShapeKind::dop, ShapeKind::triangle}) {
    const KindPair kinds{ShapeKind::sphere, kind};
    for (const PositionType positions : kPositionTypes) {
      for (const ConvexPair& pair :
           make_convex_pairs(GetParam(), kinds, positions, fewer_if_slow(kinds, 60))) {
        expect_bounds_of_support({pair.shape_b, pair.pose_b.position, pair.pose_b.orientation},
                                 positions);
        if (HasFailure()) return;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Families, KindsReferenceBounds, testing::ValuesIn(convex_families()),
                         family_name);

TEST(KindsReferenceBounds, OfUnturnedBoxesAreThoseOfBoxesAlongTheAxes) {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3f half(static_cast<float>(random.log_uniform(1e-3, 1e3)),
                               static_cast<float>(random.log_uniform(1e-3, 1e3)),
                               static_cast<float>(random.log_uniform(1e-3, 1e3)));
    const Pose pose{random.direction() * 100};
    for (const PositionType positions : kPositionTypes) {
      const auto turnable = reference::bounds(Box{half}, pose, positions);
      const auto aabb = reference::bounds(Aabb::from_half_extents(half), pose, positions);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(turnable.lower[axis], aabb.lower[axis]);
        EXPECT_GE(turnable.upper[axis], aabb.upper[axis]);
      }
    }
  }
}

TEST(KindsReferenceBounds, OfHalfspacesAreInfinite) {
  for (const PositionType positions : kPositionTypes) {
    const auto box = reference::bounds(Halfspace{{1, 2, 3}, 4}, {{5, 6, 7}}, positions);
    EXPECT_EQ(box.lower, Eigen::Vector3f::Constant(-kInfinity));
    EXPECT_EQ(box.upper, Eigen::Vector3f::Constant(kInfinity));
  }
}

// Case 61 of CASES.md.
TEST(KindsReferenceBounds, ContainTheShapeFarFromTheOrigin) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    PlacedShape body = oriented_box({1e7 + 0.9, 0.3, -1e7}, {0.5f, 0.5f, 0.5f});
    for (int c = 0; c < 4; ++c) {
      body.orientation.coeffs()[c] = static_cast<float>(random.uniform(-1, 1));
    }
    for (const PositionType positions : kPositionTypes) expect_bounds_of_support(body, positions);
  }
}

std::vector<PlacedShape> invalid_bodies() {
  const auto box_turned = [](float x, float y, float z, float w) {
    return oriented_box({0, 0, 0}, {1, 1, 1}, Eigen::Quaternionf(w, x, y, z));
  };
  const PlacedShape flat = triangle(
      {0, 0, 0}, {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(1, 0, 0), Eigen::Vector3f(0, 1, 0)});
  std::vector<PlacedShape> all = {box_turned(0, 0, 0, 0),
                                  box_turned(kNan, 0, 0, 1),
                                  box_turned(0, 0, kInfinity, 1),
                                  oriented_box({0, 0, 0}, {1, -1, 1}),
                                  oriented_box({0, 0, 0}, {1, 1, kNan}),
                                  oriented_box({0, kNan, 0}, {1, 1, 1}),
                                  capsule({0, 0, 0}, {0, 0, 0}, {0, 0, 1}, -1),
                                  capsule({0, 0, 0}, {0, kInfinity, 0}, {0, 0, 1}, 1),
                                  capsule({0, 0, 0}, {0, 0, 0}, {0, 0, kNan}, 1),
                                  halfspace({0, 0, 0}, {0, 0, 0}, 1),
                                  halfspace({0, 0, 0}, {0, 0, 1}, kInfinity),
                                  flat,
                                  flat,
                                  flat};
  std::get<Triangle>(all[11].shape).thickness = -1;
  std::get<Triangle>(all[12].shape).corners[2][1] = kNan;
  std::get<Triangle>(all[13].shape).inner_edges = 8;
  return all;
}

TEST(KindsReferenceBounds, InvalidBodiesAreEmpty) {
  for (const FloatMode& mode : float_modes()) {
    for (const PlacedShape& body : invalid_bodies()) {
      const ShownIfFailed shown([&] { return show(body); });
      for (const PositionType positions : kPositionTypes) {
        const ScopedFloatMode scoped(mode);
        EXPECT_FALSE(reference::is_valid(body.shape, body.pose(), positions));
        const auto box = reference::bounds(body.shape, body.pose(), positions);
        EXPECT_EQ(box.lower, Eigen::Vector3f::Constant(kInfinity));
        EXPECT_EQ(box.upper, Eigen::Vector3f::Constant(-kInfinity));
      }
    }
  }
}

}  // namespace
}  // namespace carom::test

// Inputs that broke other collision systems, or were made to, for capsules, oriented boxes,
// triangles and half-spaces. The oracle computes exact answers from the inputs after their rounding
// to float32. Unrotated boxes are tested as aabbs, too.
#include <gtest/gtest.h>

#include "tests/support/checked_everywhere.h"
#include "tests/support/special_floats.h"

namespace carom::test {
namespace {

using Eigen::AngleAxisf;
using Eigen::Quaternionf;
using Eigen::Vector3f;
using Eigen::Vector4f;
using Result = reference::PairResult;

double exact_gap(const TestPair& pair, PositionType positions = kFloat32) {
  return static_cast<double>(ExactKinds(pair, positions).answer.value);
}

// The pair, and its variants with unrotated boxes as aabbs.
std::vector<TestPair> with_aabbs(const TestPair& pair) {
  const auto versions = [](const PlacedShape& body) {
    std::vector<PlacedShape> all{body};
    const auto* turnable = std::get_if<Box>(&body.shape);
    if (turnable && body.orientation.coeffs() == Vector4f(0, 0, 0, 1)) {
      all.push_back(box(body.position, turnable->half));
    }
    return all;
  };
  std::vector<TestPair> all;
  for (const PlacedShape& a : versions(pair.a)) {
    for (const PlacedShape& b : versions(pair.b)) all.push_back({a, b});
  }
  return all;
}

Quaternionf turn(float angle, const Vector3f& axis) {
  return Quaternionf(AngleAxisf(angle, axis.normalized()));
}

TEST(KindsCases, C13_SphereSinkingIntoATopFace) {
  float last = -1;
  for (int i = 0; i <= 200; ++i) {
    const double z = -0.01 + (0.01 - 1e-6) * i / 200;
    const auto result = checked_everywhere(
        {sphere(0.1, 0.2, z, 0.005), oriented_box({0, 0, -0.255}, {0.5, 0.5, 0.25})});
    EXPECT_NEAR(result.separation, z, 1e-7);
    EXPECT_EQ(result.normal.head<2>(), Eigen::Vector2f(0, 0));
    EXPECT_FLOAT_EQ(result.normal.z(), -1);
    EXPECT_GE(result.separation, last);
    last = result.separation;
  }
}

TEST(KindsCases, C13_SphereSinkingIntoThePlaneOfAHalfspace) {
  for (int i = 0; i <= 200; ++i) {
    const double z = -0.01 + (0.01 - 1e-6) * i / 200;
    const auto result = checked_everywhere(
        {sphere(0.1, 0.2, z, 0.005), halfspace({3, 4, -0.255}, {0, 0, 1}, 0.25f)});
    EXPECT_NEAR(result.separation, z, 1e-7);
    EXPECT_EQ(result.normal, Vector3f(0, 0, -1));
  }
}

TEST(KindsCases, C14_SphereThatTouchesAnEdge) {
  const auto result =
      checked_everywhere({sphere(1.79e-10, 0.04, 0.33, 0.06),
                          oriented_box({0.05, 0.15, 0.35}, Vector3f::Constant(0.05f))});
  EXPECT_NEAR(result.separation, 0, 1e-6);
}

TEST(KindsCases, C15_CubesThatOverlapALittle) {
  const Vector3f half(1, 1, 1);
  for (const TestPair& pair :
       with_aabbs({oriented_box({0, 0, 0}, half), oriented_box({0, 0, 1.9}, half)})) {
    const auto result = checked_everywhere(pair);
    EXPECT_NEAR(result.separation, -0.1, 2e-6);
    EXPECT_EQ(result.normal, Vector3f(0, 0, 1));
    EXPECT_EQ(result.manifold_count, 4);
  }
}

TEST(KindsCases, C16_DistanceOfUnitCubes) {
  const Vector3f half(0.5f, 0.5f, 0.5f);
  for (const TestPair& pair :
       with_aabbs({oriented_box({0, 0, 0}, half), oriented_box({0, 4, 0}, half)})) {
    const auto result = checked_everywhere(pair);
    EXPECT_EQ(result.separation, 3);
    EXPECT_EQ(result.normal, Vector3f(0, 1, 0));
  }
}

TEST(KindsCases, C19_FlatBoxInsideATallOne) {
  for (const TestPair& pair :
       with_aabbs({oriented_box({-0.675, 0, 0.9115}, {0.307f, 1.5f, 0.185f}),
                   oriented_box({-0.692, 0, 0.935}, {0.247f, 0.276f, 0.005f})})) {
    const auto result = checked_everywhere(pair);
    EXPECT_NEAR(result.separation, -0.1665, 2e-6);
    EXPECT_EQ(result.normal, Vector3f(0, 0, 1));
  }
}

TEST(KindsCases, C21_LeastOverlapAlongZ) {
  for (const TestPair& pair :
       with_aabbs({oriented_box({-0.071, -0.772, 0.8}, {0.1f, 0.165f, 0.05f}),
                   oriented_box({0.121, -0.787696057, 0.534220442}, {0.226f, 0.135f, 0.3f})})) {
    const auto result = checked_everywhere(pair);
    EXPECT_NEAR(result.separation, -0.0842204420, 1e-6);
    EXPECT_EQ(result.normal, Vector3f(0, 0, -1));
  }
}

TEST(KindsCases, C22_EqualTiltedCubesAFewFloatsFromTouch) {
  for (const Quaternionf& tilt : {Quaternionf::Identity(), turn(0.7853982f, {0, 0, 1}),
                                  turn(0.3f, {1, 2, 3}), turn(1e-4f, {0, 1, 0})}) {
    for (const float side : {0.01f, 0.25f, 0.5f, 10.0f, 1000.0f}) {
      const Vector3f half = Vector3f::Constant(side / 2);
      for (int steps = -4; steps <= 4; ++steps) {
        float distance = side;
        for (int i = 0; i < std::abs(steps); ++i) {
          distance = std::nextafter(distance, steps > 0 ? 2 * side : 0.0f);
        }
        const Eigen::Vector3d x = (tilt * Vector3f(distance, 0, 0)).cast<double>();
        checked_everywhere({oriented_box({0, 0, 0}, half, tilt), oriented_box(x, half, tilt)});
      }
    }
  }
}

TEST(KindsCases, C28_BoxesThatTouchAwayFromTheOrigin) {
  const Vector3f half(1, 1, 1);
  for (const TestPair& pair :
       with_aabbs({oriented_box({0, 0, 1.8599132}, half), oriented_box({0, 2, 1.8599132}, half)})) {
    const auto result = checked_everywhere(pair);
    EXPECT_EQ(result.separation, 0);
    EXPECT_TRUE(result.overlap);
  }
}

TEST(KindsCases, C30_DepthDoesNotDependOnTheSizeOfASlab) {
  for (const float angle : {0.0f, 0.4f}) {
    for (const float depth : {1e-6f, 1e-4f, 1e-2f, 0.1f}) {
      for (const float s : {1.0f, 10.0f, 25.0f, 50.0f, 100.0f}) {
        const auto small_box =
            oriented_box({0.3, 0.2, 0.35f - depth}, {0.1f, 0.1f, 0.1f}, turn(angle, {0, 0, 1}));
        for (const TestPair& pair :
             with_aabbs({oriented_box({0, 0, 0}, {s, s, 0.25f}), small_box})) {
          const auto result = checked_everywhere(pair);
          EXPECT_NEAR((result.normal - Vector3f(0, 0, 1)).norm(), 0, 2 * kEps);
          EXPECT_NEAR(result.separation, exact_gap(pair), kEps);
        }
      }
    }
  }
}

TEST(KindsCases, C31_FlushBoxes) {
  const Vector3f half = Vector3f::Constant(0.0355f);
  for (const TestPair& pair :
       with_aabbs({oriented_box({0, 0, 0}, half), oriented_box({0.071 - 0.000056, 0, 0}, half)})) {
    const auto result = checked_everywhere(pair);
    EXPECT_NEAR(result.separation, -0.000056, 2e-8);
    EXPECT_EQ(result.manifold_count, 4);
    for (size_t i = 0; i < result.manifold_count; ++i) {
      EXPECT_GE(result.manifold.separation[i], exact_gap(pair) - 1e-8);
    }
  }
}

TEST(KindsCases, C33_EqualDepthAlongEveryAxis) {
  for (const TestPair& pair :
       with_aabbs({oriented_box({0, 0, 0}, {10, 10, 10}), oriented_box({14, 14, 14}, {5, 5, 5})})) {
    const auto result = checked_everywhere(pair);
    EXPECT_EQ(result.separation, -1);
    EXPECT_EQ(result.normal.cwiseAbs().sum(), 1);
  }
}

// The box hovers, and then is sunk by as much: there the manifold is the whole face.
TEST(KindsCases, C34_BoxThatTurnsOverASlab) {
  for (const double gap : {0.0005, -0.0005}) {
    for (int step = 0; step <= 480; ++step) {
      const float angle = static_cast<float>(2 * M_PI * step / 480);
      const auto hovering =
          oriented_box({0, 0.75 + gap, 0}, {0.25f, 0.75f, 0.375f}, turn(angle, {0, 1, 0}));
      for (const TestPair& pair :
           with_aabbs({oriented_box({0, -0.5, 0}, {5, 0.5f, 5}), hovering})) {
        const auto result = checked_everywhere(pair);
        EXPECT_NEAR(result.separation, gap, 1e-6);
        EXPECT_GT(result.normal.y(), 0.99999f);
        EXPECT_EQ(result.manifold_count, gap > 0 ? 0 : 4);
      }
      if (HasFailure()) return;
    }
  }
}

// Two faces cross like strips, far from all their corners.
TEST(KindsCases, CrossingFacesOfThinBoxes) {
  const Quaternionf turned(1, 0.5f, 0, 0);
  const PlacedShape plate = oriented_box({0, 0, 0}, {1, 1, 0x1p-7f}, turned);
  checked_everywhere({box({-0x1.fp+0, -0x1.4p-2, -0x1.4p-2}, {1, 0x1p-4f, 0x1.8p-1f}), plate});
  checked_everywhere(
      {oriented_box({-0x1.08p+1, -0x1.4p-2, -0x1p-3}, {1, 0x1p-4f, 0x1.cp-1f}), plate});
  for (double y = -1; y <= 1; y += 0x1p-3) {
    for (double z = -1; z <= 1; z += 0x1p-3) {
      checked_everywhere({oriented_box({-0x1.fp+0, y, z}, {1, 0x1p-4f, 0x1.8p-1f}), plate});
    }
  }
}

// Aabbs decide the same in both orders, also within rounding.
TEST(KindsCases, AabbsTouchBothWaysRoundOrNeither) {
  const PlacedShape cube{Aabb{{-1, -1, -1}, {1, 1, 0x1.fffffep-1f}}, {0, 0, 0}};
  for (double z = 3 - 0x1p-20; z <= 3 + 0x1p-20; z += 0x1p-23) {
    const TestPair pair{cube, {Aabb{{-2, -2, -2}, {2, 2, 2}}, {0, 0, z}}};
    const Result one = checked_everywhere(pair), other = checked_everywhere(swapped(pair));
    EXPECT_EQ(one.overlap, other.overlap) << z;
    EXPECT_EQ(one.separation, other.separation) << z;
  }
}

// The magnitude of the cosine between the contact normal and the triangle's normal.
double cosine_with_face(const TestPair& pair) {
  const auto result = checked_everywhere(pair);
  const auto& corners = std::get<Triangle>(pair.b.shape).corners;
  const Vector3f face = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  EXPECT_TRUE(result.overlap);
  EXPECT_TRUE(std::isfinite(result.separation));
  return std::fabs(result.normal.dot(face));
}

// The capsule along y lies on the triangle: its normal has this cosine to the face's normal. The
// capsule along z stands in the triangle: its penetration direction is across the nearest edge.
void expect_good_capsules(float half_length, float radius, const std::array<Vector3f, 3>& corners,
                          double cosine) {
  const PlacedShape face = triangle({0, 0, 0}, corners);
  const Vector3f up(0, half_length, 0), out(0, 0, half_length);
  EXPECT_NEAR(cosine_with_face({capsule({0, 0, 0}, -up, up, radius), face}), cosine, 1e-5);
  EXPECT_NEAR(cosine_with_face({capsule({0, 0, 0}, -out, out, radius), face}), 0, 1e-5);
}

TEST(KindsCases, C35_CapsuleThatSinksIntoATriangle) {
  expect_good_capsules(0.5f, 0.37f,
                       {Vector3f(-0.479988575f, -1.36185002f, 0.269966960f),
                        Vector3f(-0.104996204f, 0.388152480f, 0.269967079f),
                        Vector3f(-0.104996204f, -1.36185002f, 0.269966960f)},
                       0.931994);
}

TEST(KindsCases, C36_CapsuleThatSinksIntoALargeTriangle) {
  expect_good_capsules(0.675f, 0.42f,
                       {Vector3f(-0.0904417038f, -4.72410202f, 0.307858467f),
                        Vector3f(-0.0904417038f, 5.27589798f, 0.307857513f),
                        Vector3f(9.9095583f, 5.27589798f, 0.307864189f)},
                       1);
}

TEST(KindsCases, C45_SegmentThroughTheCentroidOfADistantTriangle) {
  const std::array<Vector3f, 3> corners = {Vector3f(2832.862f, 200, -641.5822f),
                                           Vector3f(2834.611f, 200.0066f, -643.3685f),
                                           Vector3f(2834.289f, 200, -640.1809f)};
  const Vector3f centroid = (corners[0] + corners[1] + corners[2]) / 3;
  for (const Vector3f& way : {Vector3f(0, 10, 0), Vector3f(3, 5, -2), Vector3f(0, 0.01f, 0)}) {
    const auto result = checked_everywhere(
        {capsule({0, 0, 0}, centroid - way, centroid + way, 0), triangle({0, 0, 0}, corners)});
    EXPECT_TRUE(result.overlap);
  }
}

TEST(KindsCases, C61_SameContactFarFromTheOrigin) {
  const Vector3f half(0.5f, 0.5f, 0.5f);
  for (const Quaternionf& tilt : {Quaternionf::Identity(), turn(0.3f, {1, 2, 3})}) {
    const auto at = [&](double x) {
      return TestPair{oriented_box({x, 0, 0}, half, tilt), oriented_box({x + 0.9, 0, 0}, half)};
    };
    const auto here = checked_everywhere(at(0), PositionType::float64);
    const auto there = checked_everywhere(at(1e7), PositionType::float64);
    EXPECT_NEAR(here.separation, there.separation, 1e-4);
    EXPECT_LE((here.arm_a - there.arm_a).norm(), 1e-4);
    EXPECT_LE((here.arm_b - there.arm_b).norm(), 1e-4);
    EXPECT_LE((here.normal - there.normal).norm(), 1e-4);
  }
}

// Two coplanar triangles that share the edge from (0, -5, 0) to (0, 5, 0).
std::array<PlacedShape, 2> coplanar_triangles(bool is_inner) {
  const Vector3f lower(0, -5, 0), upper(0, 5, 0);
  PlacedShape left = triangle({0, 0, 0}, {lower, upper, Vector3f(-9, 0, 0)});
  PlacedShape right = triangle({0, 0, 0}, {lower, Vector3f(9, 0, 0), upper});
  std::get<Triangle>(left.shape).inner_edges = is_inner ? 1 : 0;
  std::get<Triangle>(right.shape).inner_edges = is_inner ? 4 : 0;
  return {left, right};
}

std::vector<PlacedShape> resting_at(double x) {
  return {sphere(x, 0, 2.99, 3), capsule({x, 0, 2.99}, {-0.5f, 0, 0}, {0.5f, 0, 0}, 3),
          capsule({x, 0, 2.99}, {0, -0.5f, 0}, {0, 0.5f, 0}, 3),
          capsule({x, 0, 2.99}, {0, 0, 0}, {0, 0, 2}, 3)};
}

TEST(KindsCases, C64_NoGhostContactsAtInnerEdges) {
  for (const PlacedShape& triangle : coplanar_triangles(true)) {
    for (const double x : {-0.2, -0.05, 0.0, 0.05, 0.2}) {
      for (const PlacedShape& body : resting_at(x)) {
        const TestPair pair{body, triangle};
        SCOPED_TRACE(show(pair));
        const Result result = reference_result(pair, kFloat32);
        EXPECT_LE((result.normal - Vector3f(0, 0, -1)).norm(), 1e-6f) << hex3(result.normal);
        const Result other = reference_result(swapped(pair), kFloat32);
        EXPECT_LE((other.normal - Vector3f(0, 0, 1)).norm(), 1e-6f) << hex3(other.normal);
      }
    }
  }
}

// A contact at an edge that is not inside a mesh has a tilted normal, so that bodies roll off.
TEST(KindsCases, C64_OuterEdgesTurnTheNormal) {
  const PlacedShape left = coplanar_triangles(false)[0];
  const Result result = checked_everywhere({sphere(0.2, 0, 2.99, 3), left});
  EXPECT_LT(result.normal.x(), -0.05f);
}

// A one-sided triangle meets bodies in front of it, and none behind it.
TEST(KindsCases, OneSidedTrianglesMeetWhatIsInFront) {
  PlacedShape two_sided = coplanar_triangles(false)[1];
  PlacedShape one_sided = two_sided;
  std::get<Triangle>(one_sided.shape).one_sided = true;
  for (const double z : {0.3, -0.3}) {
    for (const PlacedShape& body :
         {sphere(3, 0, z, 0.5), capsule({3, 0, z}, {-0.5f, 0, 0}, {0.5f, 0, 0}, 0.5f),
          oriented_box({3, 0, z}, {0.7f, 0.6f, 0.5f}, turn(0.2f, {0, 0, 1})),
          box({3, 0, z}, {0.7f, 0.6f, 0.5f})}) {
      SCOPED_TRACE(show(body));
      const Result both = checked_everywhere({body, two_sided});
      const Result front = reference_result({body, one_sided}, kFloat32);
      EXPECT_TRUE(both.overlap);
      EXPECT_EQ(front.overlap, z > 0);
      EXPECT_EQ(front.manifold_count > 0, z > 0);
      if (z > 0) {  // one-sided triangles are tested in double precision, others round differently
        EXPECT_FLOAT_EQ(front.separation, both.separation);
      }
    }
  }
}

// Boxes that are close and turned by 1e-4. Rounding of the short vector between them once tilted
// the normal by more than 1e-5 of their size.
TEST(KindsCases, NormalsOfCloseNearlyParallelBoxes) {
  const PlacedShape a{Aabb{{-0x1.0d3d08p+0f, -0x1.10faa4p-1f, -0x1.840c9ep+0f},
                           {0x1.0e516cp+0f, 0x1.20fe48p-1f, 0x1.af58bep-1f}}};
  const PlacedShape b = oriented_box(
      {-0x1.a85036d13d624p+0, 0x1.c2449bbaf2815p+0, 0x1.4fbcf1aced9b2p+0},
      {0x1.3115bcp+0f, 0x1.354af6p-1f, 0x1.a06abcp-1f},
      Eigen::Quaternionf(-0x1.1ce424p-16f, 0x1.fff9fp-1f, 0x1.000308p+0f, -0x1.5c3d14p-16f));
  EXPECT_NEAR(checked_everywhere({a, b}, PositionType::float64).separation, 0.0031597854, 1e-6);
}

// A sphere ten metres along a plane from the plane's position: rounding once gave an error of
// 2.9e-6 of the sphere's size.
TEST(KindsCases, SpheresFarAlongAPlane) {
  const PlacedShape ball = sphere(-0x1.12c1e8p+5, 0x1.8162b6p+5, -0x1.9029dep+5, 0x1.543f36p-1);
  PlacedShape plane = halfspace({-0x1.16e1bcp+5, 0x1.3b7728p+5, -0x1.6a967ep+5},
                                {0x1.a4fc3cp+1f, 0x1.33a7ecp+2f, 0x1.b81aeep-1f}, -0x1.016c8ep-1f);
  plane.orientation =
      Eigen::Quaternionf(-0x1.c7cc4ap-2f, 0x1.83df8p-1f, -0x1.c121e4p-2f, 0x1.82611ep-3f);
  const Result result = checked_everywhere({ball, plane});
  const ExactKinds exact({ball, plane}, kFloat32);
  EXPECT_LE(std::fabs(result.separation - exact.answer.value), 2e-6 * 0x1.543f36p-1);
}

}  // namespace
}  // namespace carom::test

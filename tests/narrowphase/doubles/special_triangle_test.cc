// Special triangles that nearly touch other shapes.
#include "narrowphase/doubles/special_triangle.h"

#include <gtest/gtest.h>

namespace carom::test {
namespace {

// Polytopes once had a GJK of their own. Of this pair it found a normal that was off by 0.7, and a
// distance that was a quarter too short.
TEST(SpecialTriangle, SliverNearlyTouchesThePrism) {
  using namespace scalar;
  const Vector3d close(-2.0000000013389836, -1.0000000007896934, 2);
  const TriangleShape<double> sliver{.corners = {Vector3d(-2, -1, 2), Vector3d(2, 1, 1), close},
                                     .thickness = 0,
                                     .one_sided = true,
                                     .inner_edges = 3,
                                     .has_properties = true};
  const TriangleShape<double> prism{
      .corners = {Vector3d(1, 2, -1), Vector3d(-1, 1, 0), Vector3d(2, 0, -2)},
      .thickness = 0.50954890251159668,
      .one_sided = false,
      .inner_edges = 3,
      .has_properties = true};
  const Quaternion<double> unturned{Vector3d::Zero(), 1};
  const Vector3d d(-4.0000000013238868, -0.99999999872748435, 4.0000000009077601);
  const SeparationAs<double> result = convex::separation_of(sliver, prism, {d, unturned, unturned});
  // The nearest points in 113-bit arithmetic.
  EXPECT_NEAR(result.separation, 1.9871413576897285e-09, 1e-14);
  const Vector3d normal(-0.4584982080148961, 0.77741761544798726, 0.43058244789853489);
  EXPECT_LT((result.normal - normal).norm(), 1e-5);
}

}  // namespace
}  // namespace carom::test

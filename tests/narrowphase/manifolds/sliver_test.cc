// Triangles thinner than the slack of clipping: their manifolds once extended beyond the sharp
// corners. Random tests found these inputs.
#include <gtest/gtest.h>

#include "tests/support/checked_everywhere.h"

namespace carom::test {
namespace {

using Eigen::Vector3f;

Eigen::Quaternionf turned(float x, float y, float z, float w) { return {w, x, y, z}; }

Triangle triangle(const Vector3f& a, const Vector3f& b, const Vector3f& c) {
  return {.corners = {a, b, c}};
}

TEST(Sliver, UnderACapsuleOfTheSamePose) {
  const Eigen::Vector3d position(-0x1.4f5cbdb73dffap+1, 0x1.34047a1edeea2p+3,
                                 -0x1.6454f8a7017fcp-1);
  const auto orientation = turned(0x1.2e5d86p-1f, 0x1.8e144ap-1f, -0x1.0c2bb8p-3f, 0x1.604df8p-3f);
  const Triangle sliver = triangle({0, 0, -0x1.5ed708p-4f}, {0, 0, -0x1.14f1fep-2f},
                                   {-0x1.6648fap-22f, 0x1.0fa056p-20f, -0x1.a15bbcp-3f});
  const Vector3f end(0x1.630726p-3f, 0x1.d99ed2p-7f, -0x1.89a7cp-3f);
  for (const Vector3f& a : {end, Vector3f(-end)}) {
    checked_everywhere(
        {{Capsule{a, -a, 0x1.a24122p-3f}, position, orientation}, {sliver, position, orientation}},
        PositionType::float64);
  }
}

TEST(Sliver, UnderALongCapsuleOfTheSamePose) {
  const Eigen::Vector3d position(0x1.f5d78b7e41361p+0, 0x1.3712d5de3f5cfp+3, -0x1.49ab28d06c07cp+0);
  const auto orientation = turned(0x1.172dep-1f, 0x1.135d18p-1f, -0x1.28cd4p-2f, -0x1.25dcbcp-1f);
  const Vector3f a(0x1.63bd56p-3f, -0x1.24417p-2f, -0x1.8e986ep-2f);
  const Triangle sliver = triangle({-0x1.6ca696p-2f, 0, 0}, {-0x1.16d73cp-3f, 0, 0},
                                   {-0x1.825f06p-2f, -0x1.6c3f48p-15f, 0x1.4dea46p-15f});
  checked_everywhere(
      {{Capsule{a, -a, 0x1.263f78p-1f}, position, orientation}, {sliver, position, orientation}},
      PositionType::float64);
}

TEST(Sliver, TouchesATriangle) {
  const Triangle sliver =
      triangle({0, -0x1.baa172p-2f, -0x1.7b24bep-3f}, {0, -0x1.baa172p-2f, -0x1.8e748cp-3f},
               {0, 0x1.417836p-2f, -0x1.995f64p-3f});
  const Triangle other = triangle({-0x1.bed64cp-5f, 0x1.46f9b2p-1f, -0x1.93f894p-7f},
                                  {-0x1.bed64cp-5f, 0x1.46f9b2p-1f, -0x1.194d34p-1f},
                                  {-0x1.bed64cp-5f, 0x1.05d9d4p-1f, -0x1.8a653ap-10f});
  const Eigen::Vector3d position(-0x1.8ecf2c574dfp-5, 0x1.90c505db4de0bp-3, -0x1.febdc9a55b9dbp-3);
  checked_everywhere({{sliver, {-0.0, -0.0, 0}, turned(0, 0, 1, 0)},
                      {other, position, turned(-0x1.4ed2b2p-8f, 0x1.94f4acp-5f, 1, 0x1.68905p-8f)}},
                     PositionType::float64);
}

}  // namespace
}  // namespace carom::test

// Points beside hulls as thin as needles: rounding tilts the needle's plane, and the difference of
// the two has no volume. hull_fuzz, and a search based on its findings, found these inputs.
#include <gtest/gtest.h>

#include "tests/support/checked_everywhere.h"
#include "tests/support/hulls.h"

namespace carom::test {
namespace {

Eigen::Quaternionf turned(float x, float y, float z, float w) { return {w, x, y, z}; }

// The pairs are separate by a thousandth of their size or less.
void check(const PlacedShape& point, const PlacedShape& needle,
           PositionType positions = PositionType::float64) {
  const auto result = checked_everywhere({point, needle}, positions);
  EXPECT_FALSE(result.overlap);
  EXPECT_EQ(result.status, Status::ok);
}

// The penetration search got this pair and tried only one direction across the segment.
TEST(Needle, Segment) {
  check(placed_hull({{0, 0, 0}}, {0, 0, 0},
                    turned(0x1.a6b318p-2f, -0x1.0b1cf4p-5f, 0x1.c0d268p-1f, 0x1.f6154p-3f)),
        placed_hull({{-0x1.54a88cp-63f, -0x1.1b7a5ap-12f, -0x1.c7f2f6p-1f},
                     {0x1.24ec62p-64f, -0x1.84b33ep-13f, 1}},
                    {-0x1.f8aa79e885e1bp-9, 0x1.b385538fd15ep-3, 0x1.2c44087f2c8eap-4},
                    turned(-0x1.6c0004p-2f, 0x1.d61bep-2f, 0x1.4e298ap-1f, 0x1.f26adep-2f)));
}

// The same: it tried only the direction across the triangle's plane.
TEST(Needle, Triangle) {
  check(placed_hull({{0x1.3e38p+25f, -0x1.edcp+23f, 0x1.8564p+25f}},
                    {0x1.0a4d6392cp+117, -0x1.f45e64853p+118, 0x1.0b0eab234ep+120},
                    turned(0x1.8p+6f, -0x1.28p+5f, -2, -12)),
        placed_hull({{-0x1.c86082p+31f, -0x1.0a5786p+4f, -0x1.697aap-44f},
                     {-0x1.ea80dep-23f, 0x1.bafdaap+13f, -0x1.c457cap+56f},
                     {-0x1.d1bffp-125f, 0x1.038c7p+0f, -0x1.aaf84p+110f}},
                    {0x1.0a8355bad02c2p+117, -0x1.f421e867c888cp+118, 0x1.0aef2caca48fp+120},
                    turned(69, -84, -12, -24)),
        PositionType::float32);
}

// The float32 normal of the three corners was off by a hundredth, and the witness point by twice
// the size.
TEST(Needle, TriangleWhosePlaneIsTilted) {
  check(placed_hull({{0, 0, 0}}, {0, 0, 0},
                    turned(-0x1.f66d4ep-1f, 0x1.7c4582p-3f, 0x1.9f0dc2p-5f, 0x1.20abb8p-10f)),
        placed_hull({{0x1.955d48p-21f, -0x1.e14636p-13f, -0x1.6ad34ap-2f},
                     {0x1.11636ap-20f, 0x1.58addap-16f, -0x1.a90e88p-4f},
                     {-0x1.980dp-19f, -0x1.3db784p-13f, 0x1.bf305p-2f}},
                    {0x1.902883ab7479bp-6, -0x1.defbf77330d1cp-8, -0x1.13db3f2efdd7cp-6},
                    turned(0x1.5bf9fcp-2f, 0x1.52f15ap-2f, -0x1.aeff92p-2f, -0x1.8bde44p-1f)));
}

// The normal is off by about as much as the tolerance of witness points allows, and so is the
// distance.
TEST(Needle, FourPointsWhosePlaneIsTiltedALittle) {
  check(placed_hull({{0, 0, 0}}, {0, 0, 0},
                    turned(-0x1.3b429p-3f, -0x1.e57118p-3f, 0x1.ea437p-1f, 0x1.d144e8p-5f)),
        placed_hull({{-0x1.6ff012p-11f, -0x1.1dcfcp-41f, 1},
                     {0x1.49e56ap-14f, 0x1.370ec8p-41f, 0x1.ead9d4p-2f},
                     {-0x1.c8043ap-11f, -0x1.a7bb94p-41f, 1},
                     {-0x1.5a1efep-11f, 0x1.49118p-45f, -0x1.a49882p-1f}},
                    {-0x1.653b7d6a2c8e4p-3, -0x1.0e94a0d45fa0fp-2, -0x1.26af8ede73307p-3},
                    turned(-0x1.120644p-1f, -0x1.3ce9d6p-4f, -0x1.1e37c6p-1f, 0x1.41d088p-1f)));
}

}  // namespace
}  // namespace carom::test

// The plain simplex against the careful one: where it does not say that rounding decides, both find
// the same, and never less than the distance.
#include "narrowphase/doubles/plain_simplex.h"

#include <gtest/gtest.h>

#include "narrowphase/doubles/gjk.h"
#include "narrowphase/doubles/make_core.h"
#include "oracle/random.h"

namespace carom::test {
namespace {

using oracle::Random;

enum class Form { round, flat, thin };

// Corners about a point: of a simplex that is round, nearly in one plane, or nearly a line that
// passes zero as near as it is thin.
CoreVector draw_corner(Random& random, Form form, const Eigen::Vector3d& at) {
  Eigen::Vector3d p = random.direction() * random.uniform(0.1, 1) + at;
  if (form == Form::flat) p.z() = at.z() + p.z() * 0x1p-30;
  if (form == Form::thin) p = {p.x(), p.y() * 0x1p-25, p.z() * 0x1p-25};
  // Along no axis, so that cross products are rounded.
  const Eigen::AngleAxisd turn(1, Eigen::Vector3d(0.6, 0, 0.8));
  return scalar::core_vector(turn * p);
}

class PlainSimplexes : public testing::TestWithParam<Form> {};

TEST_P(PlainSimplexes, AreAsNearAsTheCarefulOnes) {
  Random random(1);
  size_t clear = 0, around = 0;
  std::array<size_t, 4> of_kept{};
  constexpr size_t kPairs = 40000;
  for (size_t i = 0; i < kPairs; ++i) {
    const Eigen::Vector3d at = random.direction() * random.uniform(0, 0.7);
    // As in a search: the corners span the point that was nearest, and the last one is beyond it.
    NearestPoint::Corners drawn;
    const size_t count = 1 + random.below(3);
    for (size_t k = 0; k < count; ++k) {
      drawn.push_back(draw_corner(random, GetParam(), at));
    }
    const NearestPoint before(drawn);
    NearestPoint::Corners corners = before.corners();
    scalar::PlainSimplex simplex;
    for (size_t k = 0; k < corners.size(); ++k) {
      simplex.corner[k] = corners[k];
      simplex.used |= 1u << k;
    }
    const CoreVector last = draw_corner(random, GetParam(), at);
    if (!(dot(before.point(), last) < before.squared())) continue;
    corners.push_back(last);
    const scalar::PlainNearest plain(simplex, last);
    if (plain.is_unclear && !plain.is_around) continue;
    ++clear;
    const NearestPoint careful(corners);
    ASSERT_EQ(plain.is_around, careful.is_around_zero()) << i;
    around += plain.is_around;
    if (plain.is_around) continue;
    const double distance = std::sqrt(plain.squared), least = std::sqrt(careful.squared());
    ASSERT_GE(distance, least - 0x1p-40) << i;
    // In a sliver rounding may choose another side, which is further away.
    if (GetParam() != Form::thin) {
      ASSERT_LE(distance, least + 0x1p-40) << i;
    }
    size_t kept = 0;
    for (size_t k = 0; k < 3; ++k) kept += plain.kept >> k & 1;
    ++of_kept[kept];
  }
  EXPECT_GT(clear, kPairs / 4);
  EXPECT_GT(of_kept[0], kPairs / 100);
  EXPECT_GT(of_kept[1], kPairs / 100);
  if (GetParam() != Form::round) return;
  EXPECT_GT(of_kept[2], kPairs / 100);
  EXPECT_GT(around, kPairs / 200);
}

INSTANTIATE_TEST_SUITE_P(Forms, PlainSimplexes,
                         testing::Values(Form::round, Form::flat, Form::thin));

}  // namespace
}  // namespace carom::test

// Compounds of cylinders, cones, ellipsoids, rounded boxes and rounded hulls, few and many, equal
// to the reference to the bit. Many parts are left out by their balls, searched by their boxes.
#include <gtest/gtest.h>

#include "tests/support/composites.h"
#include "tests/support/kind_pairs.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

constexpr ShapeKind kRoundParts[] = {ShapeKind::cylinder, ShapeKind::cone, ShapeKind::ellipsoid,
                                     ShapeKind::rounded_box, ShapeKind::rounded_hull};

Compound round_compound(Composites& shapes, size_t count) {
  std::vector<CompoundChild> children(count);
  for (CompoundChild& child : children) {
    oracle::Random& random = shapes.random();
    child.shape =
        shapes.simple(kRoundParts[random.below(std::size(kRoundParts))], random.uniform(0.2, 0.6));
    child.position = (random.direction() * random.uniform(0, 1)).cast<float>();
    child.orientation = shapes.orientation();
  }
  return compound_of(children);
}

TEST(RoundParts, EqualTheReference) {
  for (const size_t count : {1, 3, 8, 20}) {
    SCOPED_TRACE(count);
    Composites shapes(count);
    std::vector<TestPair> pairs;
    size_t overlaps = 0;
    for (const ShapeKind kind : kEveryKind) {
      for (uint32_t i = 0; i < rounds(6, 1); ++i) {
        TestPair pair = shapes.pair(ShapeKind::compound, kind, PositionType::float64, 1, 10);
        pair.a.shape = round_compound(shapes, count);
        if (kind == ShapeKind::compound) pair.b.shape = round_compound(shapes, count);
        std::vector<TestPair> one = {pair};
        round_some(one, i);
        pair = one[0];
        overlaps += reference_result(pair, PositionType::float64).overlap;
        pairs.push_back(pair);
      }
    }
    EXPECT_GT(overlaps, pairs.size() / 5);
    EXPECT_LT(overlaps, pairs.size() * 4 / 5);
    for (const Detail detail : {Detail::overlap, Detail::contact, Detail::manifold}) {
      Call call = call_with(PositionType::float64);
      call.detail = detail;
      expect_reference(pairs, call);
    }
  }
}

}  // namespace
}  // namespace carom::test

// Directions remembered from test to test: they save work and change no result.
#include <gtest/gtest.h>

#include <algorithm>

#include "midphase/collide_pairs.h"
#include "tests/support/composites.h"
#include "tests/support/isas.h"
#include "tests/support/kind_pairs.h"
#include "tests/support/rounds.h"
#include "tests/support/run.h"

namespace carom::test {
namespace {

std::vector<KindPair> kinds_with_directions() {
  std::vector<KindPair> all;
  for (const KindPair& kinds : supported_kind_pairs()) {
    if (uses_directions(kinds.a, kinds.b)) all.push_back(kinds);
  }
  return all;
}

// All first bodies, then all second ones: pair i is (i, count + i).
std::vector<PlacedShape> all_bodies(std::span<const TestPair> pairs) {
  std::vector<PlacedShape> bodies = side_a(pairs);
  const std::vector<PlacedShape> seconds = side_b(pairs);
  bodies.insert(bodies.end(), seconds.begin(), seconds.end());
  return bodies;
}

LaidOut laid_out(std::span<const TestPair> pairs, PositionType positions) {
  return {all_bodies(pairs), call_with(positions).layout_a};
}

std::vector<Row> run(const LaidOut& bodies, Detail detail, uint32_t* direction,
                     bool has_composites = false) {
  const auto count = static_cast<uint32_t>(bodies.view().count / 2);
  std::vector<Pair> list(count);
  for (uint32_t i = 0; i < count; ++i) list[i] = {i, count + i};
  Columns columns(count, 0);
  const Collidables view = bodies.view();
  collide_pairs(
      {.bodies = view, .pairs = list, .has_composites = has_composites, .direction = direction},
      detail, columns.out(), {.frame = WitnessFrame::body, .measured = Measured::overlapping});
  return columns.rows();
}

// For separate pairs only the decision counts.
void expect_same(const std::vector<Row>& expected, const std::vector<Row>& rows) {
  ASSERT_EQ(expected.size(), rows.size());
  for (size_t i = 0; i < rows.size(); ++i) {
    ASSERT_EQ(expected[i].overlap, rows[i].overlap) << "pair " << i;
    ASSERT_EQ(expected[i].status, rows[i].status) << "pair " << i;
    ASSERT_TRUE(!rows[i].overlap || same_bits(expected[i], rows[i])) << "pair " << i;
  }
}

// Every body moved and turned a little.
std::vector<TestPair> moved(std::vector<TestPair> pairs, Random& random) {
  for (TestPair& pair : pairs) {
    const double size = 1e-3 * (pair.a.position - pair.b.position).norm();
    for (int axis = 0; axis < 3; ++axis) pair.a.position[axis] += random.uniform(-size, size);
    for (int i = 0; i < 4; ++i) {
      pair.a.orientation.coeffs()[i] += static_cast<float>(random.uniform(-1e-3, 1e-3));
    }
  }
  return pairs;
}

class Direction : public testing::TestWithParam<ConvexFamily> {};

TEST_P(Direction, ChangesNoResult) {
  for (const KindPair& kinds : kinds_with_directions()) {
    for (const PositionType positions : kPositionTypes) {
      SCOPED_TRACE(name(kinds) + ", " + name(positions));
      std::vector<TestPair> pairs =
          make_kind_pairs(GetParam(), kinds, positions, rounds_of_pairs(70));
      vary_triangles(pairs);
      Random random(7);
      const LaidOut before = laid_out(pairs, positions);
      const LaidOut next = laid_out(moved(pairs, random), positions);
      for (const Detail detail : {Detail::overlap, Detail::contact, Detail::manifold}) {
        for_each_isa([&] {
          std::vector<uint32_t> direction(pairs.size(), kNoDirection);
          expect_same(run(before, detail, nullptr), run(before, detail, direction.data()));
          const std::vector<Row> cold = run(next, detail, nullptr);
          expect_same(cold, run(next, detail, direction.data()));
          for (uint32_t& any : direction) any = static_cast<uint32_t>(random.bits());
          expect_same(cold, run(next, detail, direction.data()));
        });
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Families, Direction, testing::ValuesIn(convex_families()), family_name);

TEST(Direction, OfAnyInputChangesNoResult) {
  Random random(3);
  for (const KindPair& kinds : kinds_with_directions()) {
    SCOPED_TRACE(name(kinds));
    const std::vector<TestPair> pairs = make_kind_nonsense(kinds, rounds(1500));
    std::vector<uint32_t> direction(pairs.size());
    for (uint32_t& any : direction) any = static_cast<uint32_t>(random.bits());
    const LaidOut bodies = laid_out(pairs, PositionType::float32);
    expect_same(run(bodies, Detail::contact, nullptr),
                run(bodies, Detail::contact, direction.data()));
  }
}

// Separate pairs that move a little stay separate along the remembered direction, so they keep it.
TEST(Direction, IsKeptWhilePairsAreApart) {
  const ConvexFamily family = convex_families()[0];
  for (const KindPair& kinds : kinds_with_directions()) {
    SCOPED_TRACE(name(kinds));
    const PositionType positions = PositionType::float32;
    const std::vector<TestPair> pairs = make_kind_pairs(family, kinds, positions, rounds(500, 100));
    std::vector<uint32_t> direction(pairs.size(), kNoDirection);
    const std::vector<Row> rows =
        run(laid_out(pairs, positions), Detail::contact, direction.data());
    const std::vector<uint32_t> first = direction;
    Random random(1);
    run(laid_out(moved(pairs, random), positions), Detail::contact, direction.data());
    size_t separate = 0, known = 0, kept = 0;
    for (size_t i = 0; i < rows.size(); ++i) {
      EXPECT_TRUE(!rows[i].overlap || first[i] == kNoDirection);
      separate += !rows[i].overlap;
      known += first[i] != kNoDirection;
      kept += first[i] != kNoDirection && first[i] == direction[i];
    }
    EXPECT_EQ(known, separate);
    EXPECT_GT(kept, separate * 6 / 10);
  }
}

// Where few pairs are settled by their directions all are tested, where many are the others alone.
// Neither changes a result, nor the directions of pairs that are settled.
TEST(Direction, ChangesNoResultHoweverManyKnowTheirs) {
  const ConvexFamily family = convex_families()[0];
  for (const KindPair& kinds : kinds_with_directions()) {
    SCOPED_TRACE(name(kinds));
    const PositionType positions = PositionType::float32;
    const std::vector<TestPair> pairs = make_kind_pairs(family, kinds, positions, 200);
    const LaidOut bodies = laid_out(pairs, positions);
    std::vector<uint32_t> found(pairs.size(), kNoDirection);
    const std::vector<Row> cold = run(bodies, Detail::manifold, nullptr);
    run(bodies, Detail::manifold, found.data());
    EXPECT_GT(pairs.size() - static_cast<size_t>(std::ranges::count(found, kNoDirection)), 60u);
    for (const size_t known :
         {size_t{0}, size_t{1}, pairs.size() / 4, pairs.size() / 2, pairs.size()}) {
      std::vector<uint32_t> direction(pairs.size(), kNoDirection);
      std::copy_n(found.begin(), known, direction.begin());
      expect_same(cold, run(bodies, Detail::manifold, direction.data()));
      EXPECT_EQ(direction, found);
    }
  }
}

TEST(Direction, IsPackedToATenthOfADegree) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    Eigen::Vector3f n;
    for (int axis = 0; axis < 3; ++axis) n[axis] = static_cast<float>(random.uniform(-1, 1));
    n.normalize();
    const uint32_t packed = pack_direction({n.x(), n.y(), n.z()});
    ASSERT_NE(packed, kNoDirection);
    for (int axis = 0; axis < 3; ++axis) {
      const auto steps = static_cast<float>(packed >> 10 * axis & 0x3ff);
      EXPECT_NEAR((steps - kDirectionZero) / kDirectionSteps, n[axis], 0.0011f);
    }
  }
  EXPECT_EQ(pack_direction({0, 0, 0}), kNoDirection);
  EXPECT_EQ(pack_direction({NAN, 0, 1}), kNoDirection);
  EXPECT_EQ(pack_direction({INFINITY, 0, 0}), kNoDirection);
  EXPECT_EQ(pack_direction({1e30f, 0, 0}), kNoDirection);
}

// A word may say where a shell is in the list of the last step. It is good for one step: a pair
// that kept it while it had other shapes would later take whatever is there then.
TEST(Directions, OfShellsDoNotStay) {
  for (const KindPair& kinds : supported_kind_pairs()) {
    SCOPED_TRACE(name(kinds));
    const std::vector<TestPair> pairs = make_pairs_of_families(kinds, PositionType::float32);
    std::vector<uint32_t> words(pairs.size(), kHasShell | 3);
    run(laid_out(pairs, PositionType::float32), Detail::contact, words.data());
    for (const uint32_t word : words) EXPECT_LT(word, kOverlapped);
  }
  Composites composites(3);
  std::vector<TestPair> pairs;
  for (const ShapeKind kind : {ShapeKind::mesh, ShapeKind::compound, ShapeKind::hull}) {
    pairs.push_back(composites.pair(ShapeKind::compound, kind, PositionType::float32, 1, 0.5));
    pairs.push_back(composites.pair(ShapeKind::hull, ShapeKind::hull, PositionType::float32, 1, 0));
  }
  std::vector<uint32_t> words(pairs.size(), kHasShell | 3);
  run(laid_out(pairs, PositionType::float32), Detail::contact, words.data(), true);
  for (const uint32_t word : words) EXPECT_LT(word, kOverlapped);
}

}  // namespace
}  // namespace carom::test

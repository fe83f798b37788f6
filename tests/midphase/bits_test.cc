// Meshes and compounds against every kind, on every ISA, equal to the reference to the bit.
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "tests/support/composites.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

using Kinds = std::array<ShapeKind, 2>;

class CompositeKinds : public testing::TestWithParam<Kinds> {};

std::vector<TestPair> make_pairs(const Kinds& kinds, PositionType positions, size_t count,
                                 double size = 1, double distance = 10, uint64_t seed = 1) {
  Composites composites(seed);
  std::vector<TestPair> pairs;
  for (size_t i = 0; i < count; ++i) {
    pairs.push_back(composites.pair(kinds[0], kinds[1], positions, size, distance));
  }
  return pairs;
}

TEST_P(CompositeKinds, EqualReference) {
  for (const PositionType positions : kPositionTypes) {
    SCOPED_TRACE(name(positions));
    const std::vector<TestPair> pairs = make_pairs(GetParam(), positions, rounds(16));
    for (const Detail detail : {Detail::overlap, Detail::contact, Detail::manifold}) {
      for (const WitnessFrame frame : {WitnessFrame::body, WitnessFrame::world}) {
        SCOPED_TRACE(static_cast<int>(detail));
        Call call = call_with(positions);
        call.detail = detail;
        call.frame = frame;
        expect_reference(pairs, call);
      }
    }
  }
}

TEST_P(CompositeKinds, EqualReferenceAtAllSizesAndDistances) {
  for (const double size : {1e-30, 1e-3, 1e6, 1e18}) {
    for (const double distance : {0.0, 1e4}) {
      SCOPED_TRACE(size);
      for (const Detail detail : {Detail::contact, Detail::manifold}) {
        Call call = call_with(PositionType::float64);
        call.detail = detail;
        expect_reference(
            make_pairs(GetParam(), PositionType::float64, rounds(8), size, distance * size, 2),
            call);
      }
    }
  }
}

std::string kinds_name(const testing::TestParamInfo<Kinds>& info) {
  return std::string(name(info.param[0])) + "_" + name(info.param[1]);
}

std::vector<TestPair> make_mixed_pairs(size_t count, PositionType positions, uint64_t seed = 3) {
  Composites composites(seed);
  std::vector<TestPair> pairs;
  while (pairs.size() < count) {
    const ShapeKind a = kEveryKind[composites.random().below(8)];  // no half-spaces on this side
    const ShapeKind b = kEveryKind[composites.random().below(std::size(kEveryKind))];
    if (a == ShapeKind::dop || b == ShapeKind::dop) continue;  // k-DOPs are slow
    pairs.push_back(composites.pair(a, b, positions, 1, 5));
  }
  return pairs;
}

// Sums and differences of coordinates overflow.
TEST(CompositeBits, AtTheEndOfDoublePrecision) {
  const Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const Capsule capsule{{0, 0, 0}, {1, 0, 0}, 1};
  std::vector<TestPair> pairs;
  for (const Shape& shape : {Shape(Sphere{1}), Shape(capsule), Shape(mesh)}) {
    for (const double y : {8.9e307, 9e307, 1e308, -9e307}) {
      for (const double other : {0.0, y, -y}) {
        TestPair pair;
        pair.a = {shape, {0, y, 0}};
        pair.b = {mesh, {0, other, 0}};
        pairs.push_back(pair);
        std::swap(pair.a, pair.b);
        pairs.push_back(pair);
      }
    }
  }
  Call call = call_with(PositionType::float64);
  call.detail = Detail::manifold;
  expect_reference(pairs, call);
}

// Parts of compounds that have many wait until it is known how deep another pair of them is.
TEST(CompositeBits, CompoundsOfManyChildren) {
  size_t overlaps = 0, all = 0;
  for (const PositionType positions : kPositionTypes) {
    Composites composites(5);
    std::vector<TestPair> pairs;
    for (size_t i = 0; i < rounds(120, 30); ++i) {
      const size_t counts[] = {7, 8, 9, 20};
      TestPair pair;
      pair.a.shape = composites.compound_of_many(1, counts[i % 4]);
      pair.b.shape = composites.compound_of_many(1, counts[i / 4 % 4]);
      pair.b.position = composites.random().uniform(0.3, 4) * composites.random().direction();
      pair.b.orientation = composites.orientation();
      pairs.push_back(pair);
    }
    for (const Detail detail : {Detail::overlap, Detail::contact, Detail::manifold}) {
      Call call = call_with(positions);
      call.detail = detail;
      expect_reference(pairs, call);
    }
    for (const Row& row : run_rows(pairs, call_with(positions))) overlaps += row.overlap;
    all += pairs.size();
  }
  EXPECT_GT(10 * overlaps, 2 * all);
  EXPECT_LT(10 * overlaps, 8 * all);
}

TEST(CompositeBits, SimplePairsAmongThem) {
  for (const PositionType positions : kPositionTypes) {
    const std::vector<TestPair> pairs = make_mixed_pairs(rounds(400), positions);
    for (const Detail detail : {Detail::overlap, Detail::manifold}) {
      Call call = call_with(positions);
      call.detail = detail;
      expect_reference(pairs, call);
    }
  }
}

std::vector<TestPair> repeated(const std::vector<TestPair>& some, size_t count) {
  std::vector<TestPair> pairs;
  while (pairs.size() < count) pairs.push_back(some[pairs.size() % some.size()]);
  return pairs;
}

// Blocks fill up with parts before they fill up with pairs.
TEST(CompositeBits, ManyPairsAndThreads) {
  const std::vector<TestPair> some = make_mixed_pairs(97, PositionType::float32);
  const std::vector<TestPair> pairs = repeated(some, 2500);
  Call call;
  call.detail = Detail::manifold;
  std::vector<Row> expected = expected_rows(some, PositionType::float32, call.detail);
  for (size_t i = expected.size(); i < pairs.size(); ++i) {
    expected.push_back(expected[i % some.size()]);
  }
  call.parallelism = Parallelism::arena;
  for (const int threads : {1, 2}) {
    tbb::task_arena arena(threads);
    arena.execute([&] { EXPECT_TRUE(same_rows(expected, run_list(pairs, call), pairs)); });
  }
}

// With Measured::overlapping all decisions stay the same, and so do the contacts of overlapping
// pairs.
TEST(CompositeBits, DecidedPairsHaveTheSameContacts) {
  const std::vector<TestPair> pairs = make_mixed_pairs(rounds(300), PositionType::float32, 4);
  Call call;
  call.detail = Detail::manifold;
  const std::vector<Row> expected = expected_rows(pairs, PositionType::float32, call.detail);
  call.measured = Measured::overlapping;
  for_each_isa([&] {
    const std::vector<Row> rows = run_rows(pairs, call);
    for (size_t i = 0; i < rows.size(); ++i) {
      if (expected[i].overlap || expected[i].status == 3) {
        EXPECT_TRUE(same_rows({&expected[i], 1}, {&rows[i], 1}, {&pairs[i], 1}));
      }
      EXPECT_EQ(rows[i].overlap, expected[i].overlap);
      EXPECT_EQ(rows[i].status, expected[i].status);
      EXPECT_EQ(rows[i].manifold_count, expected[i].manifold_count);
    }
  });
}

TEST(CompositeBits, LayoutsAndColumnsLeftOut) {
  const std::vector<TestPair> pairs = make_mixed_pairs(60, PositionType::float32, 5);
  Call call;
  call.detail = Detail::manifold;
  const std::vector<Row> complete = expected_rows(pairs, PositionType::float32, call.detail);
  for (unsigned missing = 0; missing < 1u << Columns::kColumns; missing += 1021) {
    std::vector<Row> expected = complete;
    for (Row& row : expected) forget_columns(row, missing);
    call.missing = missing;
    EXPECT_TRUE(same_rows(expected, run_rows(pairs, call), pairs));
  }
  call.missing = 0;
  for (const RowOrder order : {RowOrder::backwards, RowOrder::shared}) {
    call.layout_a.rows = call.layout_b.rows = order;
    call.layout_a.box_slots = true;
    call.layout_b.radius = RadiusLayout::column;
    EXPECT_TRUE(same_rows(complete, run_rows(pairs, call), pairs));
  }
}

// Both proven tiers agree with the standard tier where that is sure, and are exact everywhere else.
TEST(CompositeBits, ProvenTiersAgree) {
  std::vector<TestPair> pairs = make_mixed_pairs(rounds(150), PositionType::float32, 6);
  std::erase_if(pairs, [](const TestPair& pair) {
    return !is_decided_exactly(pair.a.shape) || !is_decided_exactly(pair.b.shape);
  });
  Call call;
  const std::vector<Row> standard = run_rows(pairs, call);
  for (const Tier tier : {Tier::certified, Tier::exact}) {
    call.accuracy.tier = tier;
    const std::vector<Row> proven = run_rows(pairs, call);
    for (size_t i = 0; i < pairs.size(); ++i) {
      EXPECT_TRUE(tier == Tier::certified || proven[i].overlap != kUndecided);
      if (std::fabs(standard[i].separation) < 1e-5f) continue;
      EXPECT_EQ(proven[i].overlap, standard[i].overlap) << show(pairs[i]);
      EXPECT_EQ(proven[i].separation, standard[i].separation) << show(pairs[i]);
    }
  }
}

TEST(CompositeBits, BoundsOfSeparationsHold) {
  const std::vector<TestPair> pairs = make_mixed_pairs(rounds(150), PositionType::float64, 8);
  const LaidOut a(side_a(pairs), call_with(PositionType::float64).layout_a);
  const LaidOut b(side_b(pairs), call_with(PositionType::float64).layout_b);
  for (const Detail detail : {Detail::overlap, Detail::contact}) {
    Columns columns(pairs.size());
    ResultColumns out = columns.out();
    std::vector<float> bounds(pairs.size(), -1);
    out.separation_bound = bounds.data();
    ASSERT_TRUE(collide_rows(a.view(), b.view(), detail, out));
    for (size_t i = 0; i < pairs.size(); ++i) {
      const bool has_parts = std::isfinite(
          expected_row(pairs[i], PositionType::float64, Detail::contact, WitnessFrame::body)
              .separation);
      EXPECT_GE(bounds[i], has_parts ? 1e-12f : 0);
      EXPECT_LT(bounds[i], 1e-3f);
    }
  }
}

TEST(CompositeBits, DoNotDependOnTheFloatModeOfTheCaller) {
  const std::vector<TestPair> pairs = make_mixed_pairs(40, PositionType::float32, 9);
  Call call;
  call.detail = Detail::manifold;
  const std::vector<Row> expected = expected_rows(pairs, PositionType::float32, call.detail);
  for (const FloatMode& mode : float_modes()) {
    call.mode = mode;
    EXPECT_TRUE(same_rows(expected, run_rows(pairs, call), pairs));
  }
}

INSTANTIATE_TEST_SUITE_P(Each, CompositeKinds, testing::ValuesIn(composite_kind_pairs()),
                         kinds_name);

}  // namespace
}  // namespace carom::test

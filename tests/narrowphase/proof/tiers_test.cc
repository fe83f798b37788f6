// The tiers of collide(): their promises, on every instruction set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "narrowphase/proof/exact_overlap.h"
#include "tests/support/isas.h"
#include "tests/support/kind_checks.h"
#include "tests/support/kind_pairs.h"
#include "tests/support/rounds.h"
#include "tests/support/run.h"
#include "tests/support/stated.h"

namespace carom::test {
namespace {

Call call_of(Tier tier, PositionType positions, Detail detail) {
  Call call = call_with(positions);
  call.detail = detail;
  call.accuracy.tier = tier;
  return call;
}

StatedBody stated_body(const PlacedShape& body, PositionType positions) {
  return test::stated_body(body.shape, {stored(body.position, positions), body.orientation});
}

bool exact(const TestPair& pair, PositionType positions) {
  return exact_overlap(stated_body(pair.a, positions), stated_body(pair.b, positions));
}

std::vector<bool> all_exact(std::span<const TestPair> pairs, PositionType positions) {
  std::vector<bool> overlaps;
  for (const TestPair& pair : pairs) overlaps.push_back(exact(pair, positions));
  return overlaps;
}

// Every kind with every other and the families in turn, so that blocks hold all of them.
class Tiers : public testing::TestWithParam<ConvexFamily> {
 protected:
  static std::vector<TestPair> pairs(PositionType positions) {
    return make_mixed_kind_pairs(GetParam(), positions, rounds(1200), 7, solved_kind_pairs());
  }
};

TEST_P(Tiers, ExactIsAlwaysRight) {
  for (const PositionType positions : kPositionTypes) {
    const std::vector<TestPair> some = pairs(positions);
    const std::vector<bool> overlaps = all_exact(some, positions);
    for (const Detail detail : {Detail::overlap, Detail::manifold}) {
      for_each_isa([&] {
        const std::vector<Row> rows = run_rows(some, call_of(Tier::exact, positions, detail));
        for (size_t i = 0; i < some.size(); ++i) {
          const ShownIfFailed shown([&] { return show(some[i]) + "\n" + show(rows[i]); });
          ASSERT_EQ(rows[i].overlap, overlaps[i]);
          if (detail == Detail::overlap) continue;
          ASSERT_EQ(rows[i].separation <= 0, rows[i].overlap == 1);
          ASSERT_EQ(rows[i].manifold_count > 0, rows[i].overlap == 1);
        }
      });
    }
  }
}

TEST_P(Tiers, CertifiedIsNeverWrong) {
  for (const PositionType positions : kPositionTypes) {
    const std::vector<TestPair> some = pairs(positions);
    const std::vector<bool> overlaps = all_exact(some, positions);
    for (const Detail detail : {Detail::overlap, Detail::manifold}) {
      const std::vector<Row> rows = run_rows(some, call_of(Tier::certified, positions, detail));
      size_t undecided = 0;
      for (size_t i = 0; i < some.size(); ++i) {
        undecided += rows[i].overlap == kUndecided;
        if (rows[i].overlap == kUndecided) {
          EXPECT_TRUE(detail == Detail::overlap || rows[i].manifold_count == 0);
          continue;
        }
        ASSERT_EQ(rows[i].overlap, overlaps[i]) << show(some[i]);
      }
      EXPECT_TRUE(undecided == 0 || GetParam().name != std::string("plain"));
    }
  }
}

// Apart from decisions and the signs that follow from them, certified results are the standard
// ones.
TEST_P(Tiers, CertifiedChangesNothingElse) {
  const PositionType positions = PositionType::float32;
  const std::vector<TestPair> some = pairs(positions);
  const auto standard = run_rows(some, call_of(Tier::standard, positions, Detail::contact));
  const auto certified = run_rows(some, call_of(Tier::certified, positions, Detail::contact));
  for (size_t i = 0; i < some.size(); ++i) {
    Row row = certified[i];
    const bool agrees = row.overlap == standard[i].overlap;
    if (row.overlap == kUndecided) row.overlap = standard[i].overlap;
    EXPECT_TRUE(!agrees || same_bits(row, standard[i])) << show(some[i]);
    if (agrees) continue;
    row.overlap = standard[i].overlap;
    row.separation = standard[i].separation;
    EXPECT_TRUE(same_bits(row, standard[i])) << show(some[i]);
  }
}

// Separations are within the forward bound that callers may ask for.
TEST_P(Tiers, SeparationsAreWithinTheirBounds) {
  for (const PositionType positions : kPositionTypes) {
    const std::vector<TestPair> some =
        make_mixed_kind_pairs(GetParam(), positions, rounds(600), 11, solved_kind_pairs());
    Call call = call_with(positions);
    const LaidOut laid_a(side_a(some), call.layout_a), laid_b(side_b(some), call.layout_b);
    Columns columns(some.size());
    std::vector<float> bound(some.size(), -1);
    ResultColumns out = columns.out();
    out.separation_bound = bound.data();
    ASSERT_TRUE(collide_rows(laid_a.view(), laid_b.view(), Detail::contact, out));
    for (size_t i = 0; i < some.size(); ++i) {
      const ShownIfFailed shown([&] { return show(some[i]); });
      const ExactKinds exact(some[i], positions);
      const long double off = std::fabs(columns.row(i).separation - exact.answer.value);
      EXPECT_LE(off, bound[i] + exact.gap * 0x1p-22L);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Families, Tiers, testing::ValuesIn(convex_families()), family_name);

// Every tier has the same bits on every instruction set, for any number of pairs, in any order.
TEST(Tiers, AreTheSameOnEveryInstructionSet) {
  for (const Tier tier : {Tier::certified, Tier::exact, Tier::fast}) {
    const Accuracy accuracy{.tier = tier};
    for (const PositionType positions : kPositionTypes) {
      const auto pairs = make_mixed_kind_pairs(
          {.name = "touch", .distance = 0, .placement = ConvexPlacement::near_touch}, positions,
          300, 5, solved_kind_pairs());
      Call call = call_with(positions);
      call.detail = Detail::manifold;
      call.accuracy = accuracy;
      const std::vector<Row> all = run_rows(pairs, call);
      for_each_isa([&] {
        EXPECT_TRUE(same_rows(all, run_rows(pairs, call), pairs));
        EXPECT_TRUE(same_rows(all, run_list(pairs, call), pairs));
        for (const size_t count : {0, 1, 7, 8, 9, 15, 16, 17}) {
          const std::span<const TestPair> some(pairs.data(), count);
          EXPECT_TRUE(same_rows({all.data(), count}, run_rows(some, call), some));
        }
      });
    }
  }
}

TEST(Tiers, BoundsAndOverlapsDoNotNeedTheOtherColumns) {
  const auto pairs =
      make_mixed_kind_pairs({.name = "plain"}, PositionType::float32, 100, 2, solved_kind_pairs());
  const LaidOut a(side_a(pairs), {}), b(side_b(pairs), {});
  std::vector<float> bound(pairs.size());
  std::vector<uint8_t> overlap(pairs.size());
  ResultColumns out;
  out.overlap = overlap.data();
  out.separation_bound = bound.data();
  ASSERT_TRUE(
      collide_rows(a.view(), b.view(), Detail::overlap, out, {.accuracy = {.tier = Tier::exact}}));
  for (size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_GT(bound[i], 0);
    EXPECT_EQ(overlap[i], exact(pairs[i], PositionType::float32));
  }
}

// An invalid pair must not make the other pairs of its vector unsure.
TEST(Tiers, NeighboursOfInvalidPairsGetWhatTheyAlwaysGet) {
  const float e = 0x1p-13f;
  const PlacedShape a{Aabb{Eigen::Vector3f::Constant(1), Eigen::Vector3f::Constant(1 + 2 * e)}};
  const PlacedShape b{Aabb{Eigen::Vector3f::Constant(1 + e), Eigen::Vector3f::Constant(1 + 4 * e)}};
  std::vector<TestPair> pairs(16, {a, b});
  const Call call = call_of(Tier::certified, PositionType::float32, Detail::contact);
  const std::vector<Row> alone = run_rows(pairs, call);
  std::get<Aabb>(pairs[3].a.shape).lower[0] = std::numeric_limits<float>::quiet_NaN();
  for_each_isa([&] {
    const std::vector<Row> rows = run_rows(pairs, call);
    for (size_t i = 0; i < rows.size(); ++i) {
      if (i == 3) {
        EXPECT_EQ(rows[i].status, static_cast<uint8_t>(Status::invalid));
      } else {
        EXPECT_TRUE(same_bits(rows[i], alone[i])) << show(rows[i]);
      }
    }
  });
}

// Here an intermediate separation overflowed and became NaN.
TEST(Tiers, SignsHoldWhereDistancesOverflow) {
  const double far = 0x1.e42d130773b76p+1023;
  const PlacedShape plane = halfspace({-1, -far, far}, {0, -0x1p-148f, 0}, 0);
  PlacedShape speck =
      triangle({0x1p-149, 0x1p-148, -far},
               {Eigen::Vector3f(-0x1p-148f, -0x1p-149f, 0),
                Eigen::Vector3f(-0x1p-149f, -0x1p-149f, 0), Eigen::Vector3f(0x1p-149f, 0, 0)});
  std::get<Triangle>(speck.shape).thickness = 0x1p-149f;
  const std::vector<TestPair> pairs = {{plane, speck}, {speck, plane}};
  for (const TestPair& pair : pairs) {
    const Row row =
        run_rows({&pair, 1}, call_of(Tier::exact, PositionType::float64, Detail::contact))[0];
    EXPECT_EQ(row.overlap, exact(pair, PositionType::float64));
    EXPECT_EQ(row.separation <= 0, row.overlap == 1);
  }
}

// --- The fast tier ---

// Decisions further than 2^-17 of the size from touching stay right, and so do normals.
TEST(FastTier, ErrsNearTouchAlone) {
  size_t wrong = 0;
  for (const ConvexFamily& family : convex_families()) {
    if (family.smallest < 1e-30) continue;  // floats have fewer digits there
    const auto pairs =
        make_mixed_kind_pairs(family, PositionType::float32, rounds(800), 4, solved_kind_pairs());
    Call call = call_with(PositionType::float32);
    call.accuracy.tier = Tier::fast;
    const std::vector<Row> rows = run_rows(pairs, call);
    for (size_t i = 0; i < pairs.size(); ++i) {
      const ExactKinds exact(pairs[i], PositionType::float32);
      const bool overlap = exact.answer.value <= 0;
      if (rows[i].overlap == overlap) continue;
      ++wrong;
      const auto size = static_cast<double>(exact.scale + length(exact.origin_b));
      EXPECT_LE(exact.gap, 0x1p-16 * size) << show(pairs[i]);
    }
  }
  EXPECT_GT(wrong, 0u);
}

// Triangles, half-spaces and round shapes are as in the standard tier.
TEST(FastTier, LeavesOtherKindsAlone) {
  auto pairs = make_mixed_kind_pairs(convex_families()[6], PositionType::float32, 2000, 8,
                                     supported_kind_pairs());
  std::erase_if(pairs, [](const TestPair& pair) {
    const auto is_other = [](const PlacedShape& body) {
      const ShapeKind kind = kind_of(body.shape);
      return kind == ShapeKind::triangle || kind == ShapeKind::halfspace || is_round(kind);
    };
    return !is_other(pair.a) && !is_other(pair.b);
  });
  ASSERT_GT(pairs.size(), 100u);
  for (const Detail detail : {Detail::overlap, Detail::contact, Detail::manifold}) {
    const auto standard = run_rows(pairs, call_of(Tier::standard, PositionType::float32, detail));
    const auto fast = run_rows(pairs, call_of(Tier::fast, PositionType::float32, detail));
    EXPECT_TRUE(same_rows(standard, fast, pairs));
  }
}

void expect_never_wrong(const std::vector<TestPair>& pairs) {
  const std::vector<bool> overlaps = all_exact(pairs, PositionType::float32);
  for_each_isa([&] {
    for (const Tier tier : {Tier::certified, Tier::exact}) {
      const auto rows = run_rows(pairs, call_of(tier, PositionType::float32, Detail::contact));
      for (size_t i = 0; i < rows.size(); ++i) {
        if (tier == Tier::certified && rows[i].overlap == kUndecided) continue;
        ASSERT_EQ(rows[i].overlap, overlaps[i]) << show(pairs[i]);
      }
    }
  });
}

// The segment lies beside the edge of the box, at an angle of 2^-24: only the cross product of both
// separates them, which the kernels leave out.
TEST(Tiers, ASegmentNearlyAlongAnEdge) {
  constexpr float kStep = 0x1p-26f, kHalf = 0x1p-10f;
  const Eigen::Vector3f a(-1, kHalf + 2 * kStep, kHalf - kStep);
  const Eigen::Vector3f b(1, kHalf - kStep, kHalf + 2 * kStep);
  const Eigen::Vector3f half(1, kHalf, kHalf);
  Triangle triangle;
  triangle.corners = {a, b, {0, 1, 1}};
  std::vector<TestPair> pairs(4);
  pairs[0].a.shape = pairs[1].a.shape = Capsule{a, b, 0};
  pairs[0].b.shape = pairs[2].a.shape = Box{half};
  pairs[1].b.shape = pairs[3].a.shape = Aabb{-half, half};
  pairs[2].b.shape = pairs[3].b.shape = triangle;
  expect_never_wrong(pairs);
}

// The lines of these segments cross beyond the end of one, at angles of about 2^-25.
TEST(Tiers, SegmentsWhoseLinesCrossBesideThem) {
  Random random(5);
  std::vector<TestPair> pairs;
  for (size_t i = 0; i < rounds(2000); ++i) {
    const double angle = 0x1p-25 * random.uniform(1, 1.3), crossing = random.uniform(1.005, 1.2);
    const auto height = [&](double x) { return static_cast<float>(angle * (crossing - x)); };
    const auto radius = static_cast<float>(height(1) * random.uniform(0.1, 1.2) / 2);
    TestPair pair;
    pair.a.shape = Capsule{{0, 0, 0}, {1, 0, 0}, radius};
    pair.b.shape = Capsule{{0, height(0), 0}, {1, height(1), 0}, radius};
    if (random.chance(0.5)) {
      const Eigen::Quaterniond turn(Eigen::AngleAxisd(random.uniform(0, 3), random.direction()));
      pair.a.orientation = pair.b.orientation = turn.cast<float>();
    }
    pairs.push_back(pair);
  }
  expect_never_wrong(pairs);
}

// Products with so small a turn vanish, or round to the least number there is.
TEST(Tiers, BoxesTurnedByTheLeastNumbers) {
  std::vector<TestPair> pairs;
  for (const float z : {1.4e-45f, 1e-44f, 1e-43f, 1e-42f, 1e-41f, 1e-40f, 1e-38f, 1e-30f}) {
    TestPair pair;
    pair.a.shape = Box{{1, 1, 1.2f}};
    pair.b.shape = Box{{1, 1, 0.2f}};
    pair.b.position = {0, 0, 1.3};
    pair.b.orientation = Eigen::Quaternionf(1, 0, 0, z);
    pairs.push_back(pair);
  }
  for_each_isa([&] {
    for (const Tier tier : {Tier::standard, Tier::certified, Tier::exact}) {
      for (const Detail detail : {Detail::overlap, Detail::contact}) {
        const auto rows = run_rows(pairs, call_of(tier, PositionType::float32, detail));
        for (const Row& row : rows) EXPECT_EQ(row.overlap, 1);
      }
    }
  });
}

// Stacks and lattices touch exactly.
TEST(Tiers, BoxesAlongTheAxesAreNeverUndecided) {
  const std::vector<ConvexFamily> all = convex_families();
  const auto is_lattice = [](const ConvexFamily& f) { return f.name == std::string("lattice"); };
  const ConvexFamily family = *std::ranges::find_if(all, is_lattice);
  for (const KindPair kinds :
       {KindPair{ShapeKind::box, ShapeKind::box}, KindPair{ShapeKind::aabb, ShapeKind::box},
        KindPair{ShapeKind::box, ShapeKind::aabb}, KindPair{ShapeKind::aabb, ShapeKind::aabb}}) {
    const auto pairs = make_kind_pairs(family, kinds, PositionType::float32, rounds(1000), 9);
    const std::vector<bool> overlaps = all_exact(pairs, PositionType::float32);
    const auto rows =
        run_rows(pairs, call_of(Tier::certified, PositionType::float32, Detail::contact));
    size_t touching = 0;
    for (size_t i = 0; i < rows.size(); ++i) {
      ASSERT_EQ(rows[i].overlap, overlaps[i]) << show(pairs[i]);
      touching += rows[i].separation == 0;
    }
    EXPECT_GT(touching, pairs.size() / 20);
  }
}

// x + y <= 7 and x <= y cut this k-DOP at (3.5, 3.5), in units of the least float: its corners
// round to (4, 4), which the sphere overlaps. Floats are too coarse for such k-DOPs, and must not
// prove anything.
TEST(Tiers, CornersOfTheSmallestDops) {
  constexpr float kUnit = std::numeric_limits<float>::denorm_min();
  Dop dop{.kind = DopKind::k18};
  const auto directions = slab_directions(dop.kind);
  for (size_t i = 0; i < directions.size(); ++i) {
    dop.upper[i] = (i < 3 ? 8 : 16) * kUnit;
    dop.lower[i] = -dop.upper[i];
    if (directions[i] == std::array<int8_t, 3>{1, 1, 0}) dop.upper[i] = 7 * kUnit;
    if (directions[i] == std::array<int8_t, 3>{1, -1, 0}) dop.upper[i] = 0;
  }
  std::vector<TestPair> pairs;
  for (const double at : {4.75, 5.0, 7.0}) {
    pairs.push_back({{Sphere{2 * kUnit}, {at * kUnit, at * kUnit, 0}}, {dop, {0, 0, 0}}});
  }
  const std::vector<bool> overlaps = all_exact(pairs, PositionType::float64);
  EXPECT_EQ(overlaps, (std::vector<bool>{true, false, false}));
  for_each_isa([&] {
    for (const Tier tier : {Tier::exact, Tier::certified}) {
      const auto rows = run_rows(pairs, call_of(tier, PositionType::float64, Detail::contact));
      for (size_t i = 0; i < rows.size(); ++i) {
        const bool may_be = tier == Tier::certified && rows[i].overlap == kUndecided;
        EXPECT_TRUE(may_be || rows[i].overlap == overlaps[i]) << i;
      }
    }
  });
}

}  // namespace
}  // namespace carom::test

// Vectors in which any number of lanes cannot be decided in float32, against the reference, which
// computes one pair at a time.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "carom/results/result_arrays.h"
#include "narrowphase/pairs/pair_kinds.h"
#include "narrowphase/proof/exact_overlap.h"
#include "tests/support/isas.h"
#include "tests/support/kind_pairs.h"
#include "tests/support/rounds.h"
#include "tests/support/run.h"
#include "tests/support/stated.h"

namespace carom::test {
namespace {

constexpr size_t kWidest = 16;

ConvexFamily family_named(const std::string& wanted) {
  const std::vector<ConvexFamily> all = convex_families();
  return *std::ranges::find_if(all, [&](const ConvexFamily& f) { return f.name == wanted; });
}

// Kinds whose kernels run in lanes of doubles as well.
std::vector<KindPair> kinds_in_doubles() {
  const auto is_plain = [](ShapeKind kind) {
    return kind == ShapeKind::sphere || kind == ShapeKind::capsule || kind == ShapeKind::aabb ||
           kind == ShapeKind::box || kind == ShapeKind::triangle || kind == ShapeKind::halfspace;
  };
  std::vector<KindPair> all = supported_kind_pairs();
  std::erase_if(all,
                [&](const KindPair& kinds) { return !is_plain(kinds.a) || !is_plain(kinds.b); });
  return all;
}

// Vectors with 0, 1, ... kWidest pairs that touch, at random lanes, and a tail.
std::vector<TestPair> mixed(std::span<const TestPair> touching, std::span<const TestPair> apart,
                            Random& random) {
  std::vector<TestPair> pairs;
  size_t next = 0;
  for (size_t unsure = 0; unsure <= kWidest; ++unsure) {
    std::array<bool, kWidest> touches{};
    std::fill_n(touches.begin(), unsure, true);
    for (size_t i = kWidest; i > 1; --i) std::swap(touches[i - 1], touches[random.below(i)]);
    for (const bool touch : touches) {
      const auto& from = touch ? touching : apart;
      pairs.push_back(from[next++ % from.size()]);
    }
  }
  pairs.insert(pairs.end(), touching.begin(), touching.begin() + 5);
  return pairs;
}

TEST(UnsureLanes, OfAnyNumberAreThoseOfTheReference) {
  Random random(11);
  for (const KindPair& kinds : kinds_in_doubles()) {
    for (const PositionType positions : kPositionTypes) {
      SCOPED_TRACE(name(kinds) + ", " + name(positions));
      const auto draw = [&](const char* family) {
        return make_kind_pairs(family_named(family), kinds, positions, 200);
      };
      const std::vector<TestPair> pairs = mixed(draw("touch"), draw("plain"), random);
      Call call = call_with(positions);
      for (const Detail detail : {Detail::overlap, Detail::contact}) {
        call.detail = detail;
        const std::vector<Row> expected = expected_rows(pairs, positions, detail, call.frame);
        const auto hits = std::ranges::count(expected, uint8_t{1}, &Row::overlap);
        EXPECT_GT(hits, static_cast<ptrdiff_t>(pairs.size() / 5));
        EXPECT_LT(hits, static_cast<ptrdiff_t>(pairs.size() * 9 / 10));
        for_each_isa([&] { EXPECT_TRUE(same_rows(expected, run_rows(pairs, call), pairs)); });
      }
    }
  }
}

// Two of `sure`, then `count` of `touching` with four of `sure` after each.
template <class T>
std::vector<T> spread(const std::vector<T>& touching, const std::vector<T>& sure, size_t count) {
  std::vector<T> all(sure.begin(), sure.begin() + 2);
  for (size_t i = 0; i < count; ++i) {
    all.push_back(touching[i % touching.size()]);
    for (size_t k = 0; k < 4; ++k) all.push_back(sure[(4 * i + k) % sure.size()]);
  }
  return all;
}

// Where few lanes of a vector are unsure, those of a whole batch are computed together.
constexpr size_t kSpreadCounts[] = {0, 1, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 32, 33, 230};

TEST(UnsureLanes, SpreadOverABatchAreThoseOfTheReference) {
  for (const KindPair& kinds : kinds_in_doubles()) {
    for (const PositionType positions : kPositionTypes) {
      SCOPED_TRACE(name(kinds) + ", " + name(positions));
      const auto draw = [&](const char* family, size_t count) {
        return make_kind_pairs(family_named(family), kinds, positions, count);
      };
      const std::vector<TestPair> touching = draw("touch", 40), sure = draw("plain", 9);
      Call call = call_with(positions);
      for (const Detail detail : {Detail::overlap, Detail::contact}) {
        call.detail = detail;
        const std::vector<Row> of_touching = expected_rows(touching, positions, detail, call.frame);
        const std::vector<Row> of_sure = expected_rows(sure, positions, detail, call.frame);
        for (const size_t count : kSpreadCounts) {
          SCOPED_TRACE(count);
          const std::vector<TestPair> pairs = spread(touching, sure, count);
          const std::vector<Row> expected = spread(of_touching, of_sure, count);
          for_each_isa([&] { EXPECT_TRUE(same_rows(expected, run_rows(pairs, call), pairs)); });
        }
      }
    }
  }
}

// Rows of hulls that float32 cannot decide are gathered, up to CoreRows::kMost at a time.
TEST(UnsureLanes, OfHullsInAnyNumberAreThoseOfTheReference) {
  for (const KindPair& kinds : supported_kind_pairs()) {
    if (kinds.a != ShapeKind::hull && kinds.b != ShapeKind::hull) continue;
    SCOPED_TRACE(name(kinds));
    const PositionType positions = PositionType::float32;
    const auto draw = [&](const char* family, size_t count) {
      return make_kind_pairs(family_named(family), kinds, positions, count);
    };
    const std::vector<TestPair> touching = draw("touch", 130), apart = draw("plain", 3);
    Call call = call_with(positions);
    for (const size_t count : {0, 1, 7, 8, 9, 63, 64, 65, 130}) {
      std::vector<TestPair> pairs = apart;
      pairs.insert(pairs.end(), touching.begin(), touching.begin() + static_cast<ptrdiff_t>(count));
      for (const Detail detail : {Detail::overlap, Detail::contact}) {
        call.detail = detail;
        const std::vector<Row> expected = expected_rows(pairs, positions, detail, call.frame);
        for_each_isa([&] { EXPECT_TRUE(same_rows(expected, run_rows(pairs, call), pairs)); });
      }
    }
  }
}

BatchSide side_of(const LaidOut& bodies) {
  const Collidables& view = bodies.view();
  return {view.position.data, view.position.stride, view.boxes,
          view.box_slot,      view.orientation,     view.rows,
          view.dops};
}

// The marks in Batch::unsure of pairs (i, i), and their decisions.
void run_marking(const KindPair& kinds, std::span<const TestPair> pairs, Detail detail,
                 std::vector<uint8_t>& unsure, ResultArrays& results) {
  const Call call = call_with(PositionType::float32);
  const LaidOut a(side_a(pairs), call.layout_a), b(side_b(pairs), call.layout_b);
  std::vector<Pair> list;
  for (uint32_t i = 0; i < pairs.size(); ++i) list.push_back({i, i});
  list.resize(list.size() + kMostLanes);
  unsure.assign(pairs.size(), 0);
  Batch batch;
  batch.a = side_of(a);
  batch.b = side_of(b);
  batch.pairs = list.data();
  batch.count = pairs.size();
  batch.detail = detail;
  batch.unsure = unsure.data();
  batch.out = results.columns();
  const PairKindRef kind = find_pair_kind(kinds.a, kinds.b);
  if (kind.flipped) std::swap(batch.a, batch.b);
  kPairKinds[kind.index].run(batch);
}

bool exact(const TestPair& pair) {
  const auto stated = [](const PlacedShape& body) {
    return stated_body(body.shape,
                       {stored(body.position, PositionType::float32), body.orientation});
  };
  return exact_overlap(stated(pair.a), stated(pair.b));
}

// For the scalar form: it has no lanes.
bool is_special(const PlacedShape& body) {
  const auto* triangle = std::get_if<Triangle>(&body.shape);
  return triangle &&
         (triangle->thickness != 0 || triangle->one_sided || triangle->inner_edges != 0);
}

// Hardly any pair that touches to within the rounding of positions is left to the proofs one pair
// at a time; and what is not left to them is right. Boxes along the axes have no lanes of doubles.
TEST(UnsureLanes, AreProven) {
  for (const KindPair& kinds : kinds_in_doubles()) {
    if (kinds.a == ShapeKind::aabb && kinds.b == ShapeKind::aabb) continue;
    SCOPED_TRACE(name(kinds));
    std::vector<TestPair> pairs =
        make_kind_pairs(family_named("touch"), kinds, PositionType::float32, 400);
    std::erase_if(pairs,
                  [](const TestPair& pair) { return is_special(pair.a) || is_special(pair.b); });
    ASSERT_GT(pairs.size(), 150u);
    for (const Detail detail : {Detail::overlap, Detail::contact}) {
      for_each_isa([&] {
        std::vector<uint8_t> unsure;
        ResultArrays results(pairs.size(), Detail::contact);
        run_marking(kinds, pairs, detail, unsure, results);
        EXPECT_LE(std::ranges::count(unsure, 1), std::ssize(pairs) / 50);
        for (size_t i = 0; i < pairs.size(); ++i) {
          if (unsure[i] != 0) continue;
          ASSERT_EQ(results.columns().overlap[i] != 0, exact(pairs[i])) << show(pairs[i]);
        }
      });
    }
  }
}

// A row has the same mark, whatever rows are computed with it, and whatever the number of rows.
TEST(UnsureLanes, SpreadOverABatchAreMarkedAsAlone) {
  for (const KindPair& kinds : kinds_in_doubles()) {
    if (kinds.b != ShapeKind::box || kinds.a == ShapeKind::sphere) continue;
    SCOPED_TRACE(name(kinds));
    const auto draw = [&](const char* family, size_t count) {
      return make_kind_pairs(family_named(family), kinds, PositionType::float32, count);
    };
    const std::vector<TestPair> touching = draw("touch", 400), sure = draw("plain", 9);
    for (const Detail detail : {Detail::overlap, Detail::contact}) {
      for_each_isa([&] {
        ResultArrays results(5 * touching.size() + 2, Detail::contact);
        const auto marks_alone = [&](const std::vector<TestPair>& pairs) {
          std::vector<uint8_t> marks, mark;
          for (const TestPair& pair : pairs) {
            run_marking(kinds, {&pair, 1}, detail, mark, results);
            marks.push_back(mark[0]);
          }
          return marks;
        };
        const std::vector<uint8_t> of_touching = marks_alone(touching);
        for (const size_t count : {size_t{3}, size_t{150}, touching.size()}) {
          std::vector<uint8_t> together;
          run_marking(kinds, spread(touching, sure, count), detail, together, results);
          ASSERT_EQ(together, spread(of_touching, marks_alone(sure), count)) << count;
        }
        EXPECT_LT(std::ranges::count(of_touching, 1), std::ssize(touching) / 2);
      });
    }
  }
}

// In all lanes of vectors, and in one lane in five between simple pairs.
void expect_the_reference(const TestPair& pair, PositionType positions) {
  TestPair simple = pair;
  simple.a.position = {0, 0, 0};
  simple.b.position = {3, 2, 1};
  const std::vector<TestPair> alike(kWidest + 1, pair);
  const Call call = call_with(positions);
  for (const auto& pairs : {alike, spread(alike, {simple, simple}, 9)}) {
    const std::vector<Row> expected = expected_rows(pairs, positions, call.detail, call.frame);
    for_each_isa([&] { EXPECT_TRUE(same_rows(expected, run_rows(pairs, call), pairs)); });
  }
}

// The scalar form once scaled segments in float32, beyond whose range this one is in the unit of
// the test.
TEST(UnsureLanesCases, WithASegmentFarShorterThanTheBox) {
  constexpr float kShort = 0x1p-25f;
  TestPair pair;
  pair.a.shape = Capsule{{kShort, -kShort, 0}, {-kShort, kShort, 0}, 0};
  pair.a.position = {kShort / 2, kShort / 2, 0};
  pair.b.shape = Box{{0, 0, 0x1p127f}};
  expect_the_reference(pair, PositionType::float32);
  const Row row = expected_rows({&pair, 1}, PositionType::float32)[0];
  EXPECT_EQ(row.overlap, 0);
  EXPECT_NEAR(row.normal[0], -std::numbers::sqrt2_v<float> / 2, 1e-6f);
}

// Of a zero and a negative one, the scalar form once took the other one.
TEST(UnsureLanesCases, WithZerosOfBothSigns) {
  TestPair pair;
  pair.a.shape = Capsule{{-0.0f, -0.0f, -0.0f}, {-0.0f, -0.0f, -0.0f}, 0};
  pair.b.shape = Box{{1, 1, 0}};
  expect_the_reference(pair, PositionType::float32);
}

// The point of the half-space that is nearest to the sphere is beyond floats. Highway's scalar
// target once rounded it to the greatest of these.
TEST(UnsureLanesCases, WithANearestPointBeyondFloats) {
  TestPair pair;
  pair.a.shape = Sphere{1};
  pair.a.position = {3e38, 0, 0};
  pair.b.shape = Halfspace{{0, 1, 0}, 0};
  pair.b.position = {-3e38, 0, 0};
  pair.b.orientation = Eigen::Quaternionf(0.5f, 0, 0.5f, 0);
  for (const PositionType positions : kPositionTypes) {
    expect_the_reference(pair, positions);
    EXPECT_TRUE(std::isinf(expected_rows({&pair, 1}, positions)[0].point_b[0]));
  }
}

// The corners of this triangle are zeros of both signs, and as high as the plane. Lanes of doubles
// once took the last of them, and the scalar form the first.
TEST(UnsureLanesCases, WithATriangleOfZerosOverAPlane) {
  TestPair pair;
  pair.a.shape = Halfspace{{1, 1, 1}, 1};
  Triangle triangle;
  triangle.corners = {Eigen::Vector3f(0, 0, 0), {0, 0, 0}, {-0.0f, -0.0f, -0.0f}};
  pair.b.shape = triangle;
  pair.b.position = {1, 0, 0};
  expect_the_reference(pair, PositionType::float32);
  expect_the_reference(pair, PositionType::float64);
}

// The square of this gap is not a double, but zero.
TEST(UnsureLanesCases, WithAGapThatVanishesWhenSquared) {
  TestPair pair;
  pair.a.shape = Sphere{0};
  pair.a.position = {-0.0, -0.0, 0};
  pair.b.shape = Aabb{{0, 0, -0x1.68a93p-1f}, {0, 0, 0x1.68a93p-1f}};
  pair.b.position = {0, 0x4p-1074, -0x1.68a91f1811c01p-1};
  expect_the_reference(pair, PositionType::float64);
  const Row row = expected_rows({&pair, 1}, PositionType::float64)[0];
  EXPECT_EQ(row.overlap, 0);
  EXPECT_EQ(row.separation, std::numeric_limits<float>::denorm_min());
}

// The difference of the positions is beyond doubles.
TEST(UnsureLanesCases, WithAnInfiniteDistance) {
  Triangle triangle;
  triangle.corners = {Eigen::Vector3f(0, 0, 0), {1, 0, 0}, {0, 1, 0}};
  triangle.thickness = 1;
  TestPair pair;
  pair.a.shape = Sphere{1};
  pair.a.position = {0, 0x1.fdcf158adbb99p+1023, 0};
  pair.b.shape = triangle;
  pair.b.position = {0, -0x1.fdcf158adbb99p+1023, 0};
  expect_the_reference(pair, PositionType::float64);
}

}  // namespace
}  // namespace carom::test

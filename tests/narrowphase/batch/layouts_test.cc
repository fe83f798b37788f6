// Views of callers' arrays: counts around lanes and blocks, strides, layouts of radii and boxes,
// absent columns. Arrays end at guard pages.
#include <gtest/gtest.h>

#include "tests/support/families.h"
#include "tests/support/isas.h"
#include "tests/support/rounds.h"
#include "tests/support/run.h"

namespace carom::test {
namespace {

const Family kPlain{.name = "plain"};

std::vector<TestPair> plain_pairs(Sides sides, size_t count,
                                  PositionType positions = PositionType::float32) {
  return make_pairs(kPlain, sides, positions, count);
}

// Pairs of all kinds in turn, so that neighbours never share a kind.
std::vector<TestPair> mixed_pairs(size_t count, PositionType positions, uint64_t seed = 1) {
  std::vector<PairMaker> makers;
  for (const Sides sides : kAllSides) makers.emplace_back(kPlain, sides, positions, seed);
  Random random(seed);
  std::vector<TestPair> pairs;
  for (size_t i = 0; i < count; ++i) pairs.push_back(makers[random.below(makers.size())].next());
  return pairs;
}

void expect_right(std::span<const TestPair> pairs, const Call& call) {
  const std::vector<Row> expected =
      expected_rows(pairs, call.layout_a.positions, call.detail, call.frame);
  EXPECT_TRUE(same_rows(expected, run_rows(pairs, call), pairs));
  EXPECT_TRUE(same_rows(expected, run_list(pairs, call), pairs));
}

TEST(Layouts, CountsAroundLanesAndBlocks) {
  std::vector<size_t> counts;
  for (size_t count = 0; count <= rounds(35, 18); ++count) counts.push_back(count);
  for (const size_t around : {64, 128, 256, 512, 1024, 2048, 4096}) {
    for (const size_t count : {around - 1, around, around + 1}) counts.push_back(count);
  }
  for (const Sides sides : kAllSides) {
    SCOPED_TRACE(name(sides));
    const std::vector<TestPair> pairs = plain_pairs(sides, 4100);
    for_each_isa([&] {
      for (const size_t count : counts) {
        SCOPED_TRACE(count);
        expect_right(std::span(pairs).first(count), {});
      }
    });
  }
}

TEST(Layouts, MixedKinds) {
  for (const PositionType positions : kPositionTypes) {
    const std::vector<TestPair> pairs = mixed_pairs(5000, positions);
    for_each_isa([&] {
      for (const size_t count : {1, 2, 3, 17, 1023, 1024, 1025, 5000}) {
        Call call = call_with(positions);
        expect_right(std::span(pairs).first(count), call);
        call.layout_a.box_slots = call.layout_b.box_slots = true;
        expect_right(std::span(pairs).first(count), call);
      }
    });
  }
}

struct Stride {
  PositionType positions;
  RadiusLayout radius;
  size_t bytes;
};

TEST(Layouts, Strides) {
  using enum PositionType;
  using enum RadiusLayout;
  const Stride strides[] = {{float32, fourth, 16}, {float32, fourth, 20}, {float32, fourth, 32},
                            {float32, fourth, 40}, {float32, column, 12}, {float32, column, 16},
                            {float32, column, 20}, {float32, column, 44}, {float64, fourth, 32},
                            {float64, fourth, 40}, {float64, fourth, 48}, {float64, column, 24},
                            {float64, column, 32}, {float64, column, 56}};
  for (const Stride& stride : strides) {
    for (const Sides sides : kAllSides) {
      const std::vector<TestPair> pairs = plain_pairs(sides, 67, stride.positions);
      Call call;
      call.layout_a = {.positions = stride.positions,
                       .radius = stride.radius,
                       .stride = stride.bytes,
                       .radius_stride = 8,
                       .box_stride = 24};
      call.layout_b = call.layout_a;
      call.layout_b.box_stride = 0;
      SCOPED_TRACE(std::string(name(sides)) + ", " + show(call.layout_a));
      for_each_isa([&] {
        for (const size_t count : {1, 3, 4, 7, 8, 15, 16, 17, 67}) {
          expect_right(std::span(pairs).first(count), call);
        }
      });
    }
  }
}

TEST(Layouts, PointsWithoutRadius) {
  for (const PositionType positions : kPositionTypes) {
    for (const Sides sides : {Sides::point_sphere, Sides::point_aabb}) {
      for (const size_t extra : {0, 4, 8, 16}) {
        const std::vector<TestPair> pairs = plain_pairs(sides, 69, positions);
        Call call = call_with(positions);
        call.layout_a.radius = RadiusLayout::none;
        call.layout_a.stride = call.layout_a.record() + extra;
        SCOPED_TRACE(std::string(name(sides)) + ", " + show(call.layout_a));
        const std::vector<Row> expected = expected_rows(pairs, positions);
        for_each_isa([&] { EXPECT_TRUE(same_rows(expected, run_rows(pairs, call), pairs)); });
      }
    }
  }
}

// The two sets may have different layouts.
TEST(Layouts, TwoSetsOfDifferentLayout) {
  for (const PositionType positions : kPositionTypes) {
    const std::vector<TestPair> pairs = mixed_pairs(500, positions);
    Call call = call_with(positions);
    call.layout_a.radius = RadiusLayout::column;
    call.layout_b.stride = call.layout_b.record() + 8;
    call.layout_b.box_slots = true;
    const std::vector<Row> expected = expected_rows(pairs, positions);
    for_each_isa([&] {
      EXPECT_TRUE(same_rows(expected, run_rows(pairs, call), pairs));
      std::swap(call.layout_a, call.layout_b);
      EXPECT_TRUE(same_rows(expected, run_rows(pairs, call), pairs));
    });
  }
}

// A float32 set and a float64 set are tested against each other in float64.
TEST(Layouts, TwoSetsOfDifferentPositionType) {
  const std::vector<TestPair> pairs = mixed_pairs(500, PositionType::float32);
  for (const WitnessFrame frame : {WitnessFrame::world, WitnessFrame::body}) {
    Call call;
    call.frame = frame;
    call.layout_a.positions = PositionType::float64;
    const std::vector<Row> expected =
        expected_rows(pairs, PositionType::float64, Detail::contact, frame);
    for_each_isa([&] { EXPECT_TRUE(same_rows(expected, run_rows(pairs, call), pairs)); });
  }
}

TEST(Layouts, BoxesInWorldCoordinates) {
  std::vector<TestPair> pairs = plain_pairs(Sides::aabb_aabb, 2000);
  for (TestPair& pair : pairs) {
    for (PlacedShape* body : {&pair.a, &pair.b}) {
      Aabb& box = std::get<Aabb>(body->shape);
      box.lower += body->position.cast<float>();
      box.upper += body->position.cast<float>();
      body->position.setZero();
    }
  }
  const std::vector<Row> expected = expected_rows(pairs, PositionType::float32);
  const LaidOut a(side_a(pairs), {});
  const LaidOut b(side_b(pairs), {});
  for_each_isa([&] {
    for (const size_t count : {1, 15, 16, 17, 1999, 2000}) {
      Columns columns(count);
      const Collidables boxes_a = world_boxes(a.view().boxes, count);
      const Collidables boxes_b = world_boxes(b.view().boxes, count);
      ASSERT_TRUE(collide_rows(boxes_a, boxes_b, Detail::contact, columns.out()));
      EXPECT_TRUE(same_rows(std::span(expected).first(count), columns.rows(), pairs));
    }
  });
}

TEST(Layouts, BodyFrameWitnesses) {
  for (const PositionType positions : kPositionTypes) {
    const std::vector<TestPair> pairs = mixed_pairs(700, positions);
    Call call = call_with(positions);
    call.frame = WitnessFrame::body;
    for_each_isa([&] { expect_right(pairs, call); });
  }
}

TEST(Layouts, LesserDetailsWriteNoMore) {
  const std::vector<TestPair> pairs = mixed_pairs(700, PositionType::float32);
  for (const Detail detail : {Detail::pairs, Detail::overlap}) {
    Call call;
    call.detail = detail;
    for_each_isa([&] { expect_right(pairs, call); });
  }
}

TEST(Layouts, NullColumns) {
  for (const size_t count : {5, 48, 1100}) {
    const std::vector<TestPair> pairs = mixed_pairs(count, PositionType::float32);
    for_each_isa([&] {
      for (unsigned missing = 0; missing < 1u << Columns::kColumns; missing += 149) {
        std::vector<Row> expected = expected_rows(pairs, PositionType::float32, Detail::manifold);
        for (Row& row : expected) forget_columns(row, missing);
        Call call;
        call.detail = Detail::manifold;
        call.missing = missing;
        EXPECT_TRUE(same_rows(expected, run_rows(pairs, call), pairs));
        EXPECT_TRUE(same_rows(expected, run_list(pairs, call), pairs));
      }
    });
  }
}

TEST(Layouts, KindsWithoutKernelAreRefusedAndNothingIsWritten) {
  EXPECT_TRUE(supports(ShapeKind::sphere, ShapeKind::sphere));
  EXPECT_TRUE(supports(ShapeKind::aabb, ShapeKind::sphere));
  EXPECT_TRUE(supports(ShapeKind::sphere, ShapeKind::aabb));
  EXPECT_TRUE(supports(ShapeKind::aabb, ShapeKind::aabb));
  EXPECT_FALSE(supports(ShapeKind::halfspace, ShapeKind::halfspace));

  const std::vector<TestPair> pairs = plain_pairs(Sides::sphere_sphere, 20);
  const LaidOut a(side_a(pairs), {});
  Collidables planes = a.view();
  planes.uniform_kind = ShapeKind::halfspace;
  Columns columns(pairs.size());
  const Result<void> result = collide_rows(planes, planes, Detail::contact, columns.out());
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("halfspace"), std::string::npos);
  const Row untouched = expected_row(pairs[0], PositionType::float32, Detail::pairs, {});
  EXPECT_TRUE(same_rows(std::vector<Row>(pairs.size(), untouched), columns.rows(), pairs));
}

}  // namespace
}  // namespace carom::test

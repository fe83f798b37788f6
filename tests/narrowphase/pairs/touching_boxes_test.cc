// Boxes that touch to within rounding, which float32 cannot decide: the test in lanes of doubles
// against the reference, which computes one pair at a time.
#include <gtest/gtest.h>

#include <numbers>

#include "oracle/random.h"
#include "tests/support/isas.h"
#include "tests/support/rounds.h"
#include "tests/support/run.h"

namespace carom::test {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

// The features that meet. B is above A.
enum class Touch { faces, edges, corner_and_face, crossed_strips, tilted_faces };
constexpr Touch kTouches[] = {Touch::faces, Touch::edges, Touch::corner_and_face,
                              Touch::crossed_strips, Touch::tilted_faces};

struct TurnedBox {
  Vector3d half{0.5, 0.5, 0.5};
  Quaterniond turn = Quaterniond::Identity();

  double height() const { return (turn.conjugate() * Vector3d::UnitZ()).cwiseAbs().dot(half); }
};

void lay_out(Touch touch, oracle::Random& random, TurnedBox& a, TurnedBox& b) {
  constexpr double kEighth = std::numbers::pi / 4;
  switch (touch) {
    case Touch::faces:
      return;
    case Touch::edges:
      a.turn = AngleAxisd(kEighth, Vector3d::UnitX());
      b.turn = AngleAxisd(kEighth, Vector3d::UnitY());
      return;
    case Touch::corner_and_face:
      b.turn = Quaterniond::FromTwoVectors(Vector3d::Ones(), -Vector3d::UnitZ());
      return;
    case Touch::crossed_strips:
      a.half = {random.uniform(2, 4), random.uniform(0.1, 0.3), 0.5};
      b.half = {a.half.y(), a.half.x(), 0.5};
      return;
    case Touch::tilted_faces:
      b.turn = AngleAxisd(random.uniform(-1e-7, 1e-7), random.direction());
      return;
  }
}

Quaterniond any_turn(oracle::Random& random) {
  return Quaterniond(AngleAxisd(random.uniform(0, 2 * std::numbers::pi), random.direction()));
}

// The pair in the world, turned by `view`.
TestPair placed(const TurnedBox& a, const TurnedBox& b, const Vector3d& offset,
                const Quaterniond& view, bool is_upright) {
  TestPair pair;
  pair.a.position = view * Vector3d(20, -30, 40);
  pair.b.position = pair.a.position + view * offset;
  pair.a.orientation = (view * a.turn).cast<float>();
  pair.b.orientation = (view * b.turn).cast<float>();
  const Eigen::Vector3f half = a.half.cast<float>();
  pair.a.shape = is_upright ? Shape(Aabb{-half, half}) : Shape(Box{half});
  pair.b.shape = Box{b.half.cast<float>()};
  return pair;
}

std::vector<TestPair> touching_boxes(size_t count, bool is_upright, uint64_t seed) {
  oracle::Random random(seed);
  std::vector<TestPair> pairs;
  for (size_t i = 0; i < count; ++i) {
    TurnedBox a, b;
    lay_out(kTouches[i % std::size(kTouches)], random, a, b);
    if (is_upright) a.turn.setIdentity();
    const Vector3d offset(random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4),
                          a.height() + b.height());
    const Quaterniond view = is_upright ? Quaterniond::Identity() : any_turn(random);
    pairs.push_back(placed(a, b, offset, view, is_upright));
  }
  return pairs;
}

// The test finds everything of overlapping pairs, and the decision alone of separate ones.
bool are_as_expected(const std::vector<Row>& expected, const std::vector<Row>& found,
                     const std::vector<TestPair>& pairs) {
  for (size_t i = 0; i < expected.size(); ++i) {
    if (expected[i].overlap != found[i].overlap) return false;
    if (expected[i].overlap != 1) continue;
    if (!same_rows({&expected[i], 1}, {&found[i], 1}, {&pairs[i], 1})) return false;
  }
  return true;
}

class TouchingBoxes : public testing::TestWithParam<bool> {};

TEST_P(TouchingBoxes, AreThoseOfTheReference) {
  const bool is_upright = GetParam();
  for (const PositionType positions : {PositionType::float32, PositionType::float64}) {
    size_t overlaps = 0, all = 0;
    // Vectors of all widths with tails, and vectors with one such pair alone.
    for (const uint32_t count : {1u, 2u, 3u, 4u, 5u, 8u, 9u, 16u, 17u, rounds(2000, 40)}) {
      const std::vector<TestPair> pairs = touching_boxes(count, is_upright, count);
      Call call = call_with(positions);
      const std::vector<Row> expected = expected_rows(pairs, positions, call.detail, call.frame);
      for (const Row& row : expected) overlaps += row.overlap;
      all += count;
      call.measured = Measured::overlapping;
      for_each_isa([&] {
        EXPECT_TRUE(are_as_expected(expected, run_rows(pairs, call), pairs));
        Call decisions = call;
        decisions.detail = Detail::overlap;
        const std::vector<Row> decided = run_rows(pairs, decisions);
        for (size_t i = 0; i < count; ++i) EXPECT_EQ(decided[i].overlap, expected[i].overlap);
      });
    }
    EXPECT_GT(overlaps, all / 5);
    EXPECT_LT(overlaps, all * 4 / 5);
  }
}

// The gap is above zero in scaled units and vanishes in metres, so that the pair overlaps.
TEST(TouchingBoxesCases, WithAGapBelowTheSmallestDouble) {
  TestPair pair;
  pair.a.shape = Box{{0x1.f81eacp-1f, 0, 0}};
  pair.a.orientation = {-0x1.c7923p-4f, -0x1.e86a7ep-1f, -0x1.de6644p-3f, -0x1.370b6cp-3f};
  pair.b.shape = Box{{0, 0, 0}};
  pair.b.position = {-0x1p-1074, 0, 0};
  pair.b.orientation = {-0x1.8b31a6p-1f, -0x1.b9dbe4p-2f, 0x1.500edep-2f, -0x1.542158p-2f};
  Call call = call_with(PositionType::float64);
  const std::vector<TestPair> pairs = {pair};
  const auto expected = expected_rows(pairs, PositionType::float64, call.detail, call.frame);
  EXPECT_EQ(expected[0].overlap, 1);
  call.measured = Measured::overlapping;
  for_each_isa([&] { EXPECT_TRUE(same_rows(expected, run_rows(pairs, call), pairs)); });
}

INSTANTIATE_TEST_SUITE_P(AandB, TouchingBoxes, testing::Values(false, true),
                         [](const auto& each) { return each.param ? "upright" : "turned"; });

}  // namespace
}  // namespace carom::test

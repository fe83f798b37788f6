// Every kernel on every ISA against the reference, bit for bit.
#include <gtest/gtest.h>

#include "tests/support/families.h"
#include "tests/support/isas.h"
#include "tests/support/rounds.h"
#include "tests/support/run.h"

namespace carom::test {
namespace {

constexpr size_t kManyPairs = 1100;  // more than a block

void expect_reference_bits(std::span<const TestPair> pairs, PositionType positions) {
  const std::vector<Row> expected = expected_rows(pairs, positions);
  for_each_isa([&] {
    EXPECT_TRUE(same_rows(expected, run_rows(pairs, call_with(positions)), pairs));
    EXPECT_TRUE(same_rows(expected, run_list(pairs, call_with(positions)), pairs));
  });
}

std::vector<Family> families_to_the_limits() {
  std::vector<Family> all = families();
  all.push_back({.name = "huge", .smallest = 1e30, .largest = 3e38, .distance_in_sizes = true});
  all.push_back({.name = "huge ratio", .smallest = 1e-44, .largest = 3e38, .ratio = 1e20});
  return all;
}

class Bits : public testing::TestWithParam<Family> {};

TEST_P(Bits, EqualReference) {
  for (const Sides sides : kAllSides) {
    for (const PositionType positions : kPositionTypes) {
      SCOPED_TRACE(std::string(name(sides)) + ", " + name(positions));
      expect_reference_bits(make_pairs(GetParam(), sides, positions, kManyPairs), positions);
    }
  }
}

std::string test_name(const testing::TestParamInfo<Family>& info) {
  std::string text = info.param.name;
  std::replace(text.begin(), text.end(), ' ', '_');
  return text;
}

INSTANTIATE_TEST_SUITE_P(Families, Bits, testing::ValuesIn(families_to_the_limits()), test_name);

TEST(Bits, EqualReferenceForAnyInput) {
  for (const Sides sides : kAllSides) {
    SCOPED_TRACE(name(sides));
    for (const PositionType positions : kPositionTypes) {
      expect_reference_bits(make_nonsense(sides, rounds(20000)), positions);
    }
  }
}

// Float64 positions beyond the range of float32; only their difference is inside it.
TEST(Bits, EqualReferenceForDistantFloat64Positions) {
  for (const Sides sides : kAllSides) {
    SCOPED_TRACE(name(sides));
    std::vector<TestPair> pairs;
    for (const double distance : {1e12, 1e30, 1e38, 3e38}) {
      const Family family{.name = "",
                          .smallest = 1e-6 * distance,
                          .largest = 1e-3 * distance,
                          .distance = distance};
      for (const TestPair& pair : make_pairs(family, sides, PositionType::float64, 100)) {
        pairs.push_back(pair);
      }
    }
    expect_reference_bits(pairs, PositionType::float64);
  }
}

TEST(Bits, DoNotDependOnTheFloatModeOfTheCaller) {
  for (const Family& family : families()) {
    if (family.smallest > 1e-30) continue;
    for (const Sides sides : kAllSides) {
      SCOPED_TRACE(std::string(family.name) + ", " + name(sides));
      const std::vector<TestPair> pairs =
          make_pairs(family, sides, PositionType::float32, rounds(300));
      const std::vector<Row> expected =
          expected_rows(pairs, PositionType::float32, Detail::contact, WitnessFrame::body);
      Call call;
      call.frame = WitnessFrame::body;
      for_each_isa([&] {
        for (const FloatMode& mode : float_modes()) {
          SCOPED_TRACE(mode.name);
          call.mode = mode;
          EXPECT_TRUE(same_rows(expected, run_rows(pairs, call), pairs));
          EXPECT_TRUE(same_rows(expected, run_list(pairs, call), pairs));
        }
      });
    }
  }
}

}  // namespace
}  // namespace carom::test

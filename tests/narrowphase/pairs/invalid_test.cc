// NaN, infinity and negative sizes spoil their own pair and no other.
#include <gtest/gtest.h>

#include "tests/support/families.h"
#include "tests/support/isas.h"
#include "tests/support/rounds.h"
#include "tests/support/run.h"
#include "tests/support/special_floats.h"

namespace carom::test {
namespace {

// Every way to spoil a body.
std::vector<PlacedShape> spoilt(const PlacedShape& body) {
  std::vector<PlacedShape> all;
  for (const float bad : {kNan, kInfinity, -kInfinity}) {
    for (int axis = 0; axis < 3; ++axis) {
      all.push_back(body);
      all.back().position[axis] = bad;
    }
  }
  if (std::holds_alternative<Sphere>(body.shape)) {
    for (const float bad : {kNan, kInfinity, -kInfinity, -1.0f, -1e-45f}) {
      all.push_back({Sphere{bad}, body.position});
    }
    return all;
  }
  const Aabb box = std::get<Aabb>(body.shape);
  for (int axis = 0; axis < 3; ++axis) {
    for (const float bad : {kNan, kInfinity, -kInfinity}) {
      Aabb lower = box;
      lower.lower[axis] = bad;
      all.push_back({lower, body.position});
      Aabb upper = box;
      upper.upper[axis] = bad;
      all.push_back({upper, body.position});
    }
    Aabb inverted = box;
    std::swap(inverted.lower[axis], inverted.upper[axis]);
    all.push_back({inverted, body.position});
  }
  return all;
}

void expect_no_contact(const Row& row) {
  EXPECT_EQ(row.overlap, 0);
  EXPECT_EQ(row.status, static_cast<uint8_t>(Status::invalid));
  std::vector<float> floats{row.separation};
  for (const auto* triple : {&row.normal, &row.point_a, &row.point_b}) {
    floats.insert(floats.end(), triple->begin(), triple->end());
  }
  for (const float x : floats) EXPECT_EQ(std::bit_cast<uint32_t>(x), 0x7fc00000u);
}

void check_invalid_in(std::span<const TestPair> pairs, size_t place, const TestPair& bad,
                      const Call& call, std::span<const Row> clean) {
  std::vector<TestPair> with_bad(pairs.begin(), pairs.end());
  with_bad[place] = bad;
  std::vector<Row> expected(clean.begin(), clean.end());
  for (const auto& run : {run_rows, run_list}) {
    const std::vector<Row> rows = run(with_bad, call);
    expect_no_contact(rows[place]);
    expected[place] = rows[place];
    EXPECT_TRUE(same_rows(expected, rows, with_bad));
  }
}

TEST(Invalid, SpoilsItsOwnPairAlone) {
  for (const Sides sides : kAllSides) {
    for (const PositionType positions : kPositionTypes) {
      SCOPED_TRACE(std::string(name(sides)) + ", " + name(positions));
      const std::vector<TestPair> pairs =
          make_pairs({.name = ""}, sides, positions, rounds_of_pairs(35));
      for (const WitnessFrame frame : {WitnessFrame::world, WitnessFrame::body}) {
        Call call = call_with(positions);
        call.frame = frame;
        const std::vector<Row> clean = expected_rows(pairs, positions, Detail::contact, frame);
        for_each_isa([&] {
          for (const size_t place : {size_t{7}, pairs.size() - 1}) {
            for (const PlacedShape& body : spoilt(pairs[place].a)) {
              check_invalid_in(pairs, place, {body, pairs[place].b}, call, clean);
            }
            for (const PlacedShape& body : spoilt(pairs[place].b)) {
              check_invalid_in(pairs, place, {pairs[place].a, body}, call, clean);
            }
          }
        });
      }
    }
  }
}

TEST(Invalid, AllOfThem) {
  for (const Sides sides : kAllSides) {
    std::vector<TestPair> pairs;
    for (const TestPair& pair : make_pairs({.name = ""}, sides, PositionType::float32, 3)) {
      for (const PlacedShape& a : spoilt(pair.a)) {
        for (const PlacedShape& b : spoilt(pair.b)) pairs.push_back({a, b});
      }
    }
    for_each_isa([&] {
      for (const Row& row : run_rows(pairs, {})) expect_no_contact(row);
      Call overlap;
      overlap.detail = Detail::overlap;
      EXPECT_TRUE(same_rows(expected_rows(pairs, PositionType::float32, Detail::overlap),
                            run_list(pairs, overlap), pairs));
    });
  }
}

}  // namespace
}  // namespace carom::test

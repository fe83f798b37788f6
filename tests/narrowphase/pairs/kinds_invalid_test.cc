// NaN, infinity, negative sizes, a quaternion or a normal of zero spoil their own pair and no
// other, for every two kinds (case 65).
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <type_traits>

#include "tests/support/isas.h"
#include "tests/support/kind_pairs.h"
#include "tests/support/rounds.h"
#include "tests/support/run.h"
#include "tests/support/spoilt_bodies.h"

namespace carom::test {
namespace {

void expect_no_answer(const Row& row) {
  EXPECT_EQ(row.overlap, 0);
  EXPECT_EQ(row.status, static_cast<uint8_t>(Status::invalid));
  EXPECT_EQ(row.manifold_count, 0);
  for_each_column(
      [&]<class T>(const ColumnInfo& info, const T& field) {
        if constexpr (std::is_same_v<T, float>) {
          const bool is_written = !is_optional(info.role);
          EXPECT_EQ(std::bit_cast<uint32_t>(field), is_written ? 0x7fc00000u : 0u) << info.name;
        }
      },
      row);
  const ManifoldPoints none{};
  EXPECT_EQ(std::memcmp(&row.manifold, &none, sizeof none), 0);
}

TEST(KindsInvalid, HasNoAnswer) {
  Call call;
  call.detail = Detail::manifold;
  for (const KindPair& kinds : supported_kind_pairs()) {
    SCOPED_TRACE(name(kinds));
    const auto pair = make_kind_pairs({.name = ""}, kinds, PositionType::float32, 1)[0];
    const std::vector<TestPair> pairs = spoilt(pair);
    const auto expected = expected_rows(pairs, PositionType::float32, call.detail);
    for_each_isa([&] {
      for (const auto& run : {run_rows, run_list}) {
        const std::vector<Row> rows = run(pairs, call);
        EXPECT_TRUE(same_rows(expected, rows, pairs));
        for (size_t i = 0; i < pairs.size() && !HasFailure(); ++i) {
          const ShownIfFailed shown([&] { return show(pairs[i]); });
          expect_no_answer(rows[i]);
        }
      }
    });
  }
}

// Every third pair of a list is spoilt; the others keep their bits.
TEST(KindsInvalid, SpoilsItsOwnPairAlone) {
  for (const KindPair& kinds : supported_kind_pairs()) {
    for (const PositionType positions : kPositionTypes) {
      SCOPED_TRACE(name(kinds) + ", " + name(positions));
      std::vector<TestPair> pairs =
          make_kind_pairs({.name = ""}, kinds, positions, rounds(135, 27));
      Call call = call_with(positions);
      call.detail = Detail::manifold;
      for_each_isa([&] {
        std::vector<Row> expected = run_list(pairs, call);
        std::vector<TestPair> with_bad = pairs;
        const std::vector<TestPair> bad = spoilt(pairs[0]);
        for (size_t i = 0; i < pairs.size(); i += 3) with_bad[i] = bad[i % bad.size()];
        const std::vector<Row> rows = run_list(with_bad, call);
        for (size_t i = 0; i < pairs.size(); i += 3) {
          expect_no_answer(rows[i]);
          expected[i] = rows[i];
        }
        EXPECT_TRUE(same_rows(expected, rows, with_bad));
      });
    }
  }
}

// Spheres and aabbs do not turn: any orientation is accepted.
TEST(KindsInvalid, OrientationsOfWhatDoesNotTurnAreIgnored) {
  for (const KindPair& kinds : supported_kind_pairs()) {
    SCOPED_TRACE(name(kinds));
    std::vector<TestPair> pairs = make_kind_pairs({.name = ""}, kinds, PositionType::float32, 35);
    const auto expected = expected_rows(pairs, PositionType::float32, Detail::manifold);
    for (TestPair& pair : pairs) {
      for (PlacedShape* body : {&pair.a, &pair.b}) {
        if (!has_rows(body->shape)) body->orientation.coeffs().setConstant(kNan);
      }
    }
    Call call;
    call.detail = Detail::manifold;
    for_each_isa([&] {
      EXPECT_TRUE(same_rows(expected, run_rows(pairs, call), pairs));
      EXPECT_TRUE(same_rows(expected, run_list(pairs, call), pairs));
    });
  }
}

}  // namespace
}  // namespace carom::test

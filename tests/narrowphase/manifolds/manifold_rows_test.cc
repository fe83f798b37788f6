// Where manifolds are written, at numbers of rows around those of all vectors.
#include <gtest/gtest.h>

#include <cstring>
#include <span>

#include "carom/narrowphase/collide.h"
#include "carom/results/result_arrays.h"
#include "tests/support/isas.h"
#include "tests/support/kind_pairs.h"
#include "tests/support/results.h"
#include "tests/support/run.h"

namespace carom::test {
namespace {

bool is_untouched(const ManifoldPoints& points) {
  ManifoldPoints untouched;
  std::memset(static_cast<void*>(&untouched), kUntouched, sizeof(untouched));
  return std::memcmp(&points, &untouched, sizeof(points)) == 0;
}

TEST(ManifoldRows, AreWrittenWhereBodiesTouchAndNowhereElse) {
  constexpr size_t kMost = 70;
  const KindPair kinds{ShapeKind::box, ShapeKind::box};
  const std::vector<TestPair> pairs =
      make_kind_pairs(convex_families()[0], kinds, PositionType::float32, kMost);
  ASSERT_EQ(pairs.size(), kMost);
  size_t touching = 0, apart = 0;
  for (const size_t count : {1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 32, 33, 63, 70}) {
    const std::span<const TestPair> some = std::span(pairs).first(count);
    const LaidOut a(side_a(some), {.positions = PositionType::float32});
    const LaidOut b(side_b(some), {.positions = PositionType::float32});
    ResultArrays arrays(count + 1, Detail::manifold);
    const ResultColumns& rows = arrays.columns();
    for_each_isa([&] {
      std::memset(static_cast<void*>(rows.manifold), kUntouched,
                  (count + 1) * sizeof(ManifoldPoints));
      rows.manifold_count[count] = kUntouched;
      ASSERT_TRUE(collide_rows(a.view(), b.view(), Detail::manifold, rows,
                               {.frame = WitnessFrame::body, .measured = Measured::overlapping}));
      for (size_t row = 0; row < count; ++row) {
        const TestPair& pair = some[row];
        const reference::PairResult expected = reference::collide(
            pair.a.shape, pair.a.pose(), pair.b.shape, pair.b.pose(), PositionType::float32);
        ASSERT_EQ(rows.manifold_count[row], expected.manifold_count) << row << " of " << count;
        touching += expected.overlap;
        apart += !expected.overlap;
        if (expected.overlap) {
          const int difference =
              std::memcmp(&rows.manifold[row], &expected.manifold, sizeof(expected.manifold));
          EXPECT_EQ(difference, 0) << row << " of " << count;
        } else {
          EXPECT_TRUE(is_untouched(rows.manifold[row])) << row << " of " << count;
        }
      }
      EXPECT_TRUE(is_untouched(rows.manifold[count])) << count;
      EXPECT_EQ(rows.manifold_count[count], kUntouched) << count;
    });
    ASSERT_FALSE(HasFatalFailure());
  }
  EXPECT_GT(touching, (touching + apart) / 3);
  EXPECT_GT(apart, (touching + apart) / 3);
}

}  // namespace
}  // namespace carom::test

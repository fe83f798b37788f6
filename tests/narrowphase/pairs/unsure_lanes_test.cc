// Vectors in which any number of lanes cannot be decided in float32, against the reference, which
// computes one pair at a time.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

#include "tests/support/isas.h"
#include "tests/support/kind_pairs.h"
#include "tests/support/rounds.h"
#include "tests/support/run.h"

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
           kind == ShapeKind::box || kind == ShapeKind::triangle;
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

}  // namespace
}  // namespace carom::test

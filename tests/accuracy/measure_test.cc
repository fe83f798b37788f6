// A small run of everything that `carom accuracy` measures.
#include "accuracy/tiers/measure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "accuracy/page.h"
#include "accuracy/pairs/samples.h"
#include "accuracy/pairs/undecided.h"
#include "accuracy/tiers/atlas.h"
#include "accuracy/tiers/judge.h"
#include "accuracy/tiers/sweeps.h"
#include "accuracy/tiers/tradeoff.h"

namespace carom::accuracy {
namespace {

using Json = nlohmann::ordered_json;
using testing::IsEmpty;

constexpr Effort kTiny = {
    .stream = 200, .family = 2, .gap = 3, .distance = 3, .angle = 3, .scene = 160, .rounds = 1};

NamedKinds named(const std::string& name) {
  return *std::find_if(std::begin(kAllKinds), std::end(kAllKinds),
                       [&](const NamedKinds& kinds) { return kinds.name == name; });
}

class MeasuredKinds : public testing::TestWithParam<const char*> {};

TEST_P(MeasuredKinds, BreakNoPromise) {
  const NamedKinds kinds = named(GetParam());
  Json tradeoff, matrix, atlas, gaps, distances, angles;
  Failures failures;
  measure_tradeoff(kinds, kTiny, 1, {tradeoff, matrix, atlas}, failures);
  measure_gaps(kinds, kTiny, 1, gaps, failures);
  measure_distances(kinds, kTiny, 1, distances);
  measure_angles(kinds, kTiny, 1, angles, failures);
  EXPECT_THAT(failures.texts(), IsEmpty());

  ASSERT_GE(tradeoff.size(), 4u);  // the reference and three tiers
  for (const Json& row : tradeoff) {
    EXPECT_GT(row["ns_per_pair"].get<double>(), 0) << row;
    EXPECT_GE(row["judged"].get<size_t>(), kTiny.stream) << row;
  }
  EXPECT_EQ(matrix.size(), 1u);
  const size_t chapters = oracle::convex_families().size() + 1;
  EXPECT_EQ(atlas.size(), chapters * 2 * 3);
  ASSERT_FALSE(gaps.empty());
  EXPECT_EQ(gaps[0]["steps"].size(), gaps[0]["missed"].size());
  ASSERT_EQ(distances.size(), 2u);
  // float32 positions cannot express these distances, float64 positions can.
  const double far32 = distances[0]["error_worst"].back();
  const double far64 = distances[1]["error_worst"].back();
  EXPECT_GT(far32, 1);
  EXPECT_LT(far64, 1e-6);
  EXPECT_EQ(!angles.empty(), has_angle(kinds.kinds));
}

INSTANTIATE_TEST_SUITE_P(Some, MeasuredKinds,
                         testing::Values("sphere_sphere", "capsule_capsule", "aabb_box", "box_box",
                                         "box_triangle", "halfspace_triangle"),
                         [](const auto& kinds) { return std::string(kinds.param); });

TEST(Measure, UndecidedScenesHaveAllFigures) {
  Json rows;
  measure_undecided(kTiny.scene, kTiny.rounds, 1, rows);
  ASSERT_EQ(rows.size(), 6u);
  for (const Json& row : rows) {
    EXPECT_GT(row["pairs"].get<size_t>(), 0u) << row;
    EXPECT_LE(row["undecided"].get<double>(), 1) << row;
  }
}

TEST(Measure, HasEverySectionWithoutKinds) {
  const Json json = measure({.kinds = {}}, [](size_t, size_t) {});
  for (const char* section : {"tradeoff", "by_gap", "by_distance", "by_angle", "undecided", "reuse",
                              "fidelity", "matrix", "atlas", "failures"}) {
    EXPECT_TRUE(json[section].is_array()) << section;
  }
  EXPECT_EQ(json["carom_accuracy"], 1);
}

// Answers that are wrong on purpose.
class Liar final : public Contender {
 public:
  const char* setting() const override { return "liar"; }
  const char* tier() const override { return "standard"; }
  Promise promise() const override { return Promise::standard; }
  bool serves(const KindPair&) const override { return true; }
  void run(const PairSet& pairs, Detail detail, Answers& out) override {
    standard_.run(pairs, detail, out);
    out.overlap[0] ^= 1;
    out.separation[1] *= 1.001f;
    std::swap(out.normal[0][2], out.normal[1][2]);
    out.point_a[0][3] = NAN;
  }

 private:
  LibrarySetting standard_ = standard_setting();
};

TEST(Judge, FindsEveryLie) {
  const KindPair boxes{ShapeKind::box, ShapeKind::box};
  const PairSet pairs(random_pairs(boxes, 10, 1), PositionType::float32);
  Liar liar;
  const Attempt attempt{.contender = &liar};
  const Tally tally = judge(pairs, {&attempt, 1})[0];
  EXPECT_EQ(tally.wrong(), 1u);
  EXPECT_GT(tally.worst_wrong_gap, 1e-6);
  EXPECT_GT(tally.error_worst, 1e-6);
  EXPECT_GT(tally.regret_worst, 1e-3);
  EXPECT_EQ(tally.not_finite, 1u);
  EXPECT_GE(tally.broken, 4u);
  EXPECT_THAT(tally.examples, testing::Not(IsEmpty()));
}

TEST(Page, HoldsTheDataAndNothingThatEndsTheScript) {
  const std::string page = page_with({{"failures", {"</script> is text"}}});
  EXPECT_NE(page.find(R"({"failures":["\u003c/script> is text"]})"), std::string::npos);
  EXPECT_EQ(page.find("CAROM_DATA"), std::string::npos);
  EXPECT_NE(page.find("</html>"), std::string::npos);
}

}  // namespace
}  // namespace carom::accuracy

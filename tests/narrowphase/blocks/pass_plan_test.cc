// Which passes a batch gets, for every kind and everything that can be asked for.
#include "narrowphase/blocks/pass_plan.h"

#include <gtest/gtest.h>

#include <functional>

namespace carom::test {
namespace {

struct Asked {
  const PairKind& kind;
  Detail detail;
  Measured measured;
  Tier tier;
  bool directions, features, bound;
};

PassPlan plan_of(const Asked& asked) {
  Batch batch;
  batch.detail = asked.detail;
  uint64_t features = 0;
  float bound = 0;
  if (asked.features) batch.out.features = &features;
  if (asked.bound) batch.out.separation_bound = &bound;
  return plan_passes(asked.kind, batch, asked.measured, asked.directions, {.tier = asked.tier});
}

void for_everything(const std::function<void(const Asked&, const PassPlan&)>& check) {
  for (const PairKind& kind : kPairKinds) {
    for (const Detail detail : {Detail::overlap, Detail::contact, Detail::manifold}) {
      for (const Measured measured : {Measured::all, Measured::overlapping, Measured::separate}) {
        for (const Tier tier : {Tier::fast, Tier::standard, Tier::certified, Tier::exact}) {
          for (int flags = 0; flags < 8; ++flags) {
            const bool directions = flags & 1, features = flags & 2, bound = flags & 4;
            const Asked asked{kind, detail, measured, tier, directions, features, bound};
            check(asked, plan_of(asked));
          }
        }
      }
    }
  }
}

TEST(PassPlan, OnlyHasPassesOfTheKind) {
  for_everything([](const Asked& asked, const PassPlan& plan) {
    const PairKind& kind = asked.kind;
    if (plan.known == PassPlan::Known::directions) {
      EXPECT_TRUE(kind.has_direction_pass());
    }
    if (plan.known == PassPlan::Known::features) {
      EXPECT_TRUE(kind.has_recall_pass());
    }
    if (plan.search != Pass::test) {
      EXPECT_TRUE(kind.measures_at_once());
    }
    if (plan.measures_separate) {
      EXPECT_TRUE(kind.has_distance_pass());
    }
    if (plan.points == PassPlan::Points::clipped) {
      EXPECT_TRUE(kind.has_manifold_pass());
    }
  });
}

TEST(PassPlan, WhatNobodyAskedForIsNotComputed) {
  for_everything([](const Asked& asked, const PassPlan& plan) {
    const bool contacts = has_contacts(asked.detail);
    EXPECT_EQ(plan.points != PassPlan::Points::none, asked.detail == Detail::manifold);
    EXPECT_EQ(plan.proves, has_proofs(asked.tier));
    EXPECT_EQ(plan.bounds, asked.bound);
    if (!contacts || asked.measured == Measured::overlapping) {
      EXPECT_FALSE(plan.measures_separate);
      EXPECT_FALSE(plan.measures_in_test);
      EXPECT_EQ(plan.search, Pass::test);
    }
    if (!contacts) {
      EXPECT_EQ(plan.known, PassPlan::Known::nothing);
    }
    if (!asked.directions) {
      EXPECT_NE(plan.known, PassPlan::Known::directions);
    }
    if (!asked.features) {
      EXPECT_NE(plan.known, PassPlan::Known::features);
    }
  });
}

TEST(PassPlan, SeparatePairsAreMeasuredOnceIfAskedFor) {
  for_everything([](const Asked& asked, const PassPlan& plan) {
    if (!has_contacts(asked.detail) || !asked.kind.has_distance_pass()) return;
    if (asked.measured == Measured::overlapping) return;
    const bool in_search = asked.kind.measures_at_once() || asked.kind.measures_in_test();
    EXPECT_NE(plan.measures_separate, in_search);
    EXPECT_EQ(plan.measures_in_test, asked.kind.measures_in_test());
    EXPECT_EQ(plan.search != Pass::test, asked.kind.measures_at_once());
  });
}

// A proof may turn an overlap into a separate pair, whose depth the search must not have left out.
TEST(PassPlan, ProofsHaveTheContactsOfAllPairs) {
  for_everything([](const Asked& asked, const PassPlan& plan) {
    if (!has_proofs(asked.tier)) return;
    EXPECT_NE(plan.search, Pass::clearance);
    EXPECT_EQ(plan.search_detail, asked.detail);
    EXPECT_NE(plan.known, PassPlan::Known::features);
  });
}

}  // namespace
}  // namespace carom::test

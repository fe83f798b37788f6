// Pairs of hulls measured again from the features of the last call.
#include <gtest/gtest.h>

#include <bit>

#include "narrowphase/hulls/features.h"
#include "narrowphase/hulls/recall_scalar.h"
#include "narrowphase/scalar/scaled.h"
#include "tests/support/hulls.h"
#include "tests/support/isas.h"
#include "tests/support/rounds.h"
#include "tests/support/run.h"

namespace carom::test {
namespace {

using Eigen::Vector3f;
using oracle::Random;

PlacedShape random_body(Random& random, double size) {
  const auto half = [&] { return static_cast<float>(size * random.uniform(0.3, 1)); };
  const size_t count = 4 + random.below(random.chance(0.02) ? 140 : 30);
  PlacedShape body{oracle::hull_of(round_points(count, {half(), half(), half()}, random))};
  for (int i = 0; i < 4; ++i) {
    body.orientation.coeffs()[i] = static_cast<float>(random.uniform(-1, 1));
  }
  return body;
}

// Pairs of which about half overlap.
std::vector<TestPair> random_pairs(size_t count, double size, uint64_t seed) {
  Random random(seed);
  std::vector<TestPair> pairs(count);
  for (TestPair& pair : pairs) {
    pair.a = random_body(random, size);
    pair.b = random_body(random, size);
    const Eigen::Vector3d at = random.direction() * size * random.uniform(0, 4);
    pair.a.position = stored(at, PositionType::float32);
    const double reach = size * random.uniform(0, 2.3);
    pair.b.position = stored(at + random.direction() * reach, PositionType::float32);
  }
  return pairs;
}

// Moves the bodies by up to `share` of their size.
void move(std::vector<TestPair>& pairs, double size, double share, Random& random) {
  for (TestPair& pair : pairs) {
    const Eigen::Vector3d to = pair.b.position + random.direction() * size * share;
    pair.b.position = stored(to, PositionType::float32);
    for (int i = 0; i < 4; ++i) {
      pair.b.orientation.coeffs()[i] += static_cast<float>(random.uniform(-share, share));
    }
  }
}

std::vector<Row> run(std::span<const TestPair> pairs, const Call& call,
                     std::vector<uint64_t>* features) {
  const LaidOut a(side_a(pairs), call.layout_a), b(side_b(pairs), call.layout_b);
  Columns columns(pairs.size(), call.missing);
  ResultColumns out = columns.out();
  if (features) out.features = features->data();
  expect_success(
      call, [&] { return collide_rows(a.view(), b.view(), call.detail, out, options_of(call)); });
  return columns.rows();
}

Call call_of(Measured measured) {
  Call call = call_with(PositionType::float32);
  call.frame = WitnessFrame::body;
  call.measured = measured;
  return call;
}

scalar::Separation recalled(const TestPair& pair, uint64_t features) {
  const auto hull = [](const PlacedShape& body) -> scalar::HullShape<float> {
    return {std::get<Hull>(body.shape).geometry.get(), 1};
  };
  const auto turn = [](const PlacedShape& body) -> scalar::Quaternion<float> {
    return {body.orientation.vec(), body.orientation.w()};
  };
  const Vector3f d = pair.b.position.cast<float>() - pair.a.position.cast<float>();
  return scalar::in_scaled_units<float>(
      hull(pair.a), hull(pair.b), scalar::PairPose<float>{d, turn(pair.a), turn(pair.b)},
      [&](const auto& a, const auto& b, const scalar::PairPose<float>& pose) {
        return recalled_separation(a, b, pose, features);
      });
}

void expect_bits(const scalar::Separation& s, const Row& row) {
  const auto bits = [](float x) { return std::bit_cast<uint32_t>(x); };
  EXPECT_EQ(bits(s.separation), bits(row.separation));
  for (int i = 0; i < 3; ++i) {
    const auto axis = static_cast<size_t>(i);
    EXPECT_EQ(bits(s.normal[i]), bits(row.normal[axis]));
    EXPECT_EQ(bits(s.arm_a[i]), bits(row.point_a[axis]));
    EXPECT_EQ(bits(s.arm_b[i]), bits(row.point_b[axis]));
  }
}

double radius(const TestPair& pair) {
  const auto size = [](const PlacedShape& body) {
    return double{std::get<Hull>(body.shape).geometry->size()};
  };
  return size(pair.a) + size(pair.b);
}

// A row measured from its features has the bits of the scalar form; every other row has those of a
// call without features.
TEST(Recall, IsItsReferenceOnEveryIsa) {
  for (const double size : {1e-25, 1.0, 1e15}) {
    SCOPED_TRACE(size);
    std::vector<TestPair> pairs = random_pairs(rounds(600, 75), size, 1);
    const Call call = call_of(Measured::separate);
    std::vector<uint64_t> known(pairs.size());
    run(pairs, call, &known);
    Random random(2);
    move(pairs, size, 0.02, random);
    const std::vector<Row> cold = run(pairs, call, nullptr);
    std::array<size_t, kMostFeatures + 1> recalls{};
    std::vector<std::vector<uint64_t>> left;
    for_each_isa([&] {
      std::vector<uint64_t> features = known;
      const std::vector<Row> warm = run(pairs, call, &features);
      for (size_t i = 0; i < pairs.size(); ++i) {
        SCOPED_TRACE(testing::Message() << "pair " << i);
        ASSERT_EQ(warm[i].overlap, cold[i].overlap);
        ASSERT_EQ(warm[i].status, cold[i].status);
        const scalar::Separation s = recalled(pairs[i], known[i]);
        if (!s.is_unsure) {
          ++recalls[feature_count(known[i])];
          ASSERT_EQ(features[i], known[i]);
        }
        if (warm[i].overlap) continue;
        if (s.is_unsure) {
          ASSERT_TRUE(same_bits(warm[i], cold[i]));
        } else {
          expect_bits(s, warm[i]);
          EXPECT_NEAR(warm[i].separation, cold[i].separation, 2e-6 * radius(pairs[i]));
        }
      }
      left.push_back(features);
    });
    for (const std::vector<uint64_t>& features : left) EXPECT_EQ(features, left[0]);
    const size_t isas = left.size();
    for (size_t count = 1; count <= kMostFeatures; ++count) {
      EXPECT_GT(recalls[count], isas * pairs.size() / 100) << count << " corners";
    }
    EXPECT_GT(recalls[1] + recalls[2] + recalls[3] + recalls[4], isas * pairs.size() / 2);
  }
}

TEST(Recall, OfAnyCornersKeepsDecisionsAndSeparations) {
  const std::vector<TestPair> pairs = random_pairs(rounds(400, 50), 1, 3);
  Random random(4);
  for (const Measured measured : {Measured::all, Measured::separate}) {
    Call call = call_of(measured);
    call.detail = Detail::manifold;
    const std::vector<Row> cold = run(pairs, call, nullptr);
    std::vector<uint64_t> features(pairs.size());
    for (uint64_t& f : features) {
      f = random.below(uint64_t{1} << 56) | uint64_t{random.below(6)} << 56;
      if (random.chance(0.1)) f = ~uint64_t{0};
    }
    for_each_isa([&] {
      std::vector<uint64_t> handed_in = features;
      const std::vector<Row> warm = run(pairs, call, &handed_in);
      for (size_t i = 0; i < pairs.size(); ++i) {
        ASSERT_EQ(warm[i].overlap, cold[i].overlap) << i;
        if (warm[i].overlap && measured == Measured::all) {
          ASSERT_TRUE(same_bits(warm[i], cold[i])) << i;
        } else if (!warm[i].overlap) {
          ASSERT_NEAR(warm[i].separation, cold[i].separation, 2e-6 * radius(pairs[i])) << i;
        }
      }
    });
  }
}

// Counts that fill lanes or blocks only partly, and lists instead of rows.
TEST(Recall, OfAnyNumberOfPairs) {
  std::vector<TestPair> pairs = random_pairs(40, 1, 5);
  while (pairs.size() < 2100) pairs.push_back(pairs[pairs.size() % 40]);
  const Call call = call_of(Measured::separate);
  std::vector<uint64_t> all(pairs.size());
  run(pairs, call, &all);
  const std::vector<Row> expected = run(pairs, call, nullptr);
  for (const size_t count : {0, 1, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 33, 1023, 1025, 2100}) {
    SCOPED_TRACE(count);
    for_each_isa([&] {
      std::vector<uint64_t> features(all.begin(), all.begin() + static_cast<ptrdiff_t>(count));
      const std::vector<uint64_t> before = features;
      const std::vector<Row> rows = run(std::span(pairs).first(count), call, &features);
      EXPECT_EQ(features, before);
      for (size_t i = 0; i < count; ++i) {
        ASSERT_EQ(rows[i].overlap, expected[i].overlap);
        ASSERT_TRUE(rows[i].overlap || same_bits(rows[i], expected[i])) << i;
      }
    });
  }
}

// Where nearly all rows have features, those that overlap still get their depths.
TEST(Recall, OfMostlySeparatePairsFindsDepthsOfTheOthers) {
  std::vector<TestPair> pairs = random_pairs(rounds(400, 100), 1, 7);
  const Call call = call_of(Measured::all);
  Random random(8);
  for (size_t i = 0; i < pairs.size(); ++i) {
    if (i % 20 == 7) {
      pairs[i].b.position = pairs[i].a.position;  // surely overlap
    } else {
      const double length = random.uniform(2.5, 4);
      const Eigen::Vector3d way = length * random.direction();
      pairs[i].b.position = stored(pairs[i].a.position + way, PositionType::float32);
    }
  }
  std::vector<uint64_t> known(pairs.size());
  run(pairs, call, &known);
  move(pairs, 1, 0.005, random);
  const std::vector<Row> cold = run(pairs, call, nullptr);
  for_each_isa([&] {
    std::vector<uint64_t> features = known;
    const std::vector<Row> warm = run(pairs, call, &features);
    size_t depths = 0;
    for (size_t i = 0; i < pairs.size(); ++i) {
      ASSERT_EQ(warm[i].overlap, cold[i].overlap) << i;
      if (!warm[i].overlap) continue;
      ASSERT_TRUE(same_bits(warm[i], cold[i])) << i;
      depths += feature_count(known[i]) == kMostFeatures ? 1 : 0;
    }
    EXPECT_GT(depths, pairs.size() / 40);
  });
}

TEST(Recall, LeavesWhatItDoesNotKnow) {
  std::vector<TestPair> pairs = random_pairs(6, 1, 6);
  for (TestPair& pair : pairs) pair.b.position = pair.a.position + Eigen::Vector3d(3, 0, 0);
  pairs[1].b.shape = Box{{0.5f, 0.5f, 0.5f}};
  pairs[2].a.shape = Sphere{0.5f};
  pairs[3].b.position.x() = NAN;
  const std::vector<uint64_t> handed_in(pairs.size(), 7);
  std::vector<uint64_t> features = handed_in;
  Call call = call_of(Measured::all);
  EXPECT_EQ(run(pairs, call, &features)[3].status, static_cast<uint8_t>(Status::invalid));
  EXPECT_NE(features[0], 7u);
  EXPECT_EQ(features[1], 7u);  // other kinds keep their entry
  EXPECT_EQ(features[2], 7u);
  // Calls that do not measure separate pairs, and tiers that prove decisions, leave the features
  // alone.
  for (const Measured measured : {Measured::overlapping, Measured::all}) {
    features = handed_in;
    call.measured = measured;
    call.accuracy.tier = measured == Measured::all ? Tier::exact : Tier::standard;
    run(pairs, call, &features);
    EXPECT_EQ(features, handed_in);
  }
}

TEST(Recall, FeaturesArePackedWhole) {
  Features features{4, {127, 0, 5, 64}, {1, 126, 127, 33}};
  const Features back = unpack_features(pack_features(features));
  EXPECT_EQ(back.count, 4u);
  EXPECT_EQ(back.of_a, features.of_a);
  EXPECT_EQ(back.of_b, features.of_b);
  EXPECT_EQ(pack_features({}), kNoFeatures);
}

}  // namespace
}  // namespace carom::test

// Overlaps and nearest bodies of shapes, against collide() for every pair.
#include "carom/queries/queries.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "carom/base/thread_arena.h"
#include "carom/narrowphase/collide.h"
#include "carom/queries/cast.h"
#include "tests/support/query_bodies.h"

namespace carom::test {
namespace {

constexpr float kNoLimit = std::numeric_limits<float>::infinity();

std::vector<OverlapHit> expected_overlaps(const std::vector<PlacedShape>& queries,
                                          const std::vector<PlacedShape>& bodies,
                                          PositionType positions) {
  const LaidOut a(queries, {.positions = positions}), b(bodies, {.positions = positions});
  const std::vector<Pair> pairs = all_pairs(queries, bodies);
  std::vector<uint8_t> overlap(pairs.size());
  EXPECT_TRUE(
      bool(collide(a.view(), b.view(), pairs, Detail::overlap, {.overlap = overlap.data()})));
  std::vector<OverlapHit> hits;
  for (size_t i = 0; i < pairs.size(); ++i) {
    if (overlap[i]) hits.push_back({pairs[i].a, pairs[i].b});
  }
  return hits;
}

struct Measurements {
  std::vector<float> separation;
  std::array<std::vector<float>, 9> vectors;
  std::vector<uint8_t> status;
  std::vector<uint32_t> sub_shape;

  explicit Measurements(size_t count) : separation(count), status(count), sub_shape(count) {
    for (std::vector<float>& column : vectors) column.resize(count);
  }

  ResultColumns columns() {
    const auto three = [this](size_t i) -> std::array<float*, 3> {
      return {vectors[i].data(), vectors[i + 1].data(), vectors[i + 2].data()};
    };
    return {.status = status.data(),
            .separation = separation.data(),
            .normal = three(0),
            .point_a = three(3),
            .point_b = three(6),
            .sub_b = sub_shape.data()};
  }

  std::string row(size_t i) const {
    std::string text = std::to_string(separation[i]) + " " + std::to_string(status[i]) + " " +
                       std::to_string(sub_shape[i]);
    for (const std::vector<float>& column : vectors) {
      text.append(reinterpret_cast<const char*>(&column[i]), sizeof(float));
    }
    return text;
  }
};

std::string row_of(const NearestHit& hit) {
  std::string text = std::to_string(hit.separation) + " " +
                     std::to_string(static_cast<int>(hit.status)) + " " +
                     std::to_string(hit.sub_shape);
  for (const Eigen::Vector3f* v : {&hit.normal, &hit.point_query, &hit.point_body}) {
    text.append(reinterpret_cast<const char*>(v->data()), 3 * sizeof(float));
  }
  return text;
}

// For every query the row of its nearest body.
struct Nearest {
  Pair pair;
  std::string row;
  bool operator==(const Nearest& other) const {
    return pair.a == other.pair.a && pair.b == other.pair.b && row == other.row;
  }
};

std::vector<Nearest> expected_nearest(const std::vector<PlacedShape>& queries,
                                      const std::vector<PlacedShape>& bodies, float within,
                                      PositionType positions) {
  const LaidOut a(queries, {.positions = positions}), b(bodies, {.positions = positions});
  const std::vector<Pair> pairs = all_pairs(queries, bodies);
  Measurements all(pairs.size());
  EXPECT_TRUE(bool(collide(a.view(), b.view(), pairs, Detail::contact, all.columns(),
                           {.frame = WitnessFrame::body})));
  std::vector<Nearest> nearest;
  for (size_t i = 0; i < pairs.size();) {
    const uint32_t query = pairs[i].a;
    size_t best = pairs.size();
    for (; i < pairs.size() && pairs[i].a == query; ++i) {
      if (!(all.separation[i] <= within) || all.separation[i] == kNoLimit) continue;
      if (best == pairs.size() || all.separation[i] < all.separation[best]) best = i;
    }
    if (best < pairs.size()) nearest.push_back({pairs[best], all.row(best)});
  }
  return nearest;
}

std::vector<Nearest> nearest_of(const std::vector<NearestHit>& hits) {
  std::vector<Nearest> nearest;
  for (const NearestHit& hit : hits) nearest.push_back({{hit.query, hit.body}, row_of(hit)});
  return nearest;
}

void expect_hits(const std::vector<PlacedShape>& queries, const std::vector<PlacedShape>& bodies,
                 PositionType positions = PositionType::float32,
                 Parallelism parallelism = Parallelism::none) {
  const LaidOut a(queries, {.positions = positions}), b(bodies, {.positions = positions});
  std::vector<OverlapHit> overlaps = {{1, 2}};
  ASSERT_TRUE(bool(find_overlaps(a.view(), b.view(), overlaps, {.parallelism = parallelism})));
  EXPECT_TRUE(overlaps == expected_overlaps(queries, bodies, positions));
  for (const float within : {-0.1f, 0.0f, 0.3f, kNoLimit}) {
    std::vector<NearestHit> nearest(1);
    ASSERT_TRUE(
        bool(find_nearest(a.view(), within, b.view(), nearest, {.parallelism = parallelism})));
    EXPECT_TRUE(nearest_of(nearest) == expected_nearest(queries, bodies, within, positions))
        << "within " << within << ", " << queries.size() << " queries, " << bodies.size()
        << " bodies, " << nearest.size() << " hits";
  }
}

TEST(Queries, AreWhatEveryPairSays) {
  for_each_isa([] {
    for (const PositionType positions : {PositionType::float32, PositionType::float64}) {
      for (const double distance : {0.0, 1e5}) {
        const BodiesSpec spec = {.count = 60, .distance = distance, .positions = positions};
        expect_hits(make_bodies(spec, 1), make_bodies(spec, 2), positions);
      }
    }
  });
}

TEST(Queries, OfEveryCount) {
  for (const size_t queries : {0, 1, 2, 17, 65}) {
    for (const size_t bodies : {0, 1, 7, 8, 9, 65}) {
      expect_hits(make_bodies({.count = queries}, queries), make_bodies({.count = bodies}, 100));
    }
  }
}

TEST(Queries, OfSimpleBodiesInACrowd) {
  BodiesSpec spec = {.count = 500, .side = 5, .composites = false, .halfspaces = 0.01};
  const std::vector<PlacedShape> bodies = make_bodies(spec, 3);
  spec.count = 100;
  expect_hits(make_bodies(spec, 4), bodies);
}

// More queries than one round searches for.
TEST(Queries, AreTheSameOnThreadsAndInAnyOrder) {
  const BodiesSpec spec = {.count = 9000, .side = 40, .composites = false, .halfspaces = 0.0005};
  const std::vector<PlacedShape> bodies = make_bodies(spec, 5);
  std::vector<PlacedShape> queries = make_bodies(spec, 6);
  const LaidOut b(bodies, {});
  std::vector<OverlapHit> overlaps;
  std::vector<NearestHit> nearest;
  const LaidOut a(queries, {});
  ASSERT_TRUE(bool(find_overlaps(a.view(), b.view(), overlaps)));
  ASSERT_TRUE(bool(find_nearest(a.view(), 1, b.view(), nearest)));
  EXPECT_GT(overlaps.size(), 1000u);
  EXPECT_GT(nearest.size(), 1000u);
  const std::vector<Nearest> expected = nearest_of(nearest);
  for (const int threads : {1, 2, 4}) {
    ThreadArena arena(threads);
    arena.run([&] {
      std::vector<OverlapHit> again;
      std::vector<NearestHit> nearest_again;
      ASSERT_TRUE(
          bool(find_overlaps(a.view(), b.view(), again, {.parallelism = arena.parallelism()})));
      ASSERT_TRUE(bool(find_nearest(a.view(), 1, b.view(), nearest_again,
                                    {.parallelism = arena.parallelism()})));
      EXPECT_TRUE(again == overlaps);
      EXPECT_TRUE(nearest_of(nearest_again) == expected);
    });
  }
  std::reverse(queries.begin(), queries.end());
  const auto last = static_cast<uint32_t>(queries.size() - 1);
  const LaidOut backwards(queries, {});
  std::vector<OverlapHit> again;
  ASSERT_TRUE(bool(find_overlaps(backwards.view(), b.view(), again)));
  for (OverlapHit& hit : again) hit.query = last - hit.query;
  std::stable_sort(again.begin(), again.end(),
                   [](const OverlapHit& x, const OverlapHit& y) { return x.query < y.query; });
  EXPECT_TRUE(again == overlaps);
}

TEST(Queries, WithinNothing) {
  const LaidOut bodies(make_bodies({}, 1), {});
  std::vector<NearestHit> hits(1);
  ASSERT_TRUE(bool(find_nearest(bodies.view(), std::nanf(""), bodies.view(), hits)));
  EXPECT_TRUE(hits.empty());
}

TEST(Queries, InAnyFloatMode) {
  const std::vector<PlacedShape> queries = make_bodies({.count = 40}, 1);
  const std::vector<PlacedShape> bodies = make_bodies({.count = 40}, 2);
  for (const FloatMode& mode : float_modes()) {
    SCOPED_TRACE(mode.name);
    const LaidOut a(queries, {}), b(bodies, {});
    std::vector<OverlapHit> overlaps;
    std::vector<NearestHit> nearest;
    {
      const ScopedFloatMode scoped(mode);
      (void)find_overlaps(a.view(), b.view(), overlaps);
      (void)find_nearest(a.view(), 1, b.view(), nearest);
    }
    EXPECT_TRUE(overlaps == expected_overlaps(queries, bodies, PositionType::float32));
    EXPECT_TRUE(nearest_of(nearest) == expected_nearest(queries, bodies, 1, PositionType::float32));
  }
}

// Records 16 bytes apart of which 12 are there: the last one ends where memory does.
TEST(Queries, ReadNoFourthNumberOfPoints) {
  for (const RadiusLayout radius : {RadiusLayout::none, RadiusLayout::column}) {
    for (const size_t count : {1, 3, 4, 5, 8, 16, 64}) {
      std::vector<PlacedShape> shapes;
      for (size_t i = 0; i < count; ++i) {
        shapes.push_back(
            sphere(static_cast<double>(i), 0, 0, radius == RadiusLayout::none ? 0 : 1));
      }
      const LaidOut points(shapes, {.radius = radius, .stride = 16});
      const std::vector<float> ways(3 * count, 1.0f);
      for_each_isa([&] {
        std::vector<CastHit> hits;
        EXPECT_TRUE(bool(cast(points.view(), {.displacement = ways.data()}, points.view(), hits)));
        EXPECT_EQ(hits.size(), count);
      });
    }
  }
}

}  // namespace
}  // namespace carom::test

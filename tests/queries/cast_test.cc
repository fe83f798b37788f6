// Casts equal time_of_impact() of every pair.
#include "carom/queries/cast.h"

#include <gtest/gtest.h>

#include <cfloat>
#include <numeric>
#include <span>

#include "carom/base/thread_arena.h"
#include "tests/support/cast_checks.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

using Points = std::vector<Eigen::Vector3f>;

std::vector<CastHit> cast_all(const Collidables& queries, const SweepView& sweep,
                              const Collidables& bodies, CastHits which,
                              Parallelism parallelism = Parallelism::none) {
  std::vector<CastHit> hits(3);
  const Result<void> done =
      cast(queries, sweep, bodies, hits, {.hits = which, .parallelism = parallelism});
  EXPECT_TRUE(bool(done)) << done.error().message;
  return hits;
}

// Both kinds of casts find the hits of all pairs; returns their number.
size_t expect_hits(const std::vector<PlacedShape>& queries, const Sweeps& sweeps,
                   const std::vector<PlacedShape>& bodies,
                   PositionType positions = PositionType::float32) {
  const LaidOut a(queries, {.positions = positions}), b(bodies, {.positions = positions});
  const std::vector<CastHit> expected =
      brute_force(a.view(), sweeps.view(), b.view(), all_pairs(queries, bodies));
  const std::vector<CastHit> all = cast_all(a.view(), sweeps.view(), b.view(), CastHits::all);
  EXPECT_TRUE(bits_of(all) == bits_of(expected)) << show(all, expected);
  const std::vector<CastHit> closest =
      cast_all(a.view(), sweeps.view(), b.view(), CastHits::closest);
  EXPECT_TRUE(bits_of(closest) == bits_of(closest_of(expected)))
      << show(closest, closest_of(expected));
  return expected.size();
}

TEST(Cast, OfBodiesOfAllKindsAtBodiesOfAllKinds) {
  for_each_isa([] {
    for (const PositionType positions : {PositionType::float32, PositionType::float64}) {
      for (const bool turn : {false, true}) {
        const BodiesSpec spec = {.count = 40, .side = 3, .positions = positions};
        const size_t hits = expect_hits(make_bodies(spec, 1), make_sweeps(40, 5, turn, 3),
                                        make_bodies(spec, 2), positions);
        EXPECT_GT(hits, 40u);
        EXPECT_LT(hits, 800u);
      }
    }
  });
}

TEST(Cast, FarFromTheOrigin) {
  const BodiesSpec spec = {.count = 40, .distance = 3e5, .positions = PositionType::float64};
  EXPECT_GT(expect_hits(make_bodies(spec, 1), make_sweeps(40, 5, true, 3), make_bodies(spec, 2),
                        PositionType::float64),
            40u);
}

TEST(Cast, OfEveryCount) {
  for (const size_t queries : {0, 1, 2, 17, 33}) {
    for (const size_t bodies : {0, 1, 7, 8, 9, 65}) {
      expect_hits(make_bodies({.count = queries}, queries),
                  make_sweeps(queries, 5, queries % 2 == 0, 1), make_bodies({.count = bodies}, 9));
    }
  }
}

TEST(Cast, WithoutASweepIsAnOverlap) {
  expect_hits(make_bodies({.count = 40}, 1), {}, make_bodies({.count = 40}, 2));
}

// --- Rays ---

// Rays at the sides, edges and corners of boxes, rays along them, and rays that start inside.
void add_hard_rays(const PlacedShape& body, oracle::Random& random, Points& origins,
                   Points& directions) {
  const auto* box = std::get_if<Aabb>(&body.shape);
  const Eigen::Vector3f p = body.position.cast<float>();
  Eigen::Vector3f lower = p - Eigen::Vector3f::Constant(0.3f);
  Eigen::Vector3f upper = p + Eigen::Vector3f::Constant(0.3f);
  if (box) {
    lower = p + box->lower;
    upper = p + box->upper;
  }
  const auto on_surface = [&] {
    Eigen::Vector3f point;
    for (int axis = 0; axis < 3; ++axis) {
      const double kind = random.uniform(0, 1);
      point[axis] = kind < 0.4 ? lower[axis] : kind < 0.8 ? upper[axis] : p[axis];
    }
    return point;
  };
  const auto add = [&](const Eigen::Vector3f& from, const Eigen::Vector3f& way) {
    origins.push_back(from);
    directions.push_back(way);
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {1.0f, -1.0f}) {
      Eigen::Vector3f way = Eigen::Vector3f::Zero();
      way[axis] = sign;
      add(on_surface() - way, way);  // towards the surface and along it
      add(on_surface(), way);        // from the surface
      add(p, way * FLT_MAX / 4);     // from inside, as far as floats allow
      way[(axis + 1) % 3] = FLT_TRUE_MIN;
      add(on_surface() - way, way);     // hardly tilted
      add(on_surface(), way * 1e-38f);  // hardly any length
    }
  }
  add(on_surface(), Eigen::Vector3f::Zero());
  const Eigen::Vector3f from = on_surface() - random.direction().cast<float>();
  add(from, on_surface() - from);
}

TEST(Cast, RaysThatAreHard) {
  BodiesSpec spec = {.count = 60, .composites = false, .invalid = 0};
  std::vector<PlacedShape> bodies = make_bodies(spec, 5);
  oracle::Random random(1);
  Points origins, directions;
  for (size_t i = 0; i < 20; ++i) add_hard_rays(bodies[i], random, origins, directions);
  for (size_t i = 0; i < bodies.size(); i += 3) {
    // With these extents most corners are exact floats.
    bodies[i] = box(bodies[i].position, {0.5f, 0.25f, 0.75f});
    add_hard_rays(bodies[i], random, origins, directions);
  }
  const LaidOut b(bodies, {});
  const Rays rays(origins[0].data(), directions[0].data(), origins.size(), 1);
  const std::vector<PlacedShape> as_bodies(origins.size(), sphere(0, 0, 0, 0));
  const std::vector<CastHit> expected =
      brute_force(rays.queries(), rays.sweep(), b.view(), all_pairs(as_bodies, bodies));
  EXPECT_GT(expected.size(), origins.size());
  for_each_isa([&] {
    const std::vector<CastHit> all =
        cast_all(rays.queries(), rays.sweep(), b.view(), CastHits::all);
    EXPECT_TRUE(bits_of(all) == bits_of(expected)) << show(all, expected);
    const std::vector<CastHit> closest =
        cast_all(rays.queries(), rays.sweep(), b.view(), CastHits::closest);
    EXPECT_TRUE(bits_of(closest) == bits_of(closest_of(expected)))
        << show(closest, closest_of(expected));
  });
}

// A row of boxes along a ray that starts on a face: the ray hits every box.
TEST(Cast, ARayMeetsEveryBoxOfARow) {
  std::vector<PlacedShape> bodies;
  for (int i = 0; i < 100; ++i) bodies.push_back(box({2.0 * i, 0, 0}, {0.5f, 0.5f, 0.5f}));
  const LaidOut b(bodies, {});
  const Points origins = {{-1, 0, 0}, {-1, 0.5f, 0}, {-1, 0.5f, -0.5f}, {199, -0.5f, 0}};
  const Points directions = {{1, 0, 0}, {1, 0, -0.0f}, {1, 0, 0}, {-1, -0.0f, 0}};
  const Rays rays(origins[0].data(), directions[0].data(), origins.size(), 250);
  const std::vector<CastHit> all = cast_all(rays.queries(), rays.sweep(), b.view(), CastHits::all);
  ASSERT_EQ(all.size(), 400u);
  for (size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].body, i < 300 ? i % 100 : 399 - i);
    EXPECT_NEAR(all[i].toi * 250, 0.5 + 2 * static_cast<double>(i % 100), 1e-4);
  }
  EXPECT_TRUE(bits_of(cast_all(rays.queries(), rays.sweep(), b.view(), CastHits::closest)) ==
              bits_of(closest_of(all)));
}

TEST(Cast, AmongSubnormals) {
  const double unit = 0x1p-149;
  std::vector<PlacedShape> bodies, queries;
  for (int i = 0; i < 40; ++i) {
    bodies.push_back(sphere(10 * i * unit, 0, 3 * (i % 3) * unit, 3 * unit));
    queries.push_back(sphere(-20 * unit, 0, (i - 20) * unit, (i % 2) * unit));
  }
  Sweeps sweeps;
  for (int i = 0; i < 40; ++i)
    sweeps.displacement.push_back({static_cast<float>(300 * unit), 0, 0});
  EXPECT_GT(expect_hits(queries, sweeps, bodies), 100u);
}

TEST(Cast, FailsForAKindThatIsNone) {
  const LaidOut bodies(std::vector<PlacedShape>{sphere(1, 2, 3, 1)}, {});
  std::vector<float> record = {1, 2, 3, 100};
  Collidables query = sphere_records(record.data(), 1);
  std::vector<CastHit> hits(2);
  query.uniform_kind = static_cast<ShapeKind>(77);
  for (const CastHits which : {CastHits::all, CastHits::closest, CastHits::any}) {
    const Result<void> done = cast(query, {}, bodies.view(), hits, {.hits = which});
    EXPECT_TRUE(hits.empty());
    EXPECT_FALSE(bool(done));
  }
}

TEST(Cast, OfEqualTimesTheLowestBody) {
  std::vector<PlacedShape> bodies;
  for (int i = 0; i < 50; ++i) bodies.push_back(box({0, 0.01 * i, 0}, {0.5f, 2, 2}));
  const LaidOut b(bodies, {});
  const Points origin = {{-2, 0, 0}}, direction = {{1, 0, 0}};
  const Rays ray(origin[0].data(), direction[0].data(), 1, 4);
  const std::vector<CastHit> hits =
      cast_all(ray.queries(), ray.sweep(), b.view(), CastHits::closest);
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_EQ(hits[0].body, 0u);
  EXPECT_NEAR(hits[0].toi, 1.5 / 4, 1e-6);
  EXPECT_NEAR(hits[0].normal.x(), 1, 1e-6);
  EXPECT_NEAR(hits[0].point.x(), -0.5, 1e-6);
}

// --- Ways to call it ---

TEST(Cast, IsTheSameOnThreadsAndInAnyOrder) {
  const BodiesSpec spec = {.count = 4500, .side = 45, .composites = false, .halfspaces = 0.0005};
  const std::vector<PlacedShape> bodies = make_bodies(spec, 5);
  std::vector<PlacedShape> queries = make_bodies(spec, 6);
  Sweeps sweeps = make_sweeps(queries.size(), 10, false, 7);
  const LaidOut a(queries, {}), b(bodies, {});
  constexpr CastHits kWhich[] = {CastHits::all, CastHits::closest};
  constexpr int kThreadCounts[] = {4, 2, 1};
  for (const CastHits which : std::span(kWhich).first(rounds(2))) {
    const std::vector<CastHit> expected = cast_all(a.view(), sweeps.view(), b.view(), which);
    EXPECT_GT(expected.size(), 500u);
    for (const int threads : std::span(kThreadCounts).first(rounds(3))) {
      ThreadArena arena(threads);
      arena.run([&] {
        EXPECT_TRUE(bits_of(cast_all(a.view(), sweeps.view(), b.view(), which,
                                     arena.parallelism())) == bits_of(expected));
      });
    }
    std::vector<PlacedShape> backwards(queries.rbegin(), queries.rend());
    Sweeps backwards_sweeps{{sweeps.displacement.rbegin(), sweeps.displacement.rend()}, {}};
    const LaidOut c(backwards, {});
    std::vector<CastHit> again = cast_all(c.view(), backwards_sweeps.view(), b.view(), which);
    for (CastHit& hit : again) hit.query = static_cast<uint32_t>(queries.size() - 1) - hit.query;
    std::stable_sort(again.begin(), again.end(),
                     [](const CastHit& x, const CastHit& y) { return x.query < y.query; });
    EXPECT_TRUE(bits_of(again) == bits_of(expected));
  }
}

TEST(Cast, InAnyFloatMode) {
  const LaidOut a(make_bodies({.count = 30}, 1), {}), b(make_bodies({.count = 30}, 2), {});
  const Sweeps sweeps = make_sweeps(30, 5, true, 3);
  const std::vector<CastHit> expected =
      cast_all(a.view(), sweeps.view(), b.view(), CastHits::closest);
  for (const FloatMode& mode : float_modes()) {
    std::vector<CastHit> hits;
    {
      const ScopedFloatMode scoped(mode);
      (void)cast(a.view(), sweeps.view(), b.view(), hits);
    }
    EXPECT_TRUE(bits_of(hits) == bits_of(expected)) << mode.name;
  }
}

TEST(Rays, AreDirectionsTimesLength) {
  struct Record {
    float origin[3], more, direction[3];
  };
  const std::vector<Record> records = {{{1, 2, 3}, 0, {0, 0, 1}}, {{4, 5, 6}, 0, {1, -2, 0}}};
  const Rays rays(records[0].origin, records[0].direction, 2, 3, sizeof(Record), sizeof(Record));
  EXPECT_EQ(rays.queries().count, 2u);
  EXPECT_EQ(rays.queries().position.radius_layout, RadiusLayout::none);
  const float* displacement = rays.sweep().displacement;
  EXPECT_EQ(std::vector<float>(displacement, displacement + 6),
            (std::vector<float>{0, 0, 3, 3, -6, 0}));
  EXPECT_EQ(Rays(nullptr, nullptr, 0, 1).queries().count, 0u);
}

}  // namespace
}  // namespace carom::test

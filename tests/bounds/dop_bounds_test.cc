// World-space k-DOPs: they contain the shape tightly, have the same bits on every ISA, and drop the
// pairs that a slab separates.
#include "carom/bounds/dop_bounds.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <numeric>

#include "carom/base/thread_arena.h"
#include "oracle/support_pair.h"
#include "tests/support/float_modes.h"
#include "tests/support/guarded.h"
#include "tests/support/isas.h"
#include "tests/support/kind_pairs.h"
#include "tests/support/layouts.h"
#include "tests/support/rounds.h"
#include "tests/support/show.h"
#include "tests/support/special_floats.h"

namespace carom::test {
namespace {

using Bodies = std::vector<PlacedShape>;
using Floats = std::vector<float>;
using Real = long double;

constexpr DopKind kDopKinds[] = {DopKind::k14, DopKind::k18, DopKind::k26};

Bodies make_solids(const ConvexFamily& family, ShapeKind kind, PositionType positions, size_t count,
                   uint64_t seed = 1) {
  Bodies bodies;
  for (const TestPair& pair :
       make_kind_pairs(family, {ShapeKind::sphere, kind}, positions, count, seed)) {
    bodies.push_back(pair.b);
    bodies.back().position = stored(pair.b.position, positions);
  }
  return bodies;
}

Bodies make_nonsense(size_t count, uint64_t seed = 1) {
  Bodies bodies;
  for (const ShapeKind kind : kConvexKinds) {
    for (const TestPair& pair : make_kind_nonsense({ShapeKind::sphere, kind}, count, seed)) {
      bodies.push_back(pair.b);
    }
  }
  for (const ShapeKind kind : kRoundKinds) {
    for (const TestPair& pair : make_kind_nonsense({ShapeKind::sphere, kind}, count, seed)) {
      bodies.push_back(pair.b);
    }
  }
  Random random(seed);
  for (size_t i = bodies.size(); i > 1; --i) std::swap(bodies[i - 1], bodies[random.below(i)]);
  return bodies;
}

Floats dops_of(const Bodies& bodies, DopKind kind, const Layout& layout = {},
               Parallelism parallelism = Parallelism::none) {
  const LaidOut set(bodies, layout);
  GuardedArray records(bodies.size(), dop_record_size(kind) * sizeof(float),
                       dop_record_size(kind) * sizeof(float));
  compute_dops(set.view(), {kind, records.as<float>()}, parallelism);
  const float* first = records.as<float>();
  return {first, first + bodies.size() * dop_record_size(kind)};
}

struct Ends {
  float lower, upper;
};

Ends ends_of(const Floats& records, DopKind kind, size_t body, size_t slab) {
  const size_t at = body * dop_record_size(kind) + place_in_record(slab - kBoundsSlabs);
  return {records[at], records[at + 4]};
}

std::string as_bytes(const Floats& floats) {
  return {reinterpret_cast<const char*>(floats.data()), floats.size() * sizeof(float)};
}

// The exact extent of the shape along a slab, and the slack that the slab may have.
struct ExactSlab {
  Real lower, upper, slack;
};

// By support points.
ExactSlab exact_slab_of_round(const PlacedShape& body, const Vec3<Real>& d) {
  const auto reach_of = [](const PlacedShape& placed, const Vec3<Real>& way) {
    const oracle::SupportShape shape = oracle::support_shape(placed.shape, placed.pose());
    return dot(shape.furthest(way), way) + shape.radius * length(way);
  };
  const PlacedShape at_origin{body.shape, {0, 0, 0}, body.orientation};
  Real size = 0;
  for (const Vec3<Real>& axis : {Vec3<Real>{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
    size += reach_of(at_origin, axis) + reach_of(at_origin, -axis);
  }
  return {-reach_of(body, -d), reach_of(body, d),
          0x1p-29L * size + 0x1p-48L * body.position.lpNorm<1>()};
}

ExactSlab exact_slab(const PlacedShape& body, const std::array<int8_t, 3>& direction) {
  const Vec3<Real> d{Real(direction[0]), Real(direction[1]), Real(direction[2])};
  if (is_round(kind_of(body.shape))) return exact_slab_of_round(body, d);
  const ConvexShape<Real> shape(body.shape, body.pose());
  ExactSlab slab{dot(shape.points[0], d), dot(shape.points[0], d), 0};
  for (const Vec3<Real>& point : shape.points) {
    slab.lower = std::min(slab.lower, dot(point, d));
    slab.upper = std::max(slab.upper, dot(point, d));
  }
  const Real reach = shape.radius * length(d);
  slab.lower -= reach;
  slab.upper += reach;
  const PlacedShape at_origin{body.shape, {0, 0, 0}, body.orientation};
  const Real size = ConvexShape<Real>(body.shape, at_origin.pose()).bounding_radius;
  const ShapeKind kind = kind_of(body.shape);
  const bool in_float32 = kind == ShapeKind::box || kind == ShapeKind::capsule;
  slab.slack = (in_float32 ? 0x1p-15L : 0x1p-29L) * size +
               (in_float32 ? 0x1p-20L : 0x1p-48L) * body.position.lpNorm<1>();
  if (const auto* triangle = std::get_if<Triangle>(&body.shape)) {
    slab.slack += 0x1p-23L * triangle->thickness;
  }
  return slab;
}

Real three_floats(float x) { return 3 * (std::nextafter(std::fabs(x), kInfinity) - std::fabs(x)); }

// Thick triangles with hardly any area have no reliable back and are given a radius instead; k-DOPs
// and hulls have the slabs of their box.
bool is_tight(const PlacedShape& body, const ConvexFamily& family) {
  const ShapeKind kind = kind_of(body.shape);
  if (kind == ShapeKind::dop || core_kind(kind) == ShapeKind::hull) return false;
  const auto* triangle = std::get_if<Triangle>(&body.shape);
  return triangle == nullptr || triangle->thickness == 0 ||
         (!family.degenerate && family.aspect < 100 &&
          family.placement != ConvexPlacement::lattice);
}

void expect_slabs_hold(const Bodies& bodies, DopKind kind, const ConvexFamily& family,
                       PositionType positions) {
  const Floats records = dops_of(bodies, kind, {.positions = positions});
  for (size_t i = 0; i < bodies.size(); ++i) {
    for (size_t s = kBoundsSlabs; s < slab_count(kind); ++s) {
      const Ends got = ends_of(records, kind, i, s);
      const ExactSlab exact = exact_slab(bodies[i], slab_directions(kind)[s]);
      const ShownIfFailed shown([&] { return show(bodies[i]) + ", slab " + std::to_string(s); });
      ASSERT_LE(got.lower, exact.lower);
      ASSERT_GE(got.upper, exact.upper);
      if (!is_tight(bodies[i], family)) continue;
      ASSERT_GE(got.lower, exact.lower - exact.slack - three_floats(got.lower));
      ASSERT_LE(got.upper, exact.upper + exact.slack + three_floats(got.upper));
    }
  }
}

TEST(DopBounds, HoldTheShapeAndLittleMore) {
  for (const ConvexFamily& family : convex_families()) {
    SCOPED_TRACE(family.name);
    for (const ShapeKind kind : kConvexKinds) {
      if (kind == ShapeKind::halfspace) continue;
      for (const PositionType positions : kPositionTypes) {
        const Bodies bodies = make_solids(family, kind, positions, 20);
        expect_slabs_hold(bodies, DopKind::k18, family, positions);
        expect_slabs_hold(bodies, DopKind::k26, family, positions);
        if (HasFatalFailure()) return;
      }
    }
  }
}

TEST(DopBounds, HoldRoundedShapes) {
  for (const ConvexFamily& family : convex_families()) {
    SCOPED_TRACE(family.name);
    for (const ShapeKind kind : {ShapeKind::rounded_box, ShapeKind::rounded_hull}) {
      for (const PositionType positions : kPositionTypes) {
        const Bodies bodies = make_solids(family, kind, positions, 20);
        expect_slabs_hold(bodies, DopKind::k26, family, positions);
        if (HasFatalFailure()) return;
      }
    }
  }
}

TEST(DopBounds, HoldRoundShapesAndLittleMore) {
  for (const ConvexFamily& family : convex_families()) {
    SCOPED_TRACE(family.name);
    for (const ShapeKind kind : kRoundKinds) {
      for (const PositionType positions : kPositionTypes) {
        const Bodies bodies = make_solids(family, kind, positions, 20);
        expect_slabs_hold(bodies, DopKind::k26, family, positions);
        if (HasFatalFailure()) return;
      }
    }
  }
}

TEST(DopBounds, SmallerKindsHaveTheSlabsOfTheLargest) {
  const Bodies bodies = make_nonsense(50);
  const Floats all = dops_of(bodies, DopKind::k26);
  for (const DopKind kind : {DopKind::k14, DopKind::k18}) {
    const Floats some = dops_of(bodies, kind);
    // A k18 does not have the slabs of the cube's corners.
    const size_t shift = kind == DopKind::k18 ? 4 : 0;
    for (size_t i = 0; i < bodies.size(); ++i) {
      for (size_t s = kBoundsSlabs; s < slab_count(kind); ++s) {
        const Ends got = ends_of(some, kind, i, s),
                   expected = ends_of(all, DopKind::k26, i, s + shift);
        ASSERT_EQ(got.lower, expected.lower);
        ASSERT_EQ(got.upper, expected.upper);
      }
    }
  }
}

TEST(DopBounds, OfTheSmallestKindAreTheBoundsAlone) {
  const Bodies bodies = {sphere(1, 2, 3, 1), sphere(9, 9, 9, 1)};
  EXPECT_TRUE(dops_of(bodies, DopKind::k6).empty());
  const std::vector<Pair> pairs(5, {0, 1});
  std::vector<uint8_t> overlap(5);
  EXPECT_EQ(drop_separate_dops({DopKind::k6, nullptr}, pairs, overlap.data()), 5u);
  EXPECT_EQ(overlap, std::vector<uint8_t>(5, 1));
}

TEST(DopBounds, OfInvalidBodiesAreEmptyAndOfHalfspacesInfinite) {
  const Bodies bodies = {sphere(NAN, 0, 0, 1), sphere(0, 0, 0, -1),
                         halfspace({1, 2, 3}, {1, 1, 1}, 4),
                         oriented_box({0, 0, 0}, {1, 1, 1}, {0, 0, 0, 0}),
                         capsule({0, 0, 0}, {0, INFINITY, 0}, {0, 0, 0}, 1)};
  for (const DopKind kind : kDopKinds) {
    const Floats records = dops_of(bodies, kind);
    for (size_t i = 0; i < bodies.size(); ++i) {
      const float lower = i == 2 ? -kInfinity : kInfinity;
      for (size_t s = kBoundsSlabs; s < slab_count(kind); ++s) {
        EXPECT_EQ(ends_of(records, kind, i, s).lower, lower);
        EXPECT_EQ(ends_of(records, kind, i, s).upper, -lower);
      }
    }
  }
}

// Positions and sums beyond the range of float32, or of float64.
TEST(DopBounds, OfBodiesBeyondTheRangeOfFloats) {
  const double far = std::numeric_limits<double>::max();
  const Bodies bodies = {sphere(far, far, far, 1), sphere(-far, -far, far, 1),
                         sphere(1e39, 0, 0, 1), sphere(3e38, 3e38, 0, 1),
                         box({3e38, 0, 0}, {3e38f, 3e38f, 3e38f})};
  for_each_isa([&] {
    const Floats records = dops_of(bodies, DopKind::k26, {.positions = PositionType::float64});
    for (size_t i = 0; i < bodies.size(); ++i) {
      for (size_t s = kBoundsSlabs; s < kMostSlabs; ++s) {
        const Ends got = ends_of(records, DopKind::k26, i, s);
        const ExactSlab exact = exact_slab(bodies[i], slab_directions(DopKind::k26)[s]);
        EXPECT_LE(got.lower, exact.lower);
        EXPECT_GE(got.upper, exact.upper);
        EXPECT_LE(got.lower, std::numeric_limits<float>::max());
        EXPECT_GE(got.upper, -std::numeric_limits<float>::max());
      }
    }
  });
}

TEST(DopBounds, HaveTheSameBitsOnEveryIsaInAnyLayoutAndFloatMode) {
  const Bodies bodies = make_nonsense(150);
  for (const PositionType positions : kPositionTypes) {
    for (const DopKind kind : kDopKinds) {
      const Layout plain{.positions = positions};
      const std::string expected = as_bytes(dops_of(bodies, kind, plain));
      Layout odd = plain;
      odd.stride = 64;
      odd.box_slots = true;
      odd.orientation_stride = 48;
      odd.rows = RowOrder::backwards;
      for_each_isa([&] {
        for (const FloatMode& mode : float_modes()) {
          const ScopedFloatMode scoped(mode);
          EXPECT_EQ(as_bytes(dops_of(bodies, kind, plain)), expected) << mode.name;
        }
        EXPECT_EQ(as_bytes(dops_of(bodies, kind, odd)), expected);
      });
    }
  }
}

TEST(DopBounds, AreTheSameOnThreads) {
  const Bodies bodies = make_nonsense(600);
  const std::string expected = as_bytes(dops_of(bodies, DopKind::k18));
  for (const int threads : {1, 2, 4}) {
    ThreadArena arena(threads);
    arena.run([&] {
      EXPECT_EQ(as_bytes(dops_of(bodies, DopKind::k18, {}, arena.parallelism())), expected);
    });
  }
}

TEST(DopBounds, OnlyThoseAskedForAreWritten) {
  const Bodies bodies = make_nonsense(400);
  const LaidOut set(bodies, {});
  const size_t size = dop_record_size(DopKind::k26);
  const Floats all = dops_of(bodies, DopKind::k26);
  std::vector<uint8_t> which(bodies.size());
  for (size_t i = 0; i < which.size(); ++i) which[i] = i % 7 == 0;
  Floats some(all.size(), 42);
  compute_dops(set.view(), {DopKind::k26, some.data()}, Parallelism::none, which);
  for (size_t i = 0; i < all.size(); ++i) EXPECT_EQ(some[i], which[i / size] ? all[i] : 42);
}

// --- Pairs ---

bool reference_overlap(const Floats& records, DopKind kind, Pair pair) {
  for (size_t s = kBoundsSlabs; s < slab_count(kind); ++s) {
    const Ends a = ends_of(records, kind, pair.a, s), b = ends_of(records, kind, pair.b, s);
    if (!(a.lower <= b.upper && b.lower <= a.upper)) return false;
  }
  return true;
}

std::vector<uint8_t> overlaps(const Floats& records, DopKind kind, const std::vector<Pair>& pairs,
                              Parallelism parallelism = Parallelism::none) {
  Floats copy = records;
  GuardedArray overlap(pairs.size(), 1, 1);
  const size_t count =
      drop_separate_dops({kind, copy.data()}, pairs, overlap.as<uint8_t>(), parallelism);
  std::vector<uint8_t> result(overlap.as<uint8_t>(), overlap.as<uint8_t>() + pairs.size());
  EXPECT_EQ(count, std::accumulate(result.begin(), result.end(), size_t{0}));
  return result;
}

// Records of small integers, so that many ends touch. Some slabs are empty, infinite or NaN.
Floats random_records(DopKind kind, size_t bodies, Random& random) {
  Floats records;
  for (size_t i = 0; i < bodies; ++i) {
    const bool empty = random.chance(0.05), infinite = random.chance(0.05);
    Floats record(dop_record_size(kind));
    for (size_t s = 0; s < record.size() / 2; ++s) {
      const bool used = s < extra_slab_count(kind);
      const auto lower = used ? static_cast<float>(random.below(8)) : 0;
      float* ends = &record[place_in_record(s)];
      ends[0] = empty ? kInfinity : infinite ? -kInfinity : lower;
      ends[4] = empty ? -kInfinity : infinite ? kInfinity : lower + 5;
    }
    if (random.chance(0.05)) record[random.below(4)] = NAN;
    records.insert(records.end(), record.begin(), record.end());
  }
  return records;
}

TEST(DopPairs, AreThoseOfTheScalarTestOnEveryIsaAtAnyCount) {
  Random random(1);
  for (const DopKind kind : kDopKinds) {
    const Floats records = random_records(kind, 200, random);
    std::vector<size_t> counts = {255, 256, 257, 4095, 4096, 4097, 9000};
    for (size_t count = 0; count <= 33; ++count) counts.push_back(count);
    for (const size_t count : counts) {
      std::vector<Pair> pairs(count);
      std::vector<uint8_t> expected(count);
      for (size_t i = 0; i < count; ++i) {
        pairs[i] = {static_cast<uint32_t>(random.below(200)),
                    static_cast<uint32_t>(random.below(200))};
        expected[i] = reference_overlap(records, kind, pairs[i]);
      }
      if (count == 9000) {
        const auto left = std::accumulate(expected.begin(), expected.end(), size_t{0});
        EXPECT_GT(left, count / 20);
        EXPECT_LT(left, count * 9 / 10);
      }
      for_each_isa([&] { EXPECT_EQ(overlaps(records, kind, pairs), expected); });
      ThreadArena arena(3);
      arena.run([&] { EXPECT_EQ(overlaps(records, kind, pairs, arena.parallelism()), expected); });
    }
  }
}

TEST(DopPairs, TouchingIsOverlap) {
  // Along (1, 1, 1) the nearest features of the two cubes are edges.
  for (const double gap : {0.0, 0.001}) {
    const Eigen::Quaternionf turned(Eigen::AngleAxisf(0.785398185f, Eigen::Vector3f::UnitZ()));
    const double way = 2 + gap;
    const Bodies bodies = {
        oriented_box({0, 0, 0}, {1, 1, 1}, turned),
        oriented_box({way * std::numbers::sqrt2 / 2, way * std::numbers::sqrt2 / 2, 0}, {1, 1, 1},
                     turned)};
    const Floats records = dops_of(bodies, DopKind::k18);
    EXPECT_EQ(overlaps(records, DopKind::k18, {{0, 1}})[0], gap == 0);
    EXPECT_EQ(overlaps(dops_of(bodies, DopKind::k14), DopKind::k14, {{0, 1}})[0], 1);
  }
}

// A pair that a test calls touching must not be dropped.
TEST(DopPairs, OfWhichTheReferenceSaysThatTheyOverlapAreKept) {
  size_t overlapping = 0, dropped = 0;
  for (const ConvexFamily& family : convex_families()) {
    for (const KindPair& kinds : supported_kind_pairs()) {
      for (const PositionType positions : kPositionTypes) {
        Bodies bodies;
        std::vector<uint8_t> overlap;
        for (const TestPair& pair : make_kind_pairs(family, kinds, positions, rounds(15, 3))) {
          bodies.push_back(pair.a);
          bodies.push_back(pair.b);
          overlap.push_back(reference_result(pair, positions).overlap);
        }
        std::vector<Pair> pairs;
        for (uint32_t i = 0; i < bodies.size(); i += 2) pairs.push_back({i, i + 1});
        const Floats records = dops_of(bodies, DopKind::k26, {.positions = positions});
        const std::vector<uint8_t> left = overlaps(records, DopKind::k26, pairs);
        for (size_t i = 0; i < pairs.size(); ++i) {
          EXPECT_GE(left[i], overlap[i]) << family.name << "\n"
                                         << show(bodies[2 * i]) << "\n"
                                         << show(bodies[2 * i + 1]);
          overlapping += overlap[i];
          dropped += !left[i];
        }
      }
    }
  }
  EXPECT_GT(overlapping, rounds(8000));
  EXPECT_GT(dropped, rounds(1000));
}

}  // namespace
}  // namespace carom::test

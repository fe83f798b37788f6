// Manifolds of hulls, found for many pairs at once whose faces differ: three corners, four, up to
// eight, more, or no known face.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <span>
#include <vector>

#include "tests/support/hull_pairs.h"
#include "tests/support/isas.h"
#include "tests/support/kind_checks.h"
#include "tests/support/rounds.h"
#include "tests/support/run.h"

namespace carom::test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr KindPair kKinds[] = {
    {ShapeKind::hull, ShapeKind::hull},    {ShapeKind::aabb, ShapeKind::hull},
    {ShapeKind::hull, ShapeKind::aabb},    {ShapeKind::box, ShapeKind::hull},
    {ShapeKind::hull, ShapeKind::box},     {ShapeKind::hull, ShapeKind::triangle},
    {ShapeKind::triangle, ShapeKind::hull}};

// --- What the pairs are ---

// How many corners the faces have that face the other shape, counted over all overlaps.
struct FacingFaces {
  size_t overlaps = 0, faces = 0;
  size_t three = 0, four = 0, up_to_eight = 0, more = 0, unknown = 0;

  void count(const TestPair& pair, const Row& row) {
    if (row.overlap == 0) return;
    ++overlaps;
    const Vector3f n(row.normal[0], row.normal[1], row.normal[2]);
    count_face(pair.a, n);
    count_face(pair.b, -n);
  }

 private:
  void count_face(const PlacedShape& body, const Vector3f& way) {
    const auto* hull = std::get_if<Hull>(&body.shape);
    if (!hull) return;
    ++faces;
    const HullGeometry& geometry = *hull->geometry;
    const HullFeatures* const features = geometry.features();
    if (!features || geometry.points().size() > kMostLanePoints) {
      ++unknown;
      return;
    }
    const Vector3f along = body.orientation.normalized().conjugate() * way;
    size_t best = 0;
    for (size_t f = 0; f < features->face_count(); ++f) {
      if (features->normal(f).dot(along) > features->normal(best).dot(along)) best = f;
    }
    const size_t corners = geometry.faces()[best].count;
    ++(corners == 3 ? three : corners == 4 ? four : corners <= 8 ? up_to_eight : more);
  }
};

void expect_all_kinds_of_faces(const FacingFaces& found, size_t pairs) {
  EXPECT_GT(found.overlaps, pairs * 3 / 10);
  EXPECT_LT(found.overlaps, pairs * 7 / 10);
  for (const size_t each :
       {found.three, found.four, found.up_to_eight, found.more, found.unknown}) {
    EXPECT_GT(each, found.faces / 25);
  }
}

// --- Lanes and reference ---

std::vector<Row> run_manifolds(std::span<const TestPair> pairs, PositionType positions,
                               WitnessFrame frame = WitnessFrame::world) {
  Call call = call_with(positions);
  call.detail = Detail::manifold;
  call.frame = frame;
  return run_rows(pairs, call);
}

constexpr size_t kPairs = 300;

class HullManifolds : public testing::TestWithParam<KindPair> {};

TEST_P(HullManifolds, EqualReference) {
  for (const PositionType positions : kPositionTypes) {
    SCOPED_TRACE(name(positions));
    FacingFaces facing;
    const uint32_t count = rounds(32);
    for (uint64_t seed = 0; seed < count && !HasFailure(); ++seed) {
      const std::vector<TestPair> pairs = make_hull_pairs(GetParam(), positions, kPairs, seed);
      const std::vector<Row> expected = expected_rows(pairs, positions, Detail::manifold);
      for (size_t i = 0; i < pairs.size(); ++i) facing.count(pairs[i], expected[i]);
      for_each_isa(
          [&] { EXPECT_TRUE(same_rows(expected, run_manifolds(pairs, positions), pairs)); });
    }
    expect_all_kinds_of_faces(facing, count * kPairs);
  }
}

// All pairs overlap, so that these are the counts of the manifold pass.
TEST_P(HullManifolds, EqualReferenceForCountsAroundLanes) {
  constexpr auto kPositions = PositionType::float32;
  std::vector<TestPair> pairs = make_hull_pairs(GetParam(), kPositions, 150, 2);
  std::vector<Row> expected = expected_rows(pairs, kPositions, Detail::manifold);
  size_t kept = 0;
  for (size_t i = 0; i < pairs.size(); ++i) {
    if (expected[i].overlap == 0) continue;
    pairs[kept] = pairs[i];
    expected[kept++] = expected[i];
  }
  ASSERT_GT(kept, 33u);
  for_each_isa([&] {
    for (const size_t count : {1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 32, 33}) {
      SCOPED_TRACE(count);
      const auto some = std::span(pairs).first(count);
      EXPECT_TRUE(
          same_rows(std::span(expected).first(count), run_manifolds(some, kPositions), some));
    }
  });
}

// A list with all kinds in turn.
TEST(HullManifoldsOfMixedKinds, EqualReference) {
  for (const PositionType positions : kPositionTypes) {
    std::vector<TestPair> pairs;
    for (uint64_t seed = 0; seed < rounds(200); ++seed) {
      for (const KindPair& kinds : kKinds) {
        pairs.push_back(make_hull_pairs(kinds, positions, 1, 1000 + seed)[0]);
      }
    }
    Call call = call_with(positions);
    call.detail = Detail::manifold;
    const std::vector<Row> expected = expected_rows(pairs, positions, Detail::manifold);
    for_each_isa([&] { EXPECT_TRUE(same_rows(expected, run_list(pairs, call), pairs)); });
  }
}

// --- Many faces ---

// Pairs of round hulls, whose faces are triangles: up to 252 of them.
std::vector<TestPair> make_round_pairs(size_t repeats) {
  Random random(5);
  std::vector<TestPair> pairs;
  constexpr size_t kCounts[] = {9, 10, 18, 33, 34, 35, 66, 98, 127, 128};
  for (size_t repeat = 0; repeat < repeats; ++repeat) {
    for (const size_t a : kCounts) {
      const size_t b = kCounts[random.below(std::size(kCounts))];
      const Points points_a = round_points(a, {1, 1, 1}, random);
      const Points points_b = round_points(b, {1, 1, 1}, random);
      const Vector3d at = random.direction() * random.uniform(1.2, 1.9);
      const Vector3f axis = random.direction().cast<float>();
      const auto angle = static_cast<float>(random.uniform(0.1, 3));
      pairs.push_back(
          {placed_hull(points_a),
           placed_hull(points_b, at, Eigen::Quaternionf(Eigen::AngleAxisf(angle, axis)))});
    }
  }
  return pairs;
}

// The index of the face of A whose normal is nearest to the contact's, in groups of 64.
size_t group_of_face(const TestPair& pair, const Row& row) {
  const HullFeatures& features = *std::get<Hull>(pair.a.shape).geometry->features();
  const Vector3f n(row.normal[0], row.normal[1], row.normal[2]);
  size_t best = 0;
  for (size_t f = 0; f < features.face_count(); ++f) {
    if (features.normal(f).dot(n) > features.normal(best).dot(n)) best = f;
  }
  return best / 64;
}

TEST(HullManifoldsOfManyFaces, EqualReference) {
  constexpr auto kPositions = PositionType::float32;
  const std::vector<TestPair> pairs = make_round_pairs(rounds(40));
  const std::vector<Row> expected = expected_rows(pairs, kPositions, Detail::manifold);
  std::array<size_t, 4> groups{};
  for (size_t i = 0; i < pairs.size(); ++i) {
    if (expected[i].overlap == 1) ++groups[group_of_face(pairs[i], expected[i])];
  }
  for (const size_t count : groups) EXPECT_GT(count, pairs.size() / 80);
  for_each_isa([&] { EXPECT_TRUE(same_rows(expected, run_manifolds(pairs, kPositions), pairs)); });
}

// --- Against the oracle ---

bool is_fit_for_oracle(const PlacedShape& body) {
  if (const auto* triangle = std::get_if<Triangle>(&body.shape)) {
    return !triangle->one_sided && triangle->inner_edges == 0;
  }
  const auto* hull = std::get_if<Hull>(&body.shape);
  // The oracle's time grows with the cube of the number of points.
  return !hull || hull->geometry->points().size() <= 40;
}

// Every point is on A, its separation leads to B along the normal, and none is deeper than the
// contact.
void expect_on_both(const TestPair& pair, PositionType positions, const Row& row) {
  EXPECT_LE(row.manifold_count, 4);
  EXPECT_EQ(row.manifold_count > 0, row.overlap == 1);
  if (row.overlap == 0) return;
  const oracle::ConvexShape<long double> a(pair.a.shape, pair.a.pose(), pair.a.position);
  const oracle::ConvexShape<long double> b(
      pair.b.shape, {stored(pair.b.position, positions), pair.b.orientation}, pair.a.position);
  const long double tolerance = 5e-6L * (a.bounding_radius + b.bounding_radius);
  const auto normal = vec3_as<long double>(row.normal);
  for (size_t i = 0; i < row.manifold_count; ++i) {
    const float separation = row.manifold.separation[i];
    EXPECT_GE(separation, row.separation);
    EXPECT_LE(separation, 0);
    const auto on_a = vec3_as<long double>(row.manifold.point[i]);
    EXPECT_LE(std::fabs(signed_distance(a, on_a)), tolerance) << "on A, point " << i;
    const auto on_b = on_a + normal * static_cast<long double>(separation);
    EXPECT_LE(std::fabs(signed_distance(b, on_b)), tolerance) << "on B, point " << i;
  }
}

TEST_P(HullManifolds, AreOnTheSurfacesOfBoth) {
  for (const PositionType positions : kPositionTypes) {
    std::vector<TestPair> pairs = make_hull_pairs(GetParam(), positions, rounds(800), 3);
    std::erase_if(pairs, [](const TestPair& pair) {
      return !is_fit_for_oracle(pair.a) || !is_fit_for_oracle(pair.b);
    });
    const std::vector<Row> rows = run_manifolds(pairs, positions, WitnessFrame::body);
    for (size_t i = 0; i < pairs.size(); ++i) {
      const ShownIfFailed shown(
          [&] { return show(pairs[i]) + "\n" + name(positions) + " " + show(rows[i]); });
      expect_on_both(pairs[i], positions, rows[i]);
      if (HasFailure()) return;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, HullManifolds, testing::ValuesIn(kKinds),
                         [](const auto& kinds) { return name(kinds.param); });

// --- A ridge under a face ---

// A ridge between two steep faces, with a flat face at one end. The flat face's normal is the one
// nearest to straight up.
const Points kBlade = {{-1, 0, 0.5f},     {1, 0, 0.5f},           {-2, -0.2f, -0.5f},
                       {-2, 0.2f, -0.5f}, {1.0625f, 0.2f, -0.5f}, {1.0625f, -0.2f, -0.5f}};

// The blade under slabs and triangles; a positive angle lifts its flat end.
std::vector<TestPair> make_blades(float angle) {
  const Eigen::Quaternionf turn(Eigen::AngleAxisf(angle, Vector3f::UnitY()));
  const Vector3f half(4, 4, 1), a(-9, -9, 0), b(0, 9, 0), c(9, -9, 0);
  const Vector3d above(0.3, 0.2, 1.45), plane(0, 0, 0.45);
  std::vector<TestPair> pairs;
  for (const PlacedShape& slab :
       {placed_hull(box_corners(half), above), oriented_box(above, half), box(above, half),
        triangle(plane, {a, b, c}), triangle(plane, {a, c, b})}) {
    pairs.push_back({placed_hull(kBlade, {0, 0, 0}, turn), slab});
  }
  return pairs;
}

void expect_ends_of_ridge(const TestPair& pair, const Row& row) {
  const ShownIfFailed shown([&] { return show(pair) + "\n" + show(row); });
  ASSERT_EQ(row.manifold_count, 2);
  const auto& points = row.manifold.point;
  const size_t first = points[0][0] < points[1][0] ? 0 : 1;
  for (size_t end = 0; end < 2; ++end) {
    const Vector3f p = Eigen::Map<const Vector3f>(points[(first + end) % 2].data());
    EXPECT_NEAR((p - pair.a.orientation * kBlade[end]).norm(), 0, 1e-5);
  }
}

void expect_ends_of_ridges(float angle) {
  SCOPED_TRACE(angle);
  const std::vector<TestPair> pairs = make_blades(angle);
  const std::vector<Row> expected = expected_rows(pairs, PositionType::float32, Detail::manifold);
  for_each_isa([&] {
    const std::vector<Row> rows = run_manifolds(pairs, PositionType::float32);
    EXPECT_TRUE(same_rows(expected, rows, pairs));
    for (size_t i = 0; i < pairs.size(); ++i) expect_ends_of_ridge(pairs[i], rows[i]);
  });
}

// The flat end is lower than the other one, so the face with the nearest normal must not count.
TEST(HullManifoldsOfBlades, AreTheEndsOfTheRidge) {
  for (const float angle : {1e-5f, 1e-3f, 1e-2f}) expect_ends_of_ridges(-angle);
}

// Only one point of the flat end touches, so that it is not the touching face although its normal
// is nearest.
TEST(HullManifoldsOfBlades, AreTheEndsOfTheRidgeWhateverIsBesideIt) {
  for (const float angle : {0.0f, 1e-3f}) expect_ends_of_ridges(angle);
}

// --- The area that two faces have in common ---

using Point2 = Eigen::Vector2d;
using Outline = std::vector<Point2>;

double left_of(const Point2& a, const Point2& b, const Point2& p) {
  const Point2 u = b - a, v = p - a;
  return u.x() * v.y() - u.y() * v.x();
}

// I. E. Sutherland and G. W. Hodgman, "Reentrant Polygon Clipping", CACM 17(1), 1974.
Outline common_area(Outline area, const Outline& other) {
  for (size_t k = 0; k < other.size(); ++k) {
    const Point2 &a = other[k], &b = other[(k + 1) % other.size()];
    Outline rest;
    for (size_t i = 0; i < area.size(); ++i) {
      const Point2 &p = area[i], &q = area[(i + 1) % area.size()];
      const double of_p = left_of(a, b, p), of_q = left_of(a, b, q);
      if (of_p >= 0) rest.push_back(p);
      if (of_p * of_q < 0) rest.push_back(p + (q - p) * (of_p / (of_p - of_q)));
    }
    area = rest;
  }
  return area;
}

// The upper or lower face of a prism, seen from above.
Outline cap_of(const PlacedShape& body, size_t sides) {
  Outline outline;
  const Points points = points_of(std::get<Hull>(body.shape));
  for (size_t i = 0; i < sides; ++i) {
    const Vector3d p = body.orientation.cast<double>() * points[2 * i].cast<double>();
    outline.emplace_back((p + body.position).head<2>());
  }
  return outline;
}

struct Range {
  double least = HUGE_VAL, most = -HUGE_VAL;
};

template <class Value>
Range range_over(const Outline& corners, const Value& value) {
  Range range;
  for (const Point2& corner : corners) {
    range.least = std::min(range.least, value(corner));
    range.most = std::max(range.most, value(corner));
  }
  return range;
}

// The second point is as far from the first as any corner of the area, and the other points are as
// far as possible beside the line through both.
void expect_widest(const Outline& area, const Row& row) {
  Outline points;
  for (size_t i = 0; i < row.manifold_count; ++i) {
    points.emplace_back(row.manifold.point[i][0], row.manifold.point[i][1]);
    EXPECT_NEAR(row.manifold.point[i][2], 0.5, 2e-6);
    EXPECT_NEAR(row.manifold.separation[i], -0.01, 4e-6);
    for (size_t k = 0; k < area.size(); ++k) {
      const Point2 &a = area[k], &b = area[(k + 1) % area.size()];
      EXPECT_GE(left_of(a, b, points[i]), -1e-5 * (b - a).norm()) << "outside, point " << i;
    }
  }
  ASSERT_GE(points.size(), 3u);
  const auto distance = [&](const Point2& p) { return (p - points[0]).norm(); };
  const auto beside = [&](const Point2& p) { return left_of(points[0], points[1], p); };
  EXPECT_NEAR(distance(points[1]), range_over(area, distance).most, 1e-4);
  EXPECT_NEAR(range_over(points, beside).most, range_over(area, beside).most, 1e-4);
  EXPECT_NEAR(range_over(points, beside).least, range_over(area, beside).least, 1e-4);
}

TEST(HullManifoldsOfPrisms, AreAsWideAsTheCommonArea) {
  struct Sides {
    size_t a, b;
  };
  Random random(4);
  std::vector<TestPair> pairs;
  std::vector<Sides> sides;
  for (size_t a = 3; a <= 12; ++a) {
    for (size_t b = 3; b <= 12; ++b) {
      const auto angle = static_cast<float>(random.uniform(0.02, 3));
      const Eigen::Quaternionf turn(Eigen::AngleAxisf(angle, Vector3f::UnitZ()));
      const Vector3d at(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), 0.99);
      pairs.push_back(
          {placed_hull(prism(a, 1, 0.5f)), placed_hull(prism(b, 0.8f, 0.5f), at, turn)});
      sides.push_back({a, b});
    }
  }
  for_each_isa([&] {
    const std::vector<Row> rows = run_manifolds(pairs, PositionType::float64, WitnessFrame::body);
    for (size_t i = 0; i < pairs.size() && !HasFailure(); ++i) {
      const ShownIfFailed shown([&] { return show(pairs[i]) + "\n" + show(rows[i]); });
      expect_widest(common_area(cap_of(pairs[i].a, sides[i].a), cap_of(pairs[i].b, sides[i].b)),
                    rows[i]);
    }
  });
}

}  // namespace
}  // namespace carom::test

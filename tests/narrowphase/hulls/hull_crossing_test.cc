// Crossings of the edges of two solids, many against many: in lanes the same as one by one, and the
// best one as in long double.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "narrowphase/hulls/hull_steps.h"
#include "narrowphase/hulls/hull_steps_scalar.h"
#include "oracle/random.h"
#include "oracle/vec3.h"
#include "tests/support/isas.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using oracle::Random;
using Turn = scalar::Rotation<float>;
using Vec = oracle::Vec3<long double>;

// Counts around the lanes of all targets, and the greatest one.
constexpr size_t kCounts[] = {0, 1, 3, 4, 5, 7, 8, 9, 15, 16, 17, 32, 33, 63, kMostCrossed};

struct Edge {
  Vector3f from, direction, left, right;
};

// Open edges that share no face and no point with each other.
struct Edges {
  size_t count;
  std::array<Edge, kMostCrossed> edge;
};

// Edges behind the last open one would win if the kernel read them.
template <class Make>
Edges edges_of(size_t count, const Make& make) {
  Edges edges;
  edges.count = count;
  for (size_t k = 0; k < kMostCrossed; ++k) {
    edges.edge[k] = make();
    if (k >= count) edges.edge[k].from *= 1e6f;
  }
  return edges;
}

// The parts of a solid that crossings look at. Every other edge of the solid is open.
class EdgeSolid {
 public:
  explicit EdgeSolid(const Edges& edges) {
    open_.count = edges.count;
    for (uint16_t k = 0; k < kMostCrossed; ++k) {
      const Edge& edge = edges.edge[k];
      const Vector3f& d = edge.direction;
      const uint32_t left = 2u * k, right = left + 1;
      points_.push_back({edge.from.x(), edge.from.y(), edge.from.z(), 0});
      for (const Vector3f& n : {edge.left, edge.right}) planes_.push_back({n.x(), n.y(), n.z(), 0});
      edges_.push_back({{d.x(), d.y(), d.z(), 0}, k, left, right});
      edges_.push_back({{d.z(), d.x(), d.y(), 0}, k, right, left});
      if (k < edges.count) open_.index[k] = static_cast<uint16_t>(2 * k);
    }
    for (size_t i = 0; i < 4; ++i) {
      for (const auto& plane : planes_) plane_[i].push_back(plane[i]);
      for (const auto& point : points_) point_[i].push_back(point[i]);
      solid_.plane[i] = plane_[i].data();
      if (i < 3) solid_.point[i] = point_[i].data();
    }
    solid_.point_record = points_.data();
    solid_.plane_record = planes_.data();
    solid_.edge_count = edges_.size();
    solid_.edges = edges_.data();
  }
  EdgeSolid(const EdgeSolid&) = delete;
  EdgeSolid& operator=(const EdgeSolid&) = delete;

  CrossedEdges edges() { return {solid_, open_, of_dop_}; }

 private:
  std::vector<std::array<float, 4>> points_, planes_;
  std::array<std::vector<float>, 4> point_, plane_;
  std::vector<Solid::Edge> edges_;
  Solid solid_;
  OpenEdges open_;
  DopEdges of_dop_;  // not written
};

struct Crossed {
  Edges a, b;
  Turn turn;
  float gap;
  Vector3f offset = Vector3f::Zero();
};

Crossing cross(const HullSteps& steps, const Crossed& edges) {
  EdgeSolid a(edges.a), b(edges.b);
  return steps.cross(a.edges(), b.edges(), edges.turn, edges.offset, edges.gap);
}

void expect_same_in_lanes(const Crossed& edges, const Crossing& expected) {
  for_each_isa([&] {
    const Crossing found = cross(hull_steps_in_lanes(), edges);
    EXPECT_EQ(expected.is_doubtful, found.is_doubtful);
    EXPECT_EQ(expected.exists, found.exists);
    EXPECT_EQ(expected.gap, found.gap);  // 0 and -0 count as equal: a gap of zero is no depth
    EXPECT_EQ(expected.of_a, found.of_a);
    EXPECT_EQ(expected.of_b, found.of_b);
  });
}

Vector3f integers(Random& random, int most) {
  const auto one = [&] {
    return static_cast<float>(random.below(static_cast<uint64_t>(2 * most + 1))) -
           static_cast<float>(most);
  };
  const float x = one(), y = one(), z = one();
  return {x, y, z};
}

// An edge as a solid has it: its direction is perpendicular to both face normals.
Edge solid_edge(Random& random) {
  const Vector3d left = random.direction();
  const Vector3d right = (left + random.direction() * random.uniform(0.2, 2)).normalized();
  return {random.direction().cast<float>(), left.cross(right).normalized().cast<float>(),
          left.cast<float>(), right.cast<float>()};
}

// An edge along an axis, with small integers everywhere: nothing rounds, and gaps tie.
Edge integer_edge(Random& random) {
  const Vector3f axis = Vector3f::Unit(static_cast<int>(random.below(3)));
  return {integers(random, 2), random.chance(0.5) ? axis : Vector3f(-axis), integers(random, 2),
          integers(random, 2)};
}

// Most edges are nearly parallel to the x axis, some exactly.
Edge parallel_edge(Random& random) {
  const double tilt = random.chance(0.2) ? 0 : random.log_uniform(1e-5, 1e-1);
  const Vector3d direction = (Vector3d::UnitX() + tilt * random.direction()).normalized();
  return {random.direction().cast<float>(), direction.cast<float>(),
          random.direction().cast<float>(), random.direction().cast<float>()};
}

Turn any_turn(Random& random) {
  const Vector3f v = random.direction().cast<float>() * static_cast<float>(random.uniform(-1, 1));
  return scalar::rotation_of(
      scalar::Quaternion<float>{v, static_cast<float>(random.uniform(0.1, 1))});
}

Turn quarter_turns(Random& random) {
  const Turn turns[] = {{Vector3f::UnitX(), Vector3f::UnitY(), Vector3f::UnitZ()},
                        {Vector3f::UnitY(), Vector3f::UnitZ(), Vector3f::UnitX()},
                        {Vector3f::UnitX(), Vector3f::UnitZ(), Vector3f(0, -1, 0)},
                        {Vector3f(0, -1, 0), Vector3f::UnitX(), Vector3f::UnitZ()}};
  return turns[random.below(4)];
}

// Every two counts, in several rounds each.
template <class MakeEdge, class MakeTurn, class Check>
void for_each_counts(uint64_t seed, uint32_t count_each, const MakeEdge& make_edge,
                     const MakeTurn& make_turn, const Check& check) {
  Random random(seed);
  for (const size_t count_a : kCounts) {
    for (const size_t count_b : kCounts) {
      SCOPED_TRACE(std::to_string(count_a) + " and " + std::to_string(count_b));
      for (uint32_t round = 0; round < count_each; ++round) {
        const auto edge = [&] { return make_edge(random); };
        Crossed edges{edges_of(count_a, edge), edges_of(count_b, edge), make_turn(random), 0};
        edges.offset = integers(random, 1);
        edges.gap = static_cast<float>(random.chance(0.2) ? -1e30 : random.uniform(-2, 1.5));
        check(edges);
        if (testing::Test::HasFailure()) return;
      }
    }
  }
}

TEST(HullCrossings, InLanesAreThoseOfTheReference) {
  size_t all = 0, existing = 0;
  for_each_counts(1, rounds(16), solid_edge, any_turn, [&](Crossed& edges) {
    const Crossing expected = cross(scalar::kHullSteps, edges);
    ++all;
    existing += expected.exists;
    expect_same_in_lanes(edges, expected);
    if (!expected.exists) return;
    // A crossing counts only if it is better than the best face.
    edges.gap = expected.gap;
    EXPECT_FALSE(cross(scalar::kHullSteps, edges).exists);
    expect_same_in_lanes(edges, cross(scalar::kHullSteps, edges));
  });
  EXPECT_GT(existing, all * 3 / 10);
  EXPECT_LT(existing, all * 7 / 10);
}

// The best crossing of axis-parallel edges in integers.
struct BestOfIntegers {
  bool exists = false;
  int gap = 0;
  size_t of_a = 0, of_b = 0;
  size_t ties = 0;
};

BestOfIntegers best_of_integers(const Crossed& edges) {
  const auto as_int = [](const Vector3f& v) -> Eigen::Vector3i { return v.cast<int>(); };
  const auto turned = [&](const Vector3f& v) { return as_int(scalar::rotate(edges.turn, v)); };
  BestOfIntegers best;
  for (size_t i = 0; i < edges.a.count; ++i) {
    const Edge& edge_a = edges.a.edge[i];
    const auto direction = as_int(edge_a.direction);
    const auto left = as_int(edge_a.left), right = as_int(edge_a.right);
    for (size_t k = 0; k < edges.b.count; ++k) {
      const Edge& edge_b = edges.b.edge[k];
      const auto other = turned(edge_b.direction);
      const int of_left = turned(edge_b.left).dot(direction);
      const int of_right = turned(edge_b.right).dot(direction);
      const int on_left = left.dot(other), on_right = right.dot(other);
      const auto n = direction.cross(other);
      const bool crosses = of_left * of_right < 0 && on_left * on_right < 0 &&
                           of_right * on_left < 0 && n.squaredNorm() > 0;
      if (!crosses) continue;
      const int along = n.dot(turned(edge_b.from) + as_int(edges.offset) - as_int(edge_a.from));
      const int gap = n.dot(left + right) < 0 ? -along : along;
      if (!(static_cast<float>(gap) > edges.gap)) continue;
      best.ties = best.exists && gap < best.gap    ? best.ties
                  : best.exists && gap == best.gap ? best.ties + 1
                                                   : 0;
      if (!best.exists || gap > best.gap) best = {true, gap, i, k, 0};
    }
  }
  return best;
}

TEST(HullCrossings, OfEqualsTheFirst) {
  size_t all = 0, existing = 0, tied = 0, later_edge_of_b = 0;
  for_each_counts(2, rounds(16), integer_edge, quarter_turns, [&](const Crossed& edges) {
    const Crossing expected = cross(scalar::kHullSteps, edges);
    const BestOfIntegers best = best_of_integers(edges);
    ++all;
    existing += best.exists;
    tied += best.ties > 0;
    later_edge_of_b += best.ties > 0 && best.of_b >= 4;
    ASSERT_EQ(best.exists, expected.exists);
    if (best.exists) {
      EXPECT_EQ(static_cast<float>(best.gap), expected.gap);
      EXPECT_EQ(best.of_a, expected.of_a);
      EXPECT_EQ(best.of_b, expected.of_b);
    }
    expect_same_in_lanes(edges, expected);
  });
  EXPECT_GT(existing, all * 3 / 10);
  EXPECT_GT(tied, all * 15 / 100);
  EXPECT_GT(later_edge_of_b, all * 5 / 100);
}

// The axis across two parallel edges is undefined: such a pair is doubtful and gives no gap.
TEST(HullCrossings, OfParallelEdgesAreDoubtful) {
  size_t all = 0, doubtful = 0;
  for_each_counts(3, rounds(16), parallel_edge, quarter_turns, [&](const Crossed& edges) {
    const Crossing expected = cross(scalar::kHullSteps, edges);
    ++all;
    doubtful += expected.is_doubtful;
    EXPECT_FALSE(std::isnan(expected.gap));
    expect_same_in_lanes(edges, expected);
  });
  EXPECT_GT(doubtful, all / 10);
  EXPECT_LT(doubtful, all * 7 / 10);
}

TEST(HullCrossings, OfOneParallelPairAmongManyEdges) {
  Random random(4);
  for (size_t at = 0; at < kMostCrossed; ++at) {
    // All other edges lie along x and cannot cross.
    const auto apart = [] { return Edge{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}}; };
    Crossed edges{edges_of(kMostCrossed, apart), edges_of(kMostCrossed, apart), {}, -1};
    edges.turn = {Vector3f::UnitX(), Vector3f::UnitY(), Vector3f::UnitZ()};
    const size_t of_a = random.below(kMostCrossed);
    edges.a.edge[of_a].left = {-1, 0, 1};
    edges.a.edge[of_a].right = {1, 0, 1};
    edges.b.edge[at].left = {-1, 0, -1};
    edges.b.edge[at].right = {1, 0, -1};
    for (const float tilt : {0.0f, 0x1p-9f, 0x1p-8f, 0x1.1p-8f, 0x1p-4f}) {
      edges.b.edge[at].direction = {1, tilt, 0};
      const Crossing expected = cross(scalar::kHullSteps, edges);
      EXPECT_EQ(expected.is_doubtful, tilt <= 0x1p-8f) << tilt;
      EXPECT_EQ(expected.exists, tilt > 0) << tilt;
      if (expected.exists) {
        EXPECT_EQ(expected.of_a, of_a);
        EXPECT_EQ(expected.of_b, at);
      }
      expect_same_in_lanes(edges, expected);
    }
  }
}

// --- Against long double ---

// The best axis that lies on the arc between the normals of an edge of A, and, reversed, on that of
// an edge of B.
struct BestOfAll {
  bool exists = false;
  bool is_clear = true;  // no other axis is so near that rounding could prefer it
  long double gap = 0;
  size_t of_a = 0, of_b = 0;
};

// How far n is inside the arc between two normals; all three lie in one plane.
long double inside_arc(const Vec& left, const Vec& right, const Vec& n) {
  const Vec axis = oracle::normalized(oracle::cross(left, right));
  return std::min(dot(oracle::cross(left, n), axis), dot(oracle::cross(n, right), axis));
}

BestOfAll best_of_all(const Crossed& edges) {
  constexpr long double kNear = 1e-4L;
  const Turn& r = edges.turn;
  const auto vec = [](const Vector3f& v) { return oracle::vec3_as<long double>(v); };
  const auto turned = [&](const Vector3f& of_b) {
    const Vec v = vec(of_b);
    return oracle::vec3_as<long double>(r.x) * v.x + oracle::vec3_as<long double>(r.y) * v.y +
           oracle::vec3_as<long double>(r.z) * v.z;
  };
  struct Found {
    long double gap;
    bool is_sure;
    size_t i, k;
  };
  std::vector<Found> all;
  for (size_t i = 0; i < edges.a.count; ++i) {
    for (size_t k = 0; k < edges.b.count; ++k) {
      const Edge &a = edges.a.edge[i], &b = edges.b.edge[k];
      const Vec across = oracle::cross(vec(a.direction), turned(b.direction));
      const Vec apart = turned(b.from) + vec(edges.offset) - vec(a.from);
      for (const long double way : {1.0L, -1.0L}) {
        const Vec n = oracle::normalized(across) * way;
        const long double inside = std::min(inside_arc(vec(a.left), vec(a.right), n),
                                            inside_arc(turned(b.left), turned(b.right), -n));
        const long double rounding = kNear / oracle::length(across);
        if (inside < -rounding) continue;
        all.push_back({dot(n, apart), inside > rounding && rounding < 100 * kNear, i, k});
      }
    }
  }
  BestOfAll best{.gap = edges.gap};
  for (const Found& found : all) {
    if (found.is_sure && found.gap > best.gap) best = {true, true, found.gap, found.i, found.k};
  }
  size_t near = 0;
  for (const Found& found : all) near += found.gap > best.gap - (found.is_sure ? kNear : 0.1L);
  best.is_clear = near == (best.exists ? 1 : 0);
  return best;
}

TEST(HullCrossings, AreTheBestInLongDouble) {
  size_t all = 0, clear = 0, existing = 0;
  for_each_counts(5, rounds(16), solid_edge, any_turn, [&](const Crossed& edges) {
    const BestOfAll best = best_of_all(edges);
    ++all;
    if (!best.is_clear) return;
    ++clear;
    existing += best.exists;
    const Crossing found = cross(hull_steps_in_lanes(), edges);
    ASSERT_EQ(best.exists, found.exists);
    if (!best.exists) return;
    EXPECT_NEAR(static_cast<double>(best.gap), found.gap, 1e-4);
    EXPECT_EQ(best.of_a, found.of_a);
    EXPECT_EQ(best.of_b, found.of_b);
  });
  EXPECT_GT(clear, all * 7 / 10);
  EXPECT_GT(existing, clear * 3 / 10);
  EXPECT_LT(existing, clear * 7 / 10);
}

}  // namespace
}  // namespace carom::test

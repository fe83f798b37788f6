// Casts at meshes equal time_of_impact() of every triangle alone, which searches no tree.
#include <gtest/gtest.h>

#include <cmath>

#include "carom/queries/cast.h"
#include "tests/support/cast_checks.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

using Eigen::Vector3f;
using Vector3l = Eigen::Matrix<long double, 3, 1>;

const MeshGeometry& geometry_of(const PlacedShape& body) {
  return *std::get<Mesh>(body.shape).geometry;
}

Triangle triangle_of(const MeshGeometry& mesh, size_t index) {
  Triangle triangle;
  triangle.corners = mesh.corners(index);
  triangle.thickness = mesh.rules().thickness;
  triangle.one_sided = mesh.rules().one_sided;
  return triangle;
}

struct FirstHit {
  float toi = INFINITY;
  std::vector<uint32_t> triangles;  // that are met at this time
};

// The first hits of all queries, by a test of every triangle.
std::vector<FirstHit> hits_of_triangles(const Collidables& queries, const SweepView& sweep,
                                        const PlacedShape& mesh, PositionType positions) {
  std::vector<PlacedShape> triangles;
  std::vector<uint32_t> index;
  for (uint32_t i = 0; i < geometry_of(mesh).triangles().size(); ++i) {
    if (geometry_of(mesh).is_degenerate(i)) continue;
    triangles.push_back({triangle_of(geometry_of(mesh), i), mesh.position, mesh.orientation});
    index.push_back(i);
  }
  const LaidOut bodies(triangles, {.positions = positions});
  std::vector<Pair> pairs;
  for (uint32_t q = 0; q < queries.count; ++q) {
    for (uint32_t i = 0; i < triangles.size(); ++i) pairs.push_back({q, i});
  }
  std::vector<float> toi(pairs.size());
  EXPECT_TRUE(bool(time_of_impact(queries, sweep, bodies.view(), {}, pairs, {.toi = toi.data()})));
  std::vector<FirstHit> hits(queries.count);
  for (size_t i = 0; i < pairs.size(); ++i) {
    FirstHit& first = hits[pairs[i].a];
    if (!(toi[i] <= 1) || toi[i] > first.toi) continue;
    if (toi[i] < first.toi) first = {toi[i], {}};
    first.triangles.push_back(index[pairs[i].b]);
  }
  return hits;
}

// Returns the share of queries that hit.
double expect_first_hits(const Collidables& queries, const SweepView& sweep,
                         const PlacedShape& mesh, PositionType positions) {
  const std::vector<FirstHit> expected = hits_of_triangles(queries, sweep, mesh, positions);
  const LaidOut body(std::vector<PlacedShape>{mesh}, {.positions = positions});
  std::vector<CastHit> hits;
  EXPECT_TRUE(bool(cast(queries, sweep, body.view(), hits)));
  size_t next = 0;
  for (uint32_t q = 0; q < queries.count; ++q) {
    const bool meets = next < hits.size() && hits[next].query == q;
    EXPECT_EQ(meets, expected[q].toi <= 1) << "query " << q;
    if (!meets) continue;
    const CastHit& hit = hits[next++];
    EXPECT_EQ(hit.toi, expected[q].toi) << "query " << q;
    EXPECT_NE(std::find(expected[q].triangles.begin(), expected[q].triangles.end(), hit.sub_shape),
              expected[q].triangles.end());
  }
  EXPECT_EQ(next, hits.size());
  return static_cast<double>(hits.size()) / static_cast<double>(queries.count);
}

// Bumpy terrain, or triangles anywhere.
PlacedShape make_mesh_body(Composites& composites, bool terrain, const MeshRules& rules,
                           double distance) {
  oracle::Random& random = composites.random();
  PlacedShape body;
  if (terrain) {
    body.shape = grid_mesh(
        12, 0.5f, [](float x, float y) { return 0.4f * std::sin(3 * x) * std::cos(2 * y); }, rules);
  } else {
    std::vector<Vector3f> vertices;
    Triangles triangles;
    for (uint32_t i = 0; i < 120; ++i) {
      const Vector3f at = (random.direction() * random.uniform(0, 3)).cast<float>();
      for (int k = 0; k < 3; ++k) {
        vertices.push_back(at + (random.direction() * random.uniform(0, 0.8)).cast<float>());
      }
      triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    body.shape = mesh_of(vertices, triangles, rules);
  }
  body.position = random.direction() * (distance + random.uniform(0, 1));
  body.orientation = random.chance(0.3) ? Eigen::Quaternionf::Identity() : composites.orientation();
  return body;
}

// A motion from somewhere near the mesh; some motions are long, along an axis, or none.
Vector3f motion_towards(const Eigen::Vector3d& from, const PlacedShape& mesh,
                        oracle::Random& random) {
  const Eigen::Vector3d target = mesh.position + random.direction() * random.uniform(0, 3);
  Eigen::Vector3d way = (target - from) * random.uniform(0.3, 2);
  if (random.chance(0.1)) way *= random.log_uniform(1, 1e12);
  for (int axis = 0; axis < 3; ++axis) {
    if (random.chance(0.1)) way[axis] = 0;
  }
  return way.cast<float>();
}

void expect_shapes_hit(bool points, double least, double most) {
  Composites composites(points ? 5 : 6);
  oracle::Random& random = composites.random();
  constexpr ShapeKind kKinds[] = {ShapeKind::sphere, ShapeKind::capsule, ShapeKind::box,
                                  ShapeKind::aabb,   ShapeKind::hull,    ShapeKind::triangle};
  double share = 0;
  constexpr int kRounds = 24;
  for (int round = 0; round < kRounds; ++round) {
    const MeshRules rules = {.one_sided = round % 3 == 1, .thickness = round % 6 == 4 ? 0.1f : 0};
    const bool far = round % 4 == 3;
    const PositionType positions = far ? PositionType::float64 : PositionType::float32;
    const PlacedShape mesh = make_mesh_body(composites, round % 2 == 0, rules, far ? 1e5 : 0);
    std::vector<PlacedShape> queries;
    Sweeps sweeps;
    for (uint32_t i = 0; i < (points ? rounds(150, 24) : rounds(24, 12)); ++i) {
      PlacedShape query = sphere(0, 0, 0, 0);
      if (!points) query.shape = composites.simple(kKinds[i % std::size(kKinds)], 0.3);
      query.orientation = composites.orientation();
      query.position = mesh.position + random.direction() * random.uniform(1, 5);
      sweeps.displacement.push_back(motion_towards(query.position, mesh, random));
      queries.push_back(query);
    }
    const LaidOut laid_out(queries, {.positions = positions});
    share += expect_first_hits(laid_out.view(), sweeps.view(), mesh, positions) / kRounds;
  }
  EXPECT_GT(share, least);
  EXPECT_LT(share, most);
}

TEST(MeshCast, RaysHitTheFirstTriangle) { expect_shapes_hit(true, 0.3, 0.8); }
TEST(MeshCast, ShapesHitTheFirstTriangle) { expect_shapes_hit(false, 0.3, 0.9); }

// Rays at vertices and edges of a terrain on a lattice, along its edges, and in planes of faces.
TEST(MeshCast, RaysAtVerticesAndEdges) {
  for (const bool one_sided : {false, true}) {
    PlacedShape mesh;
    mesh.shape =
        grid_mesh(8, 1, [](float x, float) { return std::abs(x); }, {.one_sided = one_sided});
    mesh.orientation = Eigen::Quaternionf::Identity();
    std::vector<Vector3f> origins, directions;
    for (const Vector3f& vertex : geometry_of(mesh).vertices()) {
      for (const Vector3f& target : {vertex, Vector3f(vertex + Vector3f(0.5f, 0, 0.5f)),
                                     Vector3f(vertex + Vector3f(0, 0.25f, 0))}) {
        for (const Vector3f& from : {Vector3f(0, 0, 3), Vector3f(0, 0, -3), Vector3f(1, 2, 5),
                                     Vector3f(0, 3, 0), Vector3f(3, 0, 3)}) {
          origins.push_back(target + from);
          directions.push_back(from * -1.5f);
        }
      }
    }
    const Rays rays(origins[0].data(), directions[0].data(), origins.size(), 1);
    const double share =
        expect_first_hits(rays.queries(), rays.sweep(), mesh, PositionType::float32);
    EXPECT_GT(share, 0.3);
  }
}

// --- Rays against an oracle in long double ---

struct Crossing {
  long double time;
  bool is_sure;
};

// Where a ray crosses a triangle; is_sure: not near its border, or the ends of the ray.
std::optional<Crossing> crossing(const Vector3l& from, const Vector3l& way, const Triangle& t) {
  const Vector3l a = t.corners[0].cast<long double>(), u = t.corners[1].cast<long double>() - a,
                 v = t.corners[2].cast<long double>() - a;
  const Vector3l normal = u.cross(v);
  const long double rate = -way.dot(normal);
  if (std::abs(rate) < 1e-6L * way.norm() * normal.norm()) return Crossing{0, false};
  const long double time = (from - a).dot(normal) / rate;
  const Vector3l at = from + way * time - a;
  const long double area = normal.squaredNorm();
  const long double p = at.cross(v).dot(normal) / area, q = u.cross(at).dot(normal) / area;
  const long double inside = std::min({p, q, 1 - p - q, time, 1 - time});
  if (inside < -1e-7L) return std::nullopt;
  return Crossing{time, inside > 1e-7L};
}

TEST(MeshCast, RaysEqualAnOracleInLongDouble) {
  const Mesh shape =
      grid_mesh(20, 0.3f, [](float x, float y) { return 0.5f * std::sin(4 * x + y); });
  PlacedShape mesh = {shape, Eigen::Vector3d::Zero(), Eigen::Quaternionf::Identity()};
  oracle::Random random(8);
  std::vector<Vector3f> origins, directions;
  const uint32_t count = rounds(3000);
  for (uint32_t i = 0; i < count; ++i) {
    origins.push_back((random.direction() * random.uniform(0, 4)).cast<float>());
    directions.push_back((random.direction() * random.uniform(0.1, 8)).cast<float>());
  }
  const Rays rays(origins[0].data(), directions[0].data(), origins.size(), 1);
  const LaidOut body(std::vector<PlacedShape>{mesh}, {});
  std::vector<CastHit> hits;
  ASSERT_TRUE(bool(cast(rays.queries(), rays.sweep(), body.view(), hits)));
  std::vector<const CastHit*> hit_of(origins.size());
  for (const CastHit& hit : hits) hit_of[hit.query] = &hit;
  size_t sure = 0;
  for (size_t i = 0; i < origins.size(); ++i) {
    long double first = 2, first_unsure = 2;
    const Vector3l from = origins[i].cast<long double>(), way = directions[i].cast<long double>();
    for (size_t k = 0; k < geometry_of(mesh).triangles().size(); ++k) {
      const auto met = crossing(from, way, triangle_of(geometry_of(mesh), k));
      if (met)
        (met->is_sure ? first : first_unsure) =
            std::min(met->is_sure ? first : first_unsure, met->time);
    }
    if (first_unsure < std::min(first, 1.5L)) continue;
    ++sure;
    ASSERT_EQ(hit_of[i] != nullptr, first <= 1) << i;
    if (!hit_of[i]) continue;
    const CastHit& hit = *hit_of[i];
    EXPECT_LE(hit.toi, first);
    EXPECT_NEAR(hit.toi, static_cast<double>(first), 1e-6);
    // The normal is that of the triangle, away from the side that the ray comes from.
    const Triangle t = triangle_of(geometry_of(mesh), hit.sub_shape);
    const Vector3f normal = (t.corners[1] - t.corners[0]).cross(t.corners[2] - t.corners[0]);
    EXPECT_NEAR(std::abs(hit.normal.dot(normal.normalized())), 1, 1e-5);
    EXPECT_GT(hit.normal.dot(directions[i]), 0);
    EXPECT_NEAR((origins[i] + hit.toi * directions[i] - hit.point).norm(), 0, 1e-5);
  }
  EXPECT_GT(sure, rounds(2500));
  EXPECT_GT(hits.size(), rounds(900));
  EXPECT_LT(hits.size(), rounds(2500));
}

// --- Backfaces ---

std::vector<CastHit> cast_at(const Collidables& queries, const SweepView& sweep,
                             const PlacedShape& body, CastHits which, Backfaces backfaces) {
  const LaidOut laid_out(std::vector<PlacedShape>{body}, {});
  std::vector<CastHit> hits;
  EXPECT_TRUE(
      bool(cast(queries, sweep, laid_out.view(), hits, {.hits = which, .backfaces = backfaces})));
  return hits;
}

// A ray is met from the front however long it is beside the triangles.
TEST(MeshCast, RaysMeetOneSidedMeshesFromTheFrontAlone) {
  oracle::Random random(4);
  const Mesh flat = grid_mesh(4, 0.5f, [](float, float) { return 0.0f; }, {.one_sided = true});
  const PlacedShape body = {flat, {0.1, 0.2, 0.3}, Eigen::Quaternionf(0.9f, 0.1f, 0.2f, -0.3f)};
  const Eigen::Quaterniond turn = body.orientation.cast<double>().normalized();
  const Eigen::Vector3d front = turn * Eigen::Vector3d::UnitZ();
  std::vector<PlacedShape> queries;
  Sweeps sweeps;
  std::vector<bool> from_front;
  for (int i = 0; i < 2000; ++i) {
    const double length = random.log_uniform(0.1, 1e5);
    Eigen::Vector3d way = random.direction() * length;
    if (std::fabs(way.dot(front)) < 0.05 * length) way += length * front;
    const Eigen::Vector3d aim =
        turn * Eigen::Vector3d(random.uniform(-0.9, 0.9), random.uniform(-0.9, 0.9), 0);
    PlacedShape query = sphere(0, 0, 0, 0);
    query.position = body.position + aim - random.uniform(0.1, 0.9) * way;
    queries.push_back(query);
    sweeps.displacement.push_back(way.cast<float>());
    from_front.push_back(way.dot(front) < 0);
  }
  const LaidOut a(queries, {});
  for (const CastHits which : {CastHits::closest, CastHits::any, CastHits::all}) {
    for_each_isa([&] {
      std::vector<bool> is_hit(queries.size());
      for (const CastHit& hit : cast_at(a.view(), sweeps.view(), body, which, Backfaces::as_made)) {
        is_hit[hit.query] = true;
      }
      EXPECT_EQ(is_hit, from_front);
    });
  }
}

TEST(MeshCast, BackfacesAreAsIfTheMeshWereMadeSo) {
  Composites composites(3);
  oracle::Random& random = composites.random();
  const auto terrain = [](float x, float y) { return 0.4f * std::sin(3 * x) * std::cos(2 * y); };
  const auto body_of = [&](bool one_sided, bool in_compound) {
    const Mesh mesh = grid_mesh(10, 0.5f, terrain, {.one_sided = one_sided});
    PlacedShape body = {mesh, {0.1, 0.2, 0.3}, Eigen::Quaternionf(0.9f, 0.1f, 0.2f, -0.3f)};
    if (in_compound) body.shape = compound_of({{mesh, {0.1f, 0, 0.2f}}});
    return body;
  };
  std::vector<PlacedShape> queries;
  Sweeps sweeps;
  for (int i = 0; i < 300; ++i) {
    PlacedShape query = sphere(0, 0, 0, i % 2 ? 0 : 0.2);
    query.position = random.direction() * random.uniform(1, 3);
    queries.push_back(query);
    sweeps.displacement.push_back((-2 * query.position).cast<float>() +
                                  random.direction().cast<float>());
  }
  const LaidOut a(queries, {});
  for (const bool in_compound : {false, true}) {
    const PlacedShape one = body_of(true, in_compound), two = body_of(false, in_compound);
    for (const CastHits which : {CastHits::closest, CastHits::all}) {
      const auto run = [&](const PlacedShape& body, Backfaces backfaces) {
        return cast_at(a.view(), sweeps.view(), body, which, backfaces);
      };
      const std::vector<CastHit> from_front = run(one, Backfaces::as_made);
      const std::vector<CastHit> from_both = run(two, Backfaces::as_made);
      EXPECT_GT(from_front.size(), 60u);
      EXPECT_GT(from_both.size(), 60u);
      EXPECT_GT(std::count_if(from_both.begin(), from_both.end(),
                              [&](const CastHit& hit) {
                                return bits_of(from_front).find(bits_of({hit})) ==
                                       std::string::npos;
                              }),
                60);
      EXPECT_EQ(bits_of(run(one, Backfaces::hit)), bits_of(from_both));
      EXPECT_EQ(bits_of(run(two, Backfaces::hit)), bits_of(from_both));
      EXPECT_EQ(bits_of(run(one, Backfaces::ignore)), bits_of(from_front));
      EXPECT_EQ(bits_of(run(two, Backfaces::ignore)), bits_of(from_front));
    }
  }
}

TEST(MeshCast, IsTheSameOnEveryIsa) {
  Composites composites(9);
  oracle::Random& random = composites.random();
  const PlacedShape mesh = make_mesh_body(composites, true, {}, 0);
  std::vector<Vector3f> origins, directions;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d from = random.direction() * random.uniform(1, 5);
    origins.push_back(from.cast<float>());
    directions.push_back(motion_towards(from, mesh, random));
  }
  const Rays rays(origins[0].data(), directions[0].data(), origins.size(), 1);
  std::vector<CastHit> expected;
  for_each_isa([&] {
    const std::vector<CastHit> hits =
        cast_at(rays.queries(), rays.sweep(), mesh, CastHits::closest, Backfaces::as_made);
    if (expected.empty()) expected = hits;
    EXPECT_EQ(bits_of(hits), bits_of(expected));
  });
  EXPECT_GT(expected.size(), 100u);
}

}  // namespace
}  // namespace carom::test

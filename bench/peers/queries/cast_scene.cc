#include "bench/peers/queries/cast_scene.h"

#include <cmath>

#include "carom/queries/queries.h"
#include "carom/shapes/mesh_geometry.h"
#include "oracle/hull_faces.h"

namespace carom::bench {
namespace {

constexpr size_t kHulls = 64, kCorners = 16;
constexpr double kRoom = 4;  // the cube root of the room of a body, in metres

float draw(oracle::Random& random, double low, double high) {
  return static_cast<float>(random.uniform(low, high));
}

// Corners on ellipsoids with half axes of 0.2 to 0.5 m.
void draw_hulls(CastWorld& world, oracle::Random& random) {
  for (size_t i = 0; i < kHulls; ++i) {
    const Eigen::Vector3f half(draw(random, 0.2, 0.5), draw(random, 0.2, 0.5),
                               draw(random, 0.2, 0.5));
    std::vector<Eigen::Vector3f> points(kCorners);
    for (auto& point : points) point = half.cwiseProduct(random.direction().cast<float>());
    world.hulls.push_back(oracle::hull_of(points));
    CastHull& plain = world.scene.hulls.emplace_back();
    for (const auto& point : points) plain.points.push_back({point.x(), point.y(), point.z()});
    const HullGeometry& geometry = *world.hulls.back().geometry;
    for (const HullGeometry::Face& face : geometry.faces()) {
      const auto outline = geometry.corners(face);
      plain.faces.emplace_back(outline.begin(), outline.end());
    }
  }
}

CastBody draw_body(CastShape shape, oracle::Random& random) {
  CastBody body = {shape, {}, {0, 0, 0, 1}, {}, random.below(kHulls)};
  for (float& size : body.size) size = draw(random, 0.2, 0.5);
  const Eigen::Quaternionf turn(Eigen::AngleAxisf(draw(random, 0, 2 * std::numbers::pi),
                                                  random.direction().cast<float>().normalized()));
  if (shape != CastShape::sphere) body.orientation = {turn.x(), turn.y(), turn.z(), turn.w()};
  return body;
}

ShapeKind kind_of(CastShape shape) {
  switch (shape) {
    case CastShape::sphere:
      return ShapeKind::sphere;
    case CastShape::capsule:
      return ShapeKind::capsule;
    case CastShape::box:
      return ShapeKind::box;
    case CastShape::hull:
      return ShapeKind::hull;
    default:
      return ShapeKind::mesh;
  }
}

}  // namespace

Shape CastWorld::shape_of(const CastBody& body) const {
  const auto [x, y, z] = body.size;
  switch (body.shape) {
    case CastShape::sphere:
      return Sphere{x};
    case CastShape::capsule:
      return Capsule{{0, 0, -y}, {0, 0, y}, x};
    case CastShape::box:
      return Box{{x, y, z}};
    case CastShape::hull:
      return hulls[body.hull];
    default:
      return Mesh{mesh};
  }
}

Pose CastWorld::pose_of(const CastBody& body) const {
  const auto& [x, y, z] = body.position;
  const auto& q = body.orientation;
  return {{x, y, z}, Orientation(q[3], q[0], q[1], q[2])};
}

World CastWorld::make_world() const {
  World world({.detail = Detail::pairs, .parallelism = Parallelism::none});
  for (const CastBody& body : scene.bodies) {
    const auto [position, orientation] = pose_of(body);
    world.add({.shape = shape_of(body),
               .position = position,
               .orientation = orientation,
               .motion = Motion::fixed});
  }
  world.step();
  world.prepare_queries();
  return world;
}

CastWorld make_yard(size_t bodies) {
  CastWorld world;
  oracle::Random random(1);
  draw_hulls(world, random);
  const double side = kRoom * std::cbrt(static_cast<double>(bodies));
  for (size_t i = 0; i < bodies; ++i) {
    CastBody body = draw_body(static_cast<CastShape>(i % 4), random);
    for (float& x : body.position) x = draw(random, 0, side);
    world.scene.bodies.push_back(body);
  }
  return world;
}

CastWorld make_terrain(uint32_t n) {
  CastWorld world;
  oracle::Random random(1);
  draw_hulls(world, random);
  std::vector<Eigen::Vector3f> vertices;
  for (uint32_t i = 0; i <= n; ++i) {
    for (uint32_t j = 0; j <= n; ++j) {
      const float x = 100.0f * float(i) / float(n), y = 100.0f * float(j) / float(n);
      vertices.push_back({x, y, 4 * std::sin(0.3f * x) * std::cos(0.2f * y) + std::sin(2 * x + y)});
      world.scene.vertices.push_back({x, y, vertices.back().z()});
      if (i == n || j == n) continue;
      const uint32_t at = i * (n + 1) + j;
      world.scene.triangles.push_back({at, at + n + 1, at + n + 2});
      world.scene.triangles.push_back({at, at + n + 2, at + 1});
    }
  }
  world.mesh = *make_mesh(vertices, world.scene.triangles);
  world.scene.bodies.push_back({CastShape::mesh, {}, {0, 0, 0, 1}, {}});
  return world;
}

CastArrays::CastArrays(const CastWorld& world, const CastList& list)
    : displacements_(list.displacements) {
  queries_.count = list.queries.size();
  queries_.uniform_kind = kind_of(list.queries[0].shape);
  for (const CastBody& query : list.queries) {
    const auto& p = query.position;
    const bool is_sphere = query.shape == CastShape::sphere;
    records_.push_back({p[0], p[1], p[2], is_sphere ? query.size[0] : 0});
    orientations_.push_back(query.orientation);
    const auto rows = shape_rows(world.shape_of(query));
    rows_.insert(rows_.end(), rows.begin(), rows.begin() + row_count(queries_.uniform_kind));
  }
  queries_.position = {.data = records_.data(), .stride = sizeof(records_[0])};
  queries_.orientation.data = orientations_[0].data();
  if (!rows_.empty()) queries_.rows.data = rows_[0].data();
}

Collidables CastArrays::query(size_t i) const {
  Collidables one = queries_;
  one.count = 1;
  one.position.data = &records_[i];
  one.orientation.data = orientations_[i].data();
  if (!rows_.empty()) one.rows.data = rows_[i * row_count(one.uniform_kind)].data();
  return one;
}

CastList draw_casts(const CastWorld& scene, const World& world, CastShape shape, float length,
                    size_t count) {
  oracle::Random random(2);
  const bool over_mesh = scene.mesh != nullptr;
  const double side =
      over_mesh ? 100 : kRoom * std::cbrt(static_cast<double>(scene.scene.bodies.size()));
  CastList free;
  while (free.queries.size() < count) {
    CastList drawn;
    for (size_t i = 0; i < count; ++i) {
      CastBody query = draw_body(shape, random);
      query.position = {draw(random, 0, side), draw(random, 0, side),
                        over_mesh ? draw(random, -5, 15) : draw(random, 0, side)};
      const Eigen::Vector3f way = (random.direction() * double{length}).cast<float>();
      drawn.queries.push_back(query);
      drawn.displacements.push_back({way.x(), way.y(), way.z()});
    }
    std::vector<OverlapHit> overlaps;
    world.find_overlaps(CastArrays(scene, drawn).queries(), overlaps);
    std::vector<bool> touches(count);
    for (const OverlapHit& hit : overlaps) touches[hit.query] = true;
    for (size_t i = 0; i < count && free.queries.size() < count; ++i) {
      if (touches[i]) continue;
      free.queries.push_back(drawn.queries[i]);
      free.displacements.push_back(drawn.displacements[i]);
    }
  }
  return free;
}

}  // namespace carom::bench

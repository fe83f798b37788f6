// A ray at a shape and the scaled ray at the scaled shape hit after the same share of their way,
// for all shapes that can be scaled.
#include <gtest/gtest.h>

#include <cmath>

#include "carom/shapes/scaled.h"
#include "tests/support/cast_checks.h"
#include "tests/support/composites.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

using Eigen::Vector3f;

struct RayOfShape {
  Vector3f from, way;
};

struct FirstHits {
  std::vector<float> time;
  std::vector<uint32_t> sub;
};

FirstHits first_hits(const std::vector<RayOfShape>& rays, const Shape& shape) {
  std::vector<PlacedShape> points;
  Sweeps sweeps;
  std::vector<Pair> pairs;
  for (const RayOfShape& ray : rays) {
    pairs.push_back({static_cast<uint32_t>(points.size()), 0});
    points.push_back({Sphere{0}, ray.from.cast<double>(), Eigen::Quaternionf::Identity()});
    sweeps.displacement.push_back(ray.way);
    sweeps.rotation.push_back(Vector3f::Zero());
  }
  const std::vector<PlacedShape> target = {
      {shape, Eigen::Vector3d::Zero(), Eigen::Quaternionf::Identity()}};
  const LaidOut a(points, {}), b(target, {});
  const std::vector<float> still(3, 0);
  FirstHits hits{std::vector<float>(rays.size()), std::vector<uint32_t>(rays.size())};
  const SweepView at_rest = {.displacement = still.data(), .rotation = still.data()};
  EXPECT_TRUE(time_of_impact(a.view(), sweeps.view(), b.view(), at_rest, pairs,
                             {.toi = hits.time.data(), .sub_b = hits.sub.data()}));
  return hits;
}

std::vector<RayOfShape> rays_at(double size, size_t count, oracle::Random& random) {
  std::vector<RayOfShape> rays;
  for (size_t i = 0; i < count; ++i) {
    const Vector3f from = (random.direction() * 4 * size).cast<float>();
    const Vector3f at = (random.direction() * random.uniform(0, size)).cast<float>();
    rays.push_back({from, 2 * (at - from)});
  }
  return rays;
}

std::vector<RayOfShape> moved(std::vector<RayOfShape> rays, const Vector3f& by) {
  for (RayOfShape& ray : rays) ray.from += by;
  return rays;
}

std::vector<RayOfShape> scaled_rays(std::vector<RayOfShape> rays, const Vector3f& scale) {
  for (RayOfShape& ray : rays) ray = {ray.from.cwiseProduct(scale), ray.way.cwiseProduct(scale)};
  return rays;
}

bool is_near(float a, float b, float most) {
  return a == b || (std::isfinite(a) && std::isfinite(b) && std::fabs(a - b) <= most);
}

// Returns how many hits were compared.
size_t expect_same_hits(const Shape& shape, const Vector3f& scale, double size, uint64_t seed) {
  const Result<Shape> result = scaled(shape, scale);
  if (!result) {
    ADD_FAILURE() << result.error().message;
    return 0;
  }
  oracle::Random random(seed);
  const std::vector<RayOfShape> rays = rays_at(size, rounds(60, 30), random);
  const FirstHits expected = first_hits(rays, shape);
  const FirstHits found = first_hits(scaled_rays(rays, scale), *result);
  // Rays that graze are left out: their neighbours hit elsewhere.
  std::vector<bool> grazes(rays.size());
  const auto step = static_cast<float>(1e-4 * size);
  for (const Vector3f& by : {Vector3f(step, 0, 0), Vector3f(0, step, 0), Vector3f(0, 0, step),
                             Vector3f(-step, -step, -step)}) {
    const FirstHits beside = first_hits(moved(rays, by), shape);
    for (size_t i = 0; i < rays.size(); ++i) {
      grazes[i] = grazes[i] || !is_near(beside.time[i], expected.time[i], 3e-3f) ||
                  beside.sub[i] != expected.sub[i];
    }
  }
  size_t hits = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    if (grazes[i]) continue;
    hits += std::isfinite(expected.time[i]);
    EXPECT_TRUE(is_near(found.time[i], expected.time[i], 2e-5f))
        << name(kind_of(shape)) << " scale " << scale.transpose() << ": " << found.time[i]
        << " instead of " << expected.time[i];
    EXPECT_EQ(found.sub[i], expected.sub[i]);
  }
  return hits;
}

constexpr ShapeKind kAnyScale[] = {
    ShapeKind::sphere,    ShapeKind::aabb,     ShapeKind::box,          ShapeKind::dop,
    ShapeKind::hull,      ShapeKind::mesh,     ShapeKind::height_field, ShapeKind::triangle,
    ShapeKind::ellipsoid, ShapeKind::halfspace};

const std::vector<Vector3f> kEvenScales = {
    {2, 2, 2},   {0.5f, -0.5f, 0.5f},   {-1, -1, -1},       {1, 1, -1},
    {-3, -3, 3}, {1e-6f, 1e-6f, 1e-6f}, {1e6f, 1e6f, -1e6f}};
const std::vector<Vector3f> kRoundScales = {
    {2, 2, 1}, {0.5f, -0.5f, -3}, {-1, -1, -0.4f}, {1, 1, 2}};
const std::vector<Vector3f> kUnevenScales = {
    {1, 2, 3}, {-0.5f, 1, 2}, {0.3f, -1.5f, -1}, {-1, -0.7f, -2}};

size_t expect_same_hits(ShapeKind kind, const std::vector<Vector3f>& scales, uint64_t seed) {
  Composites composites(seed);
  size_t hits = 0;
  for (const Vector3f& scale : scales) {
    for (size_t i = 0; i < rounds(6); ++i) {
      Shape shape = composites.shape(kind, 1);
      // A thickness stays in metres: the set is another one.
      if (auto* triangle = std::get_if<Triangle>(&shape)) triangle->thickness = 0;
      if (auto* mesh = std::get_if<Mesh>(&shape); mesh && mesh->geometry->rules().thickness > 0) {
        continue;
      }
      hits += expect_same_hits(shape, scale, 1, ++seed);
    }
  }
  return hits;
}

TEST(ScaledShapes, AreHitByScaledRays) {
  for (const ShapeKind kind : kAnyScale) {
    EXPECT_GT(expect_same_hits(kind, kEvenScales, 1), rounds(10, 3)) << name(kind);
    EXPECT_GT(expect_same_hits(kind, kRoundScales, 2), rounds(10, 3)) << name(kind);
    EXPECT_GT(expect_same_hits(kind, kUnevenScales, 3), rounds(10, 3)) << name(kind);
  }
  for (const ShapeKind kind : {ShapeKind::cylinder, ShapeKind::cone}) {
    EXPECT_GT(expect_same_hits(kind, kEvenScales, 4), rounds(100, 30));
    EXPECT_GT(expect_same_hits(kind, kRoundScales, 5), rounds(100, 30));
  }
  EXPECT_GT(expect_same_hits(ShapeKind::capsule, kEvenScales, 6), rounds(100, 30));
}

// Children that are turned: in any way under factors of one magnitude, by quarters otherwise.
TEST(ScaledShapes, OfCompoundsAreHitByScaledRays) {
  Composites composites(7);
  const float half = std::sqrt(0.5f);
  const Orientation kQuarters[] = {
      Orientation(1, 0, 0, 0),        Orientation(half, half, 0, 0),
      Orientation(half, 0, -half, 0), Orientation(half, 0, 0, half),
      Orientation(0, 0, 1, 0),        Orientation(0.5f, 0.5f, 0.5f, 0.5f)};
  constexpr ShapeKind kRoundKinds[] = {ShapeKind::cylinder, ShapeKind::cone, ShapeKind::capsule};
  size_t hits = 0;
  uint64_t seed = 300;
  for (const ShapeKind kind : kAnyScale) {
    if (kind == ShapeKind::halfspace) continue;
    for (const auto* scales : {&kEvenScales, &kRoundScales, &kUnevenScales}) {
      for (const Vector3f& scale : *scales) {
        std::vector<CompoundChild> children;
        for (size_t i = 0; i < 3; ++i) {
          const bool is_even = scales == &kEvenScales;
          CompoundChild& child = children.emplace_back();
          child.shape = is_even && i == 0 ? composites.simple(kRoundKinds[seed % 3], 0.5)
                                          : composites.shape(kind, 0.5);
          if (auto* triangle = std::get_if<Triangle>(&child.shape)) triangle->thickness = 0;
          auto* mesh = std::get_if<Mesh>(&child.shape);
          if (mesh && mesh->geometry->rules().thickness > 0) child.shape = Sphere{0.4f};
          child.position = (composites.random().direction() * 0.5).cast<float>();
          const bool shears = !is_even && kind != ShapeKind::height_field && i != 1;
          child.orientation = is_even || shears
                                  ? Orientation(composites.orientation())
                                  : kQuarters[composites.random().below(std::size(kQuarters))];
        }
        hits += expect_same_hits(Compound{*make_compound(children)}, scale, 1, ++seed);
      }
    }
  }
  EXPECT_GT(hits, rounds(2000));
}

}  // namespace
}  // namespace carom::test

// Rays that go nearly the same way share a walk; each of them hits what it hits alone. The contact
// of a ray is that of the triangle as a body of its own.
#include <gtest/gtest.h>

#include <cmath>

#include "carom/queries/cast.h"
#include "tests/support/cast_checks.h"

namespace carom::test {
namespace {

using Eigen::Vector3f;

struct RayLists {
  std::vector<Vector3f> origins, directions;

  void add(const Vector3f& origin, const Vector3f& direction) {
    origins.push_back(origin);
    directions.push_back(direction);
  }
  Rays rays(size_t first, size_t count) const {
    return Rays(origins[first].data(), directions[first].data(), count, 1);
  }
};

using Bodies = std::vector<PlacedShape>;

std::vector<CastHit> hits_of(const Rays& rays, const Bodies& bodies, CastHits which) {
  const LaidOut laid_out(bodies, {});
  std::vector<CastHit> hits;
  EXPECT_TRUE(bool(cast(rays.queries(), rays.sweep(), laid_out.view(), hits, {.hits = which})));
  return hits;
}

// A call for each ray.
std::vector<CastHit> hits_one_by_one(const RayLists& list, size_t count, const Bodies& bodies,
                                     CastHits which) {
  std::vector<CastHit> all;
  for (uint32_t i = 0; i < count; ++i) {
    for (CastHit hit : hits_of(list.rays(i, 1), bodies, which)) {
      hit.query = i;
      all.push_back(hit);
    }
  }
  return all;
}

// A camera's rays, row by row. Some turn aside, stop early, go along an axis or not at all.
RayLists camera(const Vector3f& eye, const Vector3f& middle, float spread, double odd,
                oracle::Random& random) {
  RayLists list;
  const Vector3f way = middle - eye;
  const Vector3f right = way.unitOrthogonal(), up = way.normalized().cross(right);
  for (int i = 0; i < 16; ++i) {
    for (int k = 0; k < 16; ++k) {
      const float u = spread * (static_cast<float>(i) - 7.5f),
                  v = spread * (static_cast<float>(k) - 7.5f);
      Vector3f direction = 2 * (way + u * right + v * up);
      if (random.chance(odd)) {
        switch (random.below(4)) {
          case 0:
            direction = (random.direction() * 20).cast<float>();
            break;
          case 1:
            direction *= 0.4f;
            break;
          case 2:
            direction = {0, 0, direction.z()};
            break;
          default:
            direction.setZero();
        }
      }
      list.add(eye, direction);
    }
  }
  return list;
}

PlacedShape terrain(bool one_sided, int cells = 40) {
  PlacedShape body;
  body.shape = grid_mesh(cells, 0.25f,
                         [](float x, float y) { return 0.4f * std::sin(3 * x) * std::cos(2 * y); },
                         {.one_sided = one_sided});
  body.position = {0.25, -0.5, 0.125};
  body.orientation = Eigen::Quaternionf(0.9f, 0.1f, 0.2f, -0.3f);
  return body;
}

TEST(RayPackets, HitWhatEachRayHitsAlone) {
  oracle::Random random(11);
  size_t hit_count = 0, ray_count = 0;
  for (const bool one_sided : {false, true}) {
    const PlacedShape body = terrain(one_sided);
    for (const Vector3f& eye : {Vector3f(0, -9, 5), Vector3f(1, 2, 30), Vector3f(-3, 4, -6),
                                Vector3f(0.1f, 0.2f, 0.3f)}) {
      for (const float spread : {0.0f, 0.02f, 0.2f, 2.0f}) {
        const RayLists list =
            camera(eye, {0.2f, 0.1f, 0}, spread, spread == 0.2f ? 0.2 : 0.02, random);
        const size_t all = list.origins.size();
        for (const CastHits which : {CastHits::closest, CastHits::any}) {
          const std::vector<CastHit> alone = hits_one_by_one(list, all, {body}, which);
          const std::vector<CastHit> together = hits_of(list.rays(0, all), {body}, which);
          EXPECT_EQ(bits_of(together), bits_of(alone)) << show(together, alone);
          hit_count += together.size();
          ray_count += all;
        }
      }
    }
  }
  EXPECT_GT(hit_count, ray_count / 4);
  EXPECT_LT(hit_count, ray_count);
}

// Neighbouring rays meet one mesh or the other.
TEST(RayPackets, MeetSeveralMeshes) {
  oracle::Random random(15);
  Bodies bodies = {terrain(false), terrain(true, 12), terrain(false, 12)};
  bodies[1].position = {1.5, -1.5, 1};
  bodies[2].position = {-1.5, -1.5, 1};
  const RayLists list = camera({0.5f, -9, 5}, {0, 0, 0}, 0.3f, 0.1, random);
  const size_t all = list.origins.size();
  for (const CastHits which : {CastHits::closest, CastHits::any, CastHits::all}) {
    const std::vector<CastHit> alone = hits_one_by_one(list, all, bodies, which);
    const std::vector<CastHit> together = hits_of(list.rays(0, all), bodies, which);
    EXPECT_EQ(bits_of(together), bits_of(alone)) << show(together, alone);
    std::array<size_t, 3> hits{};
    for (const CastHit& hit : together) {
      if (hit.body < 3) ++hits[hit.body];
    }
    if (which == CastHits::any) continue;
    for (const size_t count : hits) EXPECT_GT(count, 20u);
  }
}

TEST(RayPackets, HaveAnyNumberOfRays) {
  oracle::Random random(12);
  const PlacedShape body = terrain(false);
  const RayLists list = camera({0, -9, 5}, {0, 0, 0}, 0.05f, 0, random);
  const std::vector<CastHit> alone = hits_one_by_one(list, 70, {body}, CastHits::closest);
  EXPECT_GT(alone.size(), 60u);
  for (const size_t count : {1, 3, 4, 5, 15, 16, 17, 19, 20, 31, 32, 33, 63, 64, 65, 70}) {
    std::vector<CastHit> expected = alone;
    std::erase_if(expected, [&](const CastHit& hit) { return hit.query >= count; });
    EXPECT_EQ(bits_of(hits_of(list.rays(0, count), {body}, CastHits::closest)), bits_of(expected))
        << count;
  }
}

TEST(RayPackets, AreTheSameOnEveryIsa) {
  oracle::Random random(13);
  const PlacedShape body = terrain(true);
  const RayLists list = camera({2, -9, 4}, {0, 0, 0}, 0.1f, 0.1, random);
  std::vector<CastHit> expected;
  for_each_isa([&] {
    const std::vector<CastHit> hits =
        hits_of(list.rays(0, list.origins.size()), {body}, CastHits::closest);
    if (expected.empty()) expected = hits;
    EXPECT_EQ(bits_of(hits), bits_of(expected));
  });
  EXPECT_GT(expected.size(), 100u);
}

// Rays at the inside of a triangle, at its edges and at its corners, from both sides.
TEST(RayContacts, AreThoseOfTheTriangleAlone) {
  Composites composites(14);
  oracle::Random& random = composites.random();
  size_t hit_count = 0, face_count = 0;
  for (int round = 0; round < 600; ++round) {
    const auto size = static_cast<float>(random.log_uniform(1e-10, 1e10));
    std::array<Vector3f, 3> corners;
    for (Vector3f& corner : corners) corner = (random.direction() * size).cast<float>();
    if (round % 5 == 4)
      corners[2] = corners[0] + (corners[1] - corners[0]) * 0.5f + corners[2] * 1e-3f;
    const MeshRules rules = {.one_sided = round % 3 == 1};
    const PlacedShape mesh = {mesh_of({corners[0], corners[1], corners[2]}, {{0, 1, 2}}, rules),
                              {1, 2, 3},
                              composites.orientation()};
    PlacedShape alone = mesh;
    alone.shape = Triangle{.corners = corners, .one_sided = rules.one_sided};
    const auto weight = [&] {
      return static_cast<float>(random.chance(0.3) ? 0 : random.uniform(0, 1));
    };
    const std::array<float, 3> w = {weight() + 1e-3f, weight(), weight()};
    const Vector3f target =
        (corners[0] * w[0] + corners[1] * w[1] + corners[2] * w[2]) / (w[0] + w[1] + w[2]);
    const Vector3f way = (random.direction() * size).cast<float>();
    RayLists list;
    const auto turned = [&](const Vector3f& v) -> Vector3f {
      return mesh.orientation.normalized() * v;
    };
    list.add(mesh.position.cast<float>() + turned(target - way), turned(way) * 2);
    const auto of_mesh = hits_of(list.rays(0, 1), {mesh}, CastHits::closest);
    const auto of_triangle = hits_of(list.rays(0, 1), {alone}, CastHits::closest);
    ASSERT_EQ(of_mesh.size(), of_triangle.size());
    if (of_mesh.empty()) continue;
    ++hit_count;
    EXPECT_EQ(of_mesh[0].toi, of_triangle[0].toi);
    if (w[1] < 1e-3f || w[2] < 1e-3f) continue;  // there the normal may be that of either feature
    ++face_count;
    EXPECT_LT((of_mesh[0].normal - of_triangle[0].normal).norm(), 1e-6f) << "round " << round;
    EXPECT_LT((of_mesh[0].point - of_triangle[0].point).norm(), 1e-6f * size) << "round " << round;
    EXPECT_NEAR(of_mesh[0].separation, of_triangle[0].separation, 1e-6f * size);
  }
  EXPECT_GT(hit_count, 150u);
  EXPECT_GT(face_count, 60u);
}

}  // namespace
}  // namespace carom::test

// A row of sensors scans a yard of boxes, balls and pillars: which body each ray hits first, how
// far a ball can roll, and what is nearest to it.
#include <carom/carom.h>

#include <cmath>
#include <cstdio>
#include <vector>

int main() {
  carom::World world;
  world.add({.shape = carom::Halfspace{{0, 0, 1}, 0}, .motion = carom::Motion::fixed});
  for (int i = 0; i < 10; ++i) {
    const double y = 2.0 * i;
    world.add({.shape = carom::Box{{0.5f, 0.5f, 1}}, .position = {5, y, 1}});
    world.add({.shape = carom::Sphere{0.4f}, .position = {8, y + 1, 0.4}});
    world.add({.shape = carom::Capsule{{0, 0, 0}, {0, 0, 2}, 0.2f}, .position = {3, y + 1, 0}});
  }
  world.step();

  // A fan of rays, 20 m long, half a metre above the ground; some point downwards.
  constexpr size_t kRays = 64;
  std::vector<Eigen::Vector3f> origins(kRays, {0, 10, 0.5f}), directions;
  for (size_t i = 0; i < kRays; ++i) {
    const float angle = 2.4f * (static_cast<float>(i) / kRays - 0.5f);
    directions.push_back({std::cos(angle), std::sin(angle), i % 4 == 0 ? -0.2f : 0.0f});
    directions.back().normalize();
  }
  constexpr float kLength = 20;
  const carom::Rays rays(origins[0].data(), directions[0].data(), kRays, kLength);
  std::vector<carom::CastHit> hits;
  world.cast(rays.queries(), rays.sweep(), hits);
  for (const carom::CastHit& hit : hits) {
    if (hit.query % 7 != 0) continue;
    std::printf("ray %2u: %s %u after %.2f m, normal (%.2f, %.2f, %.2f)\n", hit.query,
                carom::name(carom::kind_of(world.shape(world.id_of(hit.body)))), hit.body,
                hit.toi * kLength, hit.normal.x(), hit.normal.y(), hit.normal.z());
  }

  // A ball of 30 cm that rolls 12 m to the right, and everything in its path.
  const std::vector<float> ball = {0, 9, 0.31f, 0.3f};
  const std::vector<float> way = {12, 0, 0};
  std::vector<carom::CastHit> in_the_way;
  world.cast(carom::sphere_records(ball.data(), 1), {.displacement = way.data()}, in_the_way,
             {.hits = carom::CastHits::all});
  for (const carom::CastHit& hit : in_the_way) {
    std::printf("the ball meets body %u after %.2f m\n", hit.body, hit.toi * way[0]);
  }

  std::vector<carom::NearestHit> nearest;
  world.find_nearest(carom::sphere_records(ball.data(), 1), 100, nearest);
  std::printf("nearest to it is body %u, %.2f m away\n", nearest[0].body, nearest[0].separation);

  std::printf("%zu of %zu rays meet something\n", hits.size(), kRays);
  return hits.size() > kRays / 2 && !in_the_way.empty() ? 0 : 1;
}

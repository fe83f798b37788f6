// One number: how wrong a contact may be. Ladders give the world simpler models to test.
#include <carom/carom.h>
#include <carom/ladders/build_ladder.h>

#include <cmath>
#include <cstdio>
#include <vector>

namespace {

// A closed surface with bumps, about the origin; 2 n (n - 1) triangles.
carom::Mesh bumpy_ball(uint32_t n) {
  constexpr float kPi = 3.14159265f;
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;
  for (uint32_t i = 0; i <= n; ++i) {
    for (uint32_t j = 0; j < n; ++j) {
      const float theta = kPi * static_cast<float>(i) / static_cast<float>(n);
      const float phi = 2 * kPi * static_cast<float>(j) / static_cast<float>(n);
      const float radius = 1 + 0.1f * std::sin(4 * theta) * std::cos(3 * phi);
      vertices.push_back({radius * std::sin(theta) * std::cos(phi),
                          radius * std::sin(theta) * std::sin(phi), radius * std::cos(theta)});
      if (i == n) continue;
      const uint32_t here = i * n + j, next = i * n + (j + 1) % n;
      if (i + 1 < n) triangles.push_back({here, here + n, next + n});
      if (i > 0) triangles.push_back({here, next + n, next});
    }
  }
  return {*carom::make_mesh(vertices, triangles)};
}

}  // namespace

int main() {
  constexpr float kTolerance = 0.02f;  // metres
  const double most = carom::error_within(kTolerance);
  const auto ball = carom::build_ladder(bumpy_ball(100), {&most, 1});
  if (!ball) {
    std::printf("%s\n", ball.error().message.c_str());
    return 1;
  }
  const carom::LadderReport::Entry& rung = ball->report.entries.front();
  std::printf("%zu triangles; a model of %zu is %.4f m off at most\n", ball->report.pieces,
              rung.pieces, rung.error);

  carom::World world({.accuracy = {.tier = {}, .tolerance = kTolerance}});
  const carom::BodyId moving = world.add({.shape = ball->shape});
  world.add({.shape = carom::Box{{1, 1, 1}}, .position = {1.9, 0, 0}});
  size_t tested = 0;
  for (int step = 0; step < 100; ++step) {
    world.set_position(moving, {0.001 * step, 0, 0});
    world.step();
    tested += world.report().tested;
  }
  std::printf("tested in %zu of 100 steps; separation %.3f m\n", tested,
              world.contacts().empty() ? 0.0 : double{world.contacts()[0].separation});
  return tested < 60 && world.contacts().size() == 1 ? 0 : 1;
}

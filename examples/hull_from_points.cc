// Makes a convex body of a scan: the hull of its points, and a simpler one around it for the world.
#include <carom/carom.h>
#include <carom/hulls/build_hull.h>
#include <carom/hulls/simplify_hull.h>

#include <cmath>
#include <cstdio>
#include <vector>

namespace {

// Points on an ellipsoid, and others inside of it.
std::vector<Eigen::Vector3f> scan() {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 1000; ++i) {
    const float z = 2 * (static_cast<float>(i) + 0.5f) / 1000 - 1;
    const float radius = std::sqrt(1 - z * z), angle = 2.4f * static_cast<float>(i);
    const Eigen::Vector3f on{radius * std::cos(angle), 0.7f * radius * std::sin(angle), 0.5f * z};
    points.push_back(i % 2 == 0 ? on : (0.9f * on).eval());
  }
  return points;
}

}  // namespace

int main() {
  const std::vector<Eigen::Vector3f> points = scan();
  const auto hull = carom::build_hull(points);
  if (!hull) {
    std::printf("%s\n", hull.error().message.c_str());
    return 1;
  }
  std::printf("%zu points: a %s of %zu corners and %zu faces, %zu points inside\n", points.size(),
              carom::name(hull->form), hull->geometry->points().size(),
              hull->geometry->faces().size(), hull->inside);

  // A test against few corners takes less time. From outside, nothing is missed.
  const auto simple =
      carom::simplify_hull(points, {.most_points = 32, .side = carom::HullSide::outside});
  if (!simple) return 1;
  std::printf("%zu corners around them, %.3f m off at most\n", simple->geometry->points().size(),
              simple->error);

  carom::World world;
  world.add({.shape = carom::Hull{simple->geometry}, .position = {0, 0, 0.45}});
  world.add({.shape = carom::Aabb{{-5, -5, -1}, {5, 5, 0}}, .motion = carom::Motion::fixed});
  world.step();
  for (const carom::Contact& contact : world.contacts()) {
    std::printf("%.3f m deep in the ground\n", -contact.separation);
  }
  return world.contacts().size() == 1 ? 0 : 1;
}

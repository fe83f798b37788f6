// Worlds full of bodies, and everything a step yields as bytes.
#pragma once

#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "carom/world/world.h"
#include "tests/support/random.h"

namespace carom::test {

struct CrowdSpec {
  size_t count = 400;
  double side = 7;
  bool boxes = true;
  bool filters = false;  // layers, owners, sensors, static bodies
  bool velocities = false;
  uint64_t seed = 1;
};

// Positions are multiples of 2^-16, so that they can be shifted without rounding.
inline Eigen::Vector3d random_position(Random& random, double side) {
  Eigen::Vector3d position;
  for (int i = 0; i < 3; ++i) position[i] = std::floor(random.uniform(0, side) * 0x1p16) * 0x1p-16;
  return position;
}

inline std::vector<BodyDesc> make_crowd(const CrowdSpec& spec) {
  Random random(spec.seed);
  const auto size = [&] { return static_cast<float>(random.uniform(0.1, 0.8)); };
  std::vector<BodyDesc> bodies(spec.count);
  for (BodyDesc& body : bodies) {
    body.position = random_position(random, spec.side);
    body.shape = Sphere{size()};
    if (spec.boxes && random.chance(0.4)) {
      body.shape = Aabb::from_half_extents({size(), size(), size()});
    }
    if (spec.velocities) body.linear_velocity = random.direction().cast<float>();
    if (!spec.filters) continue;
    if (random.chance(0.3)) body.motion = Motion::fixed;
    body.layer = 1u << random.below(3);
    body.mask = static_cast<uint32_t>(random.below(8));
    body.owner = static_cast<uint32_t>(random.below(9));
    body.sensor = random.chance(0.2);
  }
  return bodies;
}

inline std::vector<BodyId> add_crowd(World& world, const CrowdSpec& spec) {
  std::vector<BodyId> ids;
  world.add(make_crowd(spec), ids);
  return ids;
}

// A few of the bodies go a little way: the same ones in every world with the same `random`.
inline void move_some(World& world, std::span<const BodyId> ids, double share, Random& random) {
  for (const BodyId id : ids) {
    if (!random.chance(share)) continue;
    world.set_position(id, world.position(id) + random_position(random, 0.25));
  }
}

template <class T>
std::string as_bytes(std::span<const T> items) {
  return {reinterpret_cast<const char*>(items.data()), items.size_bytes()};
}

struct Results {
  std::string pairs, overlaps, contacts, events, quarantined;
  bool operator==(const Results&) const = default;
};

inline Results results(const World& world) {
  return {as_bytes(world.pairs()), as_bytes(world.overlaps()), as_bytes(world.contacts()),
          as_bytes(world.events()), as_bytes(world.quarantined())};
}

}  // namespace carom::test

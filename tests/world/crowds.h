// Worlds with many bodies, and all results of a step as bytes.
#pragma once

#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "carom/world/world.h"
#include "oracle/random.h"

namespace carom::test {

using namespace oracle;

struct CrowdSpec {
  size_t count = 400;
  double side = 7;
  bool boxes = true;      // aabbs
  bool oriented = false;  // capsules, oriented boxes, triangles
  size_t halfspaces = 0;  // through the middle; they are the first bodies of the crowd
  bool filters = false;   // layers, owners, sensors, static bodies
  bool velocities = false;
  bool looks_ahead = false;  // every second body has a detection, and all move far in a step
  uint64_t seed = 1;
};

// Positions are multiples of 2^-16, so that they can be shifted without rounding.
Eigen::Vector3d random_position(Random& random, double side);

float random_size(Random& random);

Eigen::Vector3f random_corner(Random& random);

// Not a unit quaternion.
Eigen::Quaternionf random_orientation(Random& random);

Shape random_shape(ShapeKind kind, Random& random);

inline constexpr ShapeKind kOrientedKinds[] = {ShapeKind::capsule, ShapeKind::box,
                                               ShapeKind::triangle, ShapeKind::dop};
inline constexpr ShapeKind kAllKinds[] = {
    ShapeKind::sphere,   ShapeKind::aabb,      ShapeKind::capsule, ShapeKind::box,
    ShapeKind::triangle, ShapeKind::halfspace, ShapeKind::dop};

std::vector<BodyDesc> make_crowd(const CrowdSpec& spec);

std::vector<BodyId> add_crowd(World& world, const CrowdSpec& spec);

// Moves a few of the bodies a little: the same ones in every world with the same `random`.
void move_some(World& world, std::span<const BodyId> ids, double share, Random& random);

// Turns a few of the bodies likewise; spheres and aabbs have no orientation.
void turn_some(World& world, std::span<const BodyId> ids, double share, Random& random);

template <class T>
std::string as_bytes(std::span<const T> items) {
  return {reinterpret_cast<const char*>(items.data()), items.size_bytes()};
}

struct Results {
  std::string pairs, overlaps, contacts, manifolds, events, quarantined, impacts, speculative;
  bool operator==(const Results&) const = default;
};

Results results(const World& world);

}  // namespace carom::test

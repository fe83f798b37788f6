// Bodies of every kind, some of them not valid, as queries and as their targets.
#pragma once

#include <limits>
#include <vector>

#include "tests/support/composites.h"

namespace carom::test {

struct BodiesSpec {
  size_t count = 100;
  double side = 8;
  double size = 0.6;
  bool composites = true;  // hulls, meshes and compounds as well
  double halfspaces = 0.03;
  double invalid = 0.03;
  double distance = 0;  // distance of all bodies from the origin
  PositionType positions = PositionType::float32;
};

PlacedShape spoilt(PlacedShape body, oracle::Random& random);

std::vector<PlacedShape> make_bodies(const BodiesSpec& spec, uint64_t seed);

Layout layout_of(const BodiesSpec& spec);

// All pairs (query, body) that have a kernel.
std::vector<Pair> all_pairs(const std::vector<PlacedShape>& queries,
                            const std::vector<PlacedShape>& bodies);

}  // namespace carom::test

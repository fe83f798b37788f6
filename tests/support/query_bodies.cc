#include "tests/support/query_bodies.h"

namespace carom::test {

PlacedShape spoilt(PlacedShape body, oracle::Random& random) {
  constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
  switch (random.below(3)) {
    case 0:
      body.position[static_cast<int>(random.below(3))] = kNotANumber;
      return body;
    case 1:
      body.position.x() = std::numeric_limits<double>::infinity();
      return body;
    default:
      return {Sphere{-1}, body.position};
  }
}

std::vector<PlacedShape> make_bodies(const BodiesSpec& spec, uint64_t seed) {
  Composites shapes(seed);
  oracle::Random& random = shapes.random();
  std::vector<PlacedShape> bodies;
  for (size_t i = 0; i < spec.count; ++i) {
    ShapeKind kind = kEveryKind[random.below(std::size(kEveryKind))];
    if (kind == ShapeKind::halfspace) kind = ShapeKind::box;
    if (!spec.composites && has_geometry(kind)) kind = ShapeKind::sphere;
    if (random.chance(spec.halfspaces)) kind = ShapeKind::halfspace;
    // With a rounding as long as its edges a shape would be twice as large as others.
    const double size = is_rounded(kind) ? spec.size / 2 : spec.size;
    PlacedShape body = {
        shapes.shape(kind, size * random.uniform(0.2, 1)), {}, shapes.orientation()};
    for (int axis = 0; axis < 3; ++axis) {
      body.position[axis] = spec.distance + random.uniform(0, spec.side);
    }
    body.position = stored(body.position, spec.positions);
    bodies.push_back(random.chance(spec.invalid) ? spoilt(body, random) : body);
  }
  return bodies;
}

Layout layout_of(const BodiesSpec& spec) { return {.positions = spec.positions}; }

std::vector<Pair> all_pairs(const std::vector<PlacedShape>& queries,
                            const std::vector<PlacedShape>& bodies) {
  std::vector<Pair> pairs;
  for (uint32_t i = 0; i < queries.size(); ++i) {
    for (uint32_t j = 0; j < bodies.size(); ++j) {
      if (supports(kind_of(queries[i].shape), kind_of(bodies[j].shape))) pairs.push_back({i, j});
    }
  }
  return pairs;
}

}  // namespace carom::test

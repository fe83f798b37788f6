#include "tests/world/crowds.h"

namespace carom::test {

Eigen::Vector3d random_position(Random& random, double side) {
  Eigen::Vector3d position;
  for (int i = 0; i < 3; ++i) position[i] = std::floor(random.uniform(0, side) * 0x1p16) * 0x1p-16;
  return position;
}

float random_size(Random& random) { return static_cast<float>(random.uniform(0.1, 0.8)); }

Eigen::Vector3f random_corner(Random& random) {
  return (random.direction() * random.uniform(0.1, 0.8)).cast<float>();
}

Eigen::Quaternionf random_orientation(Random& random) {
  Eigen::Quaternionf q;
  for (int i = 0; i < 4; ++i) q.coeffs()[i] = static_cast<float>(random.uniform(-2, 2));
  return q;
}

Shape random_shape(ShapeKind kind, Random& random) {
  const auto size = [&] { return random_size(random); };
  switch (kind) {
    case ShapeKind::aabb:
      return Aabb::from_half_extents({size(), size(), size()});
    case ShapeKind::capsule:
      return Capsule{random_corner(random), random_corner(random), size() / 2};
    case ShapeKind::box:
      return Box{{size(), size(), size()}};
    case ShapeKind::triangle: {
      Triangle triangle;
      for (Eigen::Vector3f& corner : triangle.corners) corner = random_corner(random);
      if (random.chance(0.3)) triangle.thickness = size() / 4;
      triangle.one_sided = random.chance(0.3);
      triangle.inner_edges = static_cast<uint8_t>(random.chance(0.5) ? random.below(8) : 0);
      return triangle;
    }
    case ShapeKind::dop: {
      constexpr DopKind kKinds[] = {DopKind::k6, DopKind::k14, DopKind::k18, DopKind::k26};
      std::vector<Eigen::Vector3f> points(6);
      for (Eigen::Vector3f& p : points) p = random_corner(random);
      Dop dop = Dop::of_points(points, kKinds[random.below(4)]);
      dop.geometry = dop_geometry(dop);  // the reference would find it anew for every pair
      return dop;
    }
    case ShapeKind::halfspace:
      return Halfspace{random.direction().cast<float>() * size(), size() - 0.5f};
    default:
      return Sphere{size()};
  }
}

std::vector<BodyDesc> make_crowd(const CrowdSpec& spec) {
  Random random(spec.seed);
  std::vector<BodyDesc> bodies(spec.count);
  for (size_t i = 0; i < bodies.size(); ++i) {
    BodyDesc& body = bodies[i];
    body.position = random_position(random, spec.side);
    body.shape = random_shape(ShapeKind::sphere, random);
    if (spec.boxes && random.chance(0.4)) body.shape = random_shape(ShapeKind::aabb, random);
    if (spec.oriented && random.chance(0.6)) {
      body.shape = random_shape(kOrientedKinds[random.below(std::size(kOrientedKinds))], random);
      body.orientation = random_orientation(random);
    }
    if (i < spec.halfspaces) {
      body.shape = random_shape(ShapeKind::halfspace, random);
      body.orientation = random_orientation(random);
      body.position = Eigen::Vector3d::Constant(spec.side / 2);
    }
    if (spec.velocities) body.linear_velocity = random.direction().cast<float>();
    if (spec.looks_ahead) {
      body.linear_velocity = (random.direction() * random.uniform(0, 60)).cast<float>();
      body.angular_velocity = (random.direction() * random.uniform(0, 20)).cast<float>();
      if (random.chance(0.5)) body.detection = static_cast<Detection>(1 + random.below(3));
    }
    if (!spec.filters) continue;
    if (random.chance(0.3)) body.motion = Motion::fixed;
    body.layer = 1u << random.below(3);
    body.mask = static_cast<uint32_t>(random.below(8));
    body.owner = static_cast<uint32_t>(random.below(9));
    body.sensor = random.chance(0.2);
  }
  return bodies;
}

std::vector<BodyId> add_crowd(World& world, const CrowdSpec& spec) {
  std::vector<BodyId> ids;
  world.add(make_crowd(spec), ids);
  return ids;
}

void move_some(World& world, std::span<const BodyId> ids, double share, Random& random) {
  for (const BodyId id : ids) {
    if (!random.chance(share)) continue;
    world.set_position(id, world.position(id) + random_position(random, 0.25));
  }
}

void turn_some(World& world, std::span<const BodyId> ids, double share, Random& random) {
  for (const BodyId id : ids) {
    if (random.chance(share)) world.set_orientation(id, random_orientation(random));
  }
}

Results results(const World& world) {
  return {as_bytes(world.pairs()),    as_bytes(world.overlaps()),
          as_bytes(world.contacts()), as_bytes(world.manifolds()),
          as_bytes(world.events()),   as_bytes(world.quarantined()),
          as_bytes(world.impacts()),  as_bytes(world.speculative_contacts())};
}

}  // namespace carom::test

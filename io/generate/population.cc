#include "io/generate/population.h"

#include <cmath>

#include "io/generate/ground.h"
#include "io/generate/made_shapes.h"
#include "io/generate/rotation.h"

namespace carom::io {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDensity = 0.1;
constexpr double kBodiesPerSquareMetre = 1.0 / 6.0;
constexpr double kUsualSpin = 1;  // radians a second

enum PopulationStream : uint64_t {
  kShapes = 1,
  kPlaces = 2,
  kVelocities = 3,
  kGround = 4,
  kSpins = 5
};

double volume(ShapeKind shape, double edge) {
  double cube = edge * edge * edge;
  switch (shape) {
    case ShapeKind::aabb:
    case ShapeKind::box:
      return cube;
    case ShapeKind::capsule:
      return cube * (kPi * 5 / 96);
    case ShapeKind::cylinder:
    case ShapeKind::ellipsoid:
      return cube * (kPi / 16);
    case ShapeKind::cone:
      return cube * (kPi / 48);
    default:
      return cube * (kPi / 6);
  }
}

// A capsule, cylinder or cone is as long as the edge and half as wide. An ellipsoid is as long as
// the edge along x, 3/4 of it along y, 1/2 along z. Of these three the box around them counts.
// A ball and a made shape lie in a ball with the edge as diameter.
Vec3 half_extents(ShapeKind shape, const Vec3& edges, const Quaternion& orientation) {
  const double edge = edges[1];
  switch (shape) {
    case ShapeKind::box:
      return half_extents_turned(edges, orientation);
    case ShapeKind::cylinder:
    case ShapeKind::cone:
      return half_extents_turned({edge / 2, edge / 2, edge}, orientation);
    case ShapeKind::ellipsoid:
      return half_extents_turned({edge, edge * 0.75, edge / 2}, orientation);
    case ShapeKind::capsule: {
      Vec3 half = half_extents_turned({0, edge / 2, 0}, orientation);
      for (int axis = 0; axis < 3; ++axis) half[axis] += edges[axis] / 4;
      return half;
    }
    default:
      return {edges[0] / 2, edges[1] / 2, edges[2] / 2};
  }
}

// Draws a body with these edges and stores its half extents in `population.half`.
void draw_body(const GeneratorSpec& spec, const Vec3& edges, Random& random, uint64_t body,
               Population& population) {
  Vec3& half = population.half[body];
  if (spec.has_orientation()) {
    Quaternion orientation = random.rotation();
    population.edges[body] = edges;
    population.orientation[body] = normalized(orientation);
    half = half_extents(spec.shape_of(body), edges, orientation);
  } else if (spec.shape == ShapeKind::sphere) {
    half = {edges[0] / 2, edges[1] / 2, edges[2] / 2};
  } else if (spec.kind == GeneratorKind::level) {
    half = half_extents_turned_about_y(edges, random);
  } else {
    half = half_extents_turned(edges, random.rotation());
  }
}

// Draws the sizes; returns the sum of the volumes.
double draw_cubes(const GeneratorSpec& spec, Population& population) {
  Random random(spec.seed, kShapes);
  LogUniform sizes(1, 316);
  double sum = 0;
  for (uint64_t i = 0; i < spec.bodies; ++i) {
    double edge = spec.kind == GeneratorKind::varied ? sizes.draw(random) : 1.0;
    sum += volume(spec.shape_of(i), edge);
    draw_body(spec, {edge, edge, edge}, random, i, population);
  }
  return sum;
}

// Draws vectors for the moving bodies only.
void draw_vectors(Random random, double greatest, uint64_t stride, std::vector<Vec3>& vectors) {
  for (uint64_t i = 0; i < vectors.size(); i += stride) vectors[i] = random.in_ball(greatest);
}

void draw_velocities(const GeneratorSpec& spec, Population& population) {
  uint64_t stride = population.mover_stride;
  draw_vectors({spec.seed, kVelocities}, population.speed, stride, population.velocity);
  if (!spec.has_orientation()) return;
  population.spin = spec.spin.value_or(population.speed > 0 ? kUsualSpin : 0);
  draw_vectors({spec.seed, kSpins}, population.spin, stride, population.angular_velocity);
}

double default_speed(const GeneratorSpec& spec, double side) {
  switch (spec.kind) {
    case GeneratorKind::brownian:
      return 0.75 * side;
    case GeneratorKind::varied:
      return 5 / spec.dt;
    case GeneratorKind::level:
      return 6;
    case GeneratorKind::still:
    case GeneratorKind::bullets:
      return 0;
  }
  return 0;
}

void fill_cube(const GeneratorSpec& spec, Population& population) {
  double side = cube_root(draw_cubes(spec, population) / spec.density.value_or(kDensity));
  population.lower = {-side / 2, -side / 2, -side / 2};
  population.upper = {side / 2, side / 2, side / 2};
  population.speed = spec.speed.value_or(default_speed(spec, side));
  Random random(spec.seed, kPlaces);
  for (uint64_t i = 0; i < population.position.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      double reach = std::fmax(side / 2 - population.half[i][axis], 0.0);
      population.position[i][axis] = random.between(-reach, reach);
    }
  }
}

void draw_boxes(const GeneratorSpec& spec, Population& population) {
  Random random(spec.seed, kShapes);
  LogUniform sizes(0.5, 4);
  for (uint64_t i = 0; i < spec.bodies; ++i) {
    const ShapeKind shape = spec.shape_of(i);
    const bool round = shape != ShapeKind::aabb && shape != ShapeKind::box;
    double x = sizes.draw(random);
    double y = round ? x : sizes.draw(random);
    double z = round ? x : sizes.draw(random);
    draw_body(spec, {x, y, z}, random, i, population);
  }
}

// Six of ten bodies stand in clusters, the others anywhere; movers start up to 4 m above the
// ground, clusters are piled up to 2 m high.
void fill_level(const GeneratorSpec& spec, Population& population) {
  constexpr uint64_t kBodiesPerCluster = 1000;
  constexpr double kClusterRadius = 24;
  constexpr double kWallHeight = 20;
  population.mover_stride = 10;
  draw_boxes(spec, population);
  double bodies = static_cast<double>(spec.bodies);
  double side = std::sqrt(bodies / spec.density.value_or(kBodiesPerSquareMetre));
  population.lower = {-side / 2, -kWallHeight, -side / 2};
  population.upper = {side / 2, kWallHeight, side / 2};
  population.speed = spec.speed.value_or(default_speed(spec, side));

  Random random(spec.seed, kPlaces);
  Ground ground(mix64(spec.seed) + kGround);
  std::vector<Vec3> clusters(spec.bodies / kBodiesPerCluster + 1);
  for (Vec3& centre : clusters) {
    centre = {random.between(-side / 2, side / 2), 0, random.between(-side / 2, side / 2)};
  }
  for (uint64_t i = 0; i < spec.bodies; ++i) {
    bool clustered = random.below(10) < 6;
    Vec3 place = {random.between(-side / 2, side / 2), 0, random.between(-side / 2, side / 2)};
    if (clustered) {
      Vec3 offset1 = random.in_disc(kClusterRadius / 2);
      Vec3 offset2 = random.in_disc(kClusterRadius / 2);
      place = clusters[random.below(static_cast<uint32_t>(clusters.size()))];
      place[0] += offset1[0] + offset2[0];
      place[2] += offset1[2] + offset2[2];
    }
    for (int axis : {0, 2}) {
      double reach = std::fmax(side / 2 - population.half[i][axis], 0.0);
      place[axis] = std::fmin(std::fmax(place[axis], -reach), reach);
    }
    bool moves = i % population.mover_stride == 0;
    double above = random.unit() * (moves ? 4.0 : clustered ? 2.0 : 0.0);
    place[1] = ground.height(place[0], place[2]) + population.half[i][1] + above;
    population.position[i] = place;
  }
}

}  // namespace

Population populate(const GeneratorSpec& spec) {
  Population population;
  population.half.resize(spec.bodies);
  population.position.resize(spec.bodies);
  population.velocity.resize(spec.bodies);
  if (spec.has_orientation()) {
    population.edges.resize(spec.bodies);
    population.orientation.resize(spec.bodies);
    population.angular_velocity.resize(spec.bodies);
  }
  if (spec.kind == GeneratorKind::level) {
    fill_level(spec, population);
  } else {
    fill_cube(spec, population);
  }
  draw_velocities(spec, population);
  return population;
}

}  // namespace carom::io

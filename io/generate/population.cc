#include "io/generate/population.h"

#include <cmath>

#include "io/generate/ground.h"

namespace carom::io {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDensity = 0.1;
constexpr double kBodiesPerSquareMetre = 1.0 / 6.0;

enum Stream : uint64_t { kShapes = 1, kPlaces = 2, kVelocities = 3, kGround = 4 };

double volume(const GeneratorSpec& spec, double edge) {
  double cube = edge * edge * edge;
  return spec.spheres ? cube * (kPi / 6) : cube;
}

// Draws the sizes; returns the sum of the volumes.
double draw_cubes(const GeneratorSpec& spec, Population& population) {
  Random random(spec.seed, kShapes);
  LogUniform sizes(1, 316);
  double sum = 0;
  for (Vec3& half : population.half) {
    double edge = spec.kind == GeneratorKind::varied ? sizes.draw(random) : 1.0;
    sum += volume(spec, edge);
    half = spec.spheres ? Vec3{edge / 2, edge / 2, edge / 2}
                        : half_extents_turned({edge, edge, edge}, random);
  }
  return sum;
}

void draw_velocities(const GeneratorSpec& spec, Population& population) {
  Random random(spec.seed, kVelocities);
  for (uint64_t i = 0; i < population.velocity.size(); i += population.mover_stride) {
    population.velocity[i] = random.in_ball(population.speed);
  }
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
  LogUniform edges(0.5, 4);
  for (Vec3& half : population.half) {
    if (spec.spheres) {
      double radius = edges.draw(random) / 2;
      half = {radius, radius, radius};
    } else {
      double x = edges.draw(random);
      double y = edges.draw(random);
      double z = edges.draw(random);
      half = half_extents_turned_about_y({x, y, z}, random);
    }
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
  if (spec.kind == GeneratorKind::level) {
    fill_level(spec, population);
  } else {
    fill_cube(spec, population);
  }
  draw_velocities(spec, population);
  return population;
}

}  // namespace carom::io

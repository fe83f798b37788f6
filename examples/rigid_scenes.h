// The scenes of examples/rigid_bodies.cc: piles that have to stand, and bodies that have to stay
// where they are put or fall to where they belong. Metres, kilograms; z is up.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "rigid_solver.h"

namespace rigid {

struct Scene {
  Solver solver = Solver();
  std::vector<BodyId> moving = {};  // in the order in which they were added
};

// ------------------------------------------------------------ masses: 1000 kg a cubic metre

inline constexpr float kDensity = 1000;

inline Mass mass_of_box(const Vector3f& half) {
  Mass mass{.mass = kDensity * 8 * half.prod()};
  const Vector3f squares = half.cwiseAbs2();
  mass.inertia.diagonal() = mass.mass / 3 * (Vector3f::Constant(squares.sum()) - squares);
  return mass;
}

inline Mass mass_of_ball(float radius) {
  const float mass = kDensity * 4 / 3 * std::numbers::pi_v<float> * radius * radius * radius;
  return {mass, 0.4f * mass * radius * radius * Matrix3f::Identity()};
}

// A capsule along x, as a cylinder and two halves of a ball.
inline Mass mass_of_capsule(float half_length, float radius) {
  const float square = radius * radius;
  const float cylinder = kDensity * std::numbers::pi_v<float> * square * 2 * half_length;
  const float ball = mass_of_ball(radius).mass;
  const float along = cylinder * square / 2 + ball * square * 0.4f;
  const float across =
      cylinder * (square / 4 + half_length * half_length / 3) +
      ball * (square * 0.4f + half_length * half_length + 0.75f * half_length * radius);
  return {cylinder + ball, Vector3f(along, across, across).asDiagonal()};
}

using Faces = std::vector<std::vector<uint32_t>>;

// Moves the corners of a closed polytope so that its centre of mass is the origin. Integrals over
// the tetrahedra between the origin and the triangles of the faces.
inline Mass centre(std::vector<Vector3f>& corners, const Faces& faces) {
  float volume = 0;
  Vector3f first = Vector3f::Zero();
  Matrix3f second = Matrix3f::Zero();
  for (const auto& face : faces) {
    for (size_t i = 2; i < face.size(); ++i) {
      const Vector3f &p = corners[face[0]], &q = corners[face[i - 1]], &r = corners[face[i]];
      const float part = p.dot(q.cross(r)) / 6;
      const Vector3f sum = p + q + r;
      volume += part;
      first += part / 4 * sum;
      second += part / 20 *
                (p * p.transpose() + q * q.transpose() + r * r.transpose() + sum * sum.transpose());
    }
  }
  const Vector3f middle = first / volume;
  second -= volume * middle * middle.transpose();
  for (Vector3f& corner : corners) corner -= middle;
  return {kDensity * volume, kDensity * (second.trace() * Matrix3f::Identity() - second)};
}

// ------------------------------------------------------------ bodies

inline BodyId add_moving(Scene& scene, carom::BodyDesc body, const Mass& mass) {
  scene.moving.push_back(scene.solver.add(body, mass));
  return scene.moving.back();
}

inline BodyId add_box(Scene& scene, const Vector3f& half, const Vector3f& position,
                      const Quaternionf& orientation = Quaternionf::Identity()) {
  return add_moving(
      scene,
      {.shape = carom::Box{half}, .position = position.cast<double>(), .orientation = orientation},
      mass_of_box(half));
}

// The top of the floor is z = 0.
inline void add_floor(Scene& scene, float half_width = 50) {
  scene.solver.add({.shape = carom::Box{{half_width, half_width, 0.5f}}, .position = {0, 0, -0.5}});
}

// What could be made cannot fail: the arrays are those of this file.
template <class Geometry>
Geometry expect(carom::Result<Geometry> made) {
  if (made) return *made;
  std::fprintf(stderr, "%s\n", made.error().message.c_str());
  std::abort();
}

// A surface z = height(x, y) over a square of cells about the origin, as a mesh that meets bodies
// from above alone.
inline void add_terrain(Scene& scene, int cells, float cell,
                        const std::function<float(float, float)>& height) {
  std::vector<Vector3f> corners;
  std::vector<std::array<uint32_t, 3>> triangles;
  const auto corner = [&](int i, int j) { return static_cast<uint32_t>(i * (cells + 1) + j); };
  for (int i = 0; i <= cells; ++i) {
    for (int j = 0; j <= cells; ++j) {
      const float x = cell * (static_cast<float>(i) - 0.5f * static_cast<float>(cells));
      const float y = cell * (static_cast<float>(j) - 0.5f * static_cast<float>(cells));
      corners.emplace_back(x, y, height(x, y));
      if (i == cells || j == cells) continue;
      triangles.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)});
      triangles.push_back({corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)});
    }
  }
  scene.solver.add({.shape = carom::Mesh{expect(carom::make_mesh(
                        corners, triangles, {.one_sided = true, .thickness = 0.5f}))}});
}

// ------------------------------------------------------------ scenes

inline Scene make_stack() {
  Scene scene;
  add_floor(scene);
  for (int i = 0; i < 20; ++i) {
    add_box(scene, Vector3f::Constant(0.5f), {0, 0, 0.5f + static_cast<float>(i)});
  }
  return scene;
}

// 10 courses of 20 bricks; every other course begins and ends with half a brick.
inline Scene make_wall() {
  Scene scene;
  add_floor(scene);
  const Vector3f whole(0.5f, 0.25f, 0.25f), half(0.25f, 0.25f, 0.25f);
  for (int course = 0; course < 10; ++course) {
    const float z = 0.25f + 0.5f * static_cast<float>(course);
    if (course % 2 == 0) {
      for (int i = 0; i < 20; ++i) add_box(scene, whole, {static_cast<float>(i) - 9.5f, 0, z});
    } else {
      add_box(scene, half, {-9.75f, 0, z});
      for (int i = 0; i < 19; ++i) add_box(scene, whole, {static_cast<float>(i) - 9, 0, z});
      add_box(scene, half, {9.75f, 0, z});
    }
  }
  return scene;
}

// Layers of 5 x 5 boxes, 4 x 4, and so on.
inline Scene make_pyramid() {
  Scene scene;
  add_floor(scene);
  for (int layer = 0; layer < 5; ++layer) {
    const int side = 5 - layer;
    for (int i = 0; i < side * side; ++i) {
      const float x = static_cast<float>(2 * (i / side) - side + 1);
      const float y = static_cast<float>(2 * (i % side) - side + 1);
      add_box(scene, Vector3f::Constant(0.5f),
              {0.55f * x, 0.55f * y, 0.5f + static_cast<float>(layer)});
    }
  }
  return scene;
}

// A tetrahedron, an octahedron, a cube or a prism of six sides, of circumradius one.
inline std::pair<std::vector<Vector3f>, Faces> make_solid(int kind) {
  if (kind == 0) {
    return {{{0, 0, 1}, {0.94f, 0, -0.33f}, {-0.47f, 0.82f, -0.33f}, {-0.47f, -0.82f, -0.33f}},
            {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
  }
  if (kind == 1) {
    return {
        {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
        {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}}};
  }
  const uint32_t sides = kind == 2 ? 4 : 6;
  std::vector<Vector3f> corners;
  std::vector<uint32_t> below, above;
  Faces faces;
  for (uint32_t i = 0; i < sides; ++i) {
    const float angle =
        2 * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(sides);
    for (const float z : {-0.6f, 0.6f})
      corners.emplace_back(0.8f * std::cos(angle), 0.8f * std::sin(angle), z);
    const uint32_t next = (i + 1) % sides;
    faces.push_back({2 * i, 2 * next, 2 * next + 1, 2 * i + 1});
    below.insert(below.begin(), 2 * i);
    above.push_back(2 * i + 1);
  }
  faces.push_back(below);
  faces.push_back(above);
  return {corners, faces};
}

inline float hills(float x, float y) {
  const float rim = std::max(std::max(std::abs(x), std::abs(y)) - 9, 0.0f);
  return 0.5f * std::sin(0.7f * x) * std::cos(0.6f * y) + 2.0f * rim;
}

// Random numbers that are the same with every standard library.
class Random {
 public:
  float between(float low, float high) {
    return low + (high - low) * static_cast<float>(generator_() >> 8) / 16777216.0f;
  }

 private:
  std::mt19937 generator_{7};
};

// 500 hulls of 16 shapes, stretched and turned at random, fall on hills with a rim around them.
inline Scene make_hulls() {
  Scene scene{Solver({.substeps = 4})};  // no high piles
  add_terrain(scene, 26, 1, hills);
  Random random;
  std::vector<std::pair<carom::Hull, Mass>> shapes;
  for (int i = 0; i < 16; ++i) {
    auto [corners, faces] = make_solid(i % 4);
    const Vector3f stretch(random.between(0.25f, 0.5f), random.between(0.25f, 0.5f),
                           random.between(0.25f, 0.5f));
    for (Vector3f& corner : corners) corner = corner.cwiseProduct(stretch);
    const Mass mass = centre(corners, faces);
    shapes.emplace_back(carom::Hull{expect(carom::make_hull(corners, faces))}, mass);
  }
  for (int i = 0; i < 500; ++i) {
    const auto& [hull, mass] = shapes[i % 16];
    carom::BodyDesc body{.shape = hull};
    body.position = {1.2 * (i % 10) - 5.4, 1.2 * (i / 10 % 10) - 5.4, 2 + 1.2 * (i / 100)};
    body.orientation =
        Quaternionf(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1), 1)
            .normalized();
    add_moving(scene, body, mass);
  }
  return scene;
}

// A house of cards of three storeys. Two cards lean against each other, and a flat one lies on the
// tops of two such tents.
inline Scene make_cards() {
  Scene scene{Solver({.friction = 0.8f}), {}};
  add_floor(scene);
  const Vector3f half(0.01f, 0.3f, 0.45f);
  const float angle = 0.35f, width = 2 * (half.z() * std::sin(angle) + half.x() * std::cos(angle));
  const float storey = 2 * (half.z() * std::cos(angle) + half.x() * std::sin(angle));
  float floor = 0;
  for (int tents = 3; tents > 0; --tents) {
    for (int i = 0; i < tents; ++i) {
      const float x = 2 * width * (static_cast<float>(i) - 0.5f * static_cast<float>(tents - 1));
      for (const float side : {-1.0f, 1.0f}) {
        add_box(scene, half, {x + 0.5f * side * width, 0, floor + 0.5f * storey},
                Quaternionf(Eigen::AngleAxisf(-side * angle, Vector3f::UnitY())));
      }
    }
    floor += storey;
    for (int i = 0; i + 1 < tents; ++i) {
      const float x = 2 * width * (static_cast<float>(i) - 0.5f * static_cast<float>(tents - 2));
      add_box(scene, {width, half.y(), half.x()}, {x, 0, floor + half.x()});
    }
    floor += 2 * half.x();
  }
  return scene;
}

inline float bowl(float x, float y) { return 0.25f * (x * x + y * y); }

inline Scene make_marbles() {
  Scene scene;
  add_terrain(scene, 40, 0.2f, bowl);
  Random random;
  for (int i = 0; i < 100; ++i) {
    const float radius = random.between(0.08f, 0.15f);
    const Vector3f position(0.4f * static_cast<float>(i % 5) - 0.8f + random.between(-0.05f, 0.05f),
                            0.4f * static_cast<float>(i / 5 % 5) - 0.8f,
                            1.5f + 0.4f * static_cast<float>(i / 25));
    add_moving(scene, {.shape = carom::Sphere{radius}, .position = position.cast<double>()},
               mass_of_ball(radius));
  }
  return scene;
}

// A box in the corner of three planes that are equally steep: it rests on three sides. 1 cm off
// each.
inline Scene make_corner() {
  Scene scene;
  const Quaternionf tip = Quaternionf::FromTwoVectors(Vector3f(1, 1, 1), Vector3f::UnitZ());
  for (int axis = 0; axis < 3; ++axis) {
    scene.solver.add({.shape = carom::Halfspace{tip * Vector3f::Unit(axis)}});
  }
  add_box(scene, {0.5f, 0.4f, 0.3f}, tip * Vector3f(0.51f, 0.41f, 0.31f), tip);
  return scene;
}

// The same corner as one mesh: the pair of it and the box has three contacts.
inline Scene make_mesh_corner() {
  Scene scene;
  const Quaternionf tip = Quaternionf::FromTwoVectors(Vector3f(1, 1, 1), Vector3f::UnitZ());
  const std::vector<Vector3f> corners = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0},
                                         {0, 4, 4}, {0, 0, 4}, {4, 0, 4}};
  const std::vector<std::array<uint32_t, 3>> triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4},
                                                          {0, 4, 5}, {0, 5, 6}, {0, 6, 1}};
  scene.solver.add({.shape = carom::Mesh{expect(carom::make_mesh(
                        corners, triangles, {.one_sided = true, .thickness = 0.5f}))},
                    .orientation = tip});
  add_box(scene, {0.5f, 0.4f, 0.3f}, tip * Vector3f(0.51f, 0.41f, 0.31f), tip);
  return scene;
}

// 20 capsules that are joined end to end, held at one end beside a beam, swing down on it. Each
// overlaps its neighbours.
inline Scene make_chain() {
  Scene scene;
  add_floor(scene);
  scene.solver.add({.shape = carom::Box{{0.5f, 2, 0.5f}}, .position = {3, 0, 3}});
  const BodyId peg = scene.solver.add({.shape = carom::Sphere{0.1f}, .position = {0, 0, 6}});
  const float half = 0.2f, radius = 0.1f;
  BodyId last = peg;
  for (int i = 0; i < 20; ++i) {
    const Vector3f start(2 * half * static_cast<float>(i), 0, 6);
    carom::BodyDesc link{.shape = carom::Capsule{{-half, 0, 0}, {half, 0, 0}, radius}};
    link.position = (start + Vector3f(half, 0, 0)).cast<double>();
    const BodyId id = add_moving(scene, link, mass_of_capsule(half, radius));
    scene.solver.join(last, id, start);
    last = id;
  }
  return scene;
}

// What a scene has to hold to, whatever the number of steps.
struct NamedScene {
  const char* name;
  Scene (*make)();
  float most_depth;  // of any overlap, metres
  double most_way;   // of any body, metres
};

inline constexpr NamedScene kScenes[] = {
    {"stack", make_stack, 0.002f, 0.01},     {"wall", make_wall, 0.002f, 0.005},
    {"pyramid", make_pyramid, 0.002f, 0.01}, {"hulls", make_hulls, 0.2f, 20},
    {"cards", make_cards, 0.002f, 0.005},    {"marbles", make_marbles, 0.04f, 10},
    {"corner", make_corner, 0.002f, 0.05},   {"mesh_corner", make_mesh_corner, 0.002f, 0.05},
    {"chain", make_chain, 0.04f, 10}};

// Kinetic energy and that of height, in joules.
inline double energy(const Scene& scene) {
  const carom::World& world = scene.solver.world();
  double sum = 0;
  for (const BodyId id : scene.moving) {
    const Body& body = scene.solver.bodies()[id.index];
    const double mass = 1 / body.inverse_mass;
    const Vector3f spin = world.orientation(id).conjugate() * body.spin;
    sum += 0.5 * mass * body.velocity.squaredNorm() + 9.81 * mass * world.position(id).z() +
           0.5 * spin.dot(body.inverse_inertia.inverse() * spin);
  }
  return sum;
}

// What has happened to a scene so far.
class Watch {
 public:
  explicit Watch(const Scene& scene) : energy_at_start(energy(scene)) {
    for (const BodyId id : scene.moving) starts_.push_back(scene.solver.world().position(id));
  }

  void note(const Scene& scene) {
    energy_gain = std::max(energy_gain, energy(scene) - energy_at_start);
    for (const carom::Contact& contact : scene.solver.world().contacts()) {
      deepest = std::max(deepest, -contact.separation);
    }
  }

  // The longest way of a body from where it was at the start, in metres.
  double furthest(const Scene& scene) const {
    const std::vector<double> all = ways(scene);
    return *std::max_element(all.begin(), all.end());
  }

  // How far each moving body is from where it was at the start, in metres.
  std::vector<double> ways(const Scene& scene) const {
    std::vector<double> all;
    for (size_t i = 0; i < starts_.size(); ++i) {
      all.push_back((scene.solver.world().position(scene.moving[i]) - starts_[i]).norm());
    }
    return all;
  }

  double energy_at_start;
  double energy_gain = 0;  // joules
  float deepest = 0;       // metres

 private:
  std::vector<Eigen::Vector3d> starts_;
};

// The speed of the fastest body, in metres a second; turning counts as for a point one metre off.
inline float fastest(const Scene& scene) {
  float most = 0;
  for (const Body& body : scene.solver.bodies()) {
    most = std::max(most, body.velocity.norm() + body.spin.norm());
  }
  return most;
}

}  // namespace rigid

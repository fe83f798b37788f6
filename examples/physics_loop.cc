// A physics loop with Carom as its collision world. The loop moves the bodies, Carom reports which
// of them touch and how, and the loop decides what follows. It shows three uses of contacts:
// pushing bodies apart, coming to rest on the ground, and triggers.
#include <carom/carom.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

namespace {

using carom::BodyId;
using carom::Contact;
using carom::Event;
using carom::EventKind;
using carom::Motion;
using carom::World;

constexpr float kTimeStep = 1.0f / 60;
constexpr float kGravity = -9.81f;
constexpr int kFrames = 150;

// The role of a body in the game; Carom stores it as the body's user value.
enum class Role : uint64_t { ground, wall, ball, player, missile, pickup };

struct Game {
  World world;
  std::vector<BodyId> movers;  // all bodies that are not static
  BodyId ball, left, right, missile, pickup;
  double time = 0;
  int explosions = 0;
  int pickups = 0;
};

BodyId add(Game& game, Role role, carom::BodyDesc body) {
  body.user = static_cast<uint64_t>(role);
  const BodyId id = game.world.add(body);
  if (body.motion != Motion::fixed) game.movers.push_back(id);
  return id;
}

void set_up(Game& game) {
  add(game, Role::ground,
      {.shape = carom::Aabb{{-50, -50, -1}, {50, 50, 0}}, .motion = Motion::fixed});
  add(game, Role::wall,
      {.shape = carom::Aabb{{0, -5, 0}, {1, 5, 5}},
       .position = {20, 0, 0},
       .motion = Motion::fixed});

  // A ball high up, and two on the ground that overlap by 20 cm.
  game.ball = add(game, Role::ball, {.shape = carom::Sphere{0.5f}, .position = {0, 10, 3}});
  game.left = add(game, Role::ball, {.shape = carom::Sphere{0.5f}, .position = {-0.4, -10, 0.5}});
  game.right = add(game, Role::ball, {.shape = carom::Sphere{0.5f}, .position = {0.4, -10, 0.5}});

  // The player walks over the pick-up. The missile starts inside the player but does not hit it,
  // because they share an owner.
  constexpr uint32_t kPlayerOne = 1;
  add(game, Role::player,
      {.shape = carom::Aabb{{-0.3f, -0.3f, 0}, {0.3f, 0.3f, 1.8f}},
       .linear_velocity = {1.5f, 0, 0},
       .motion = Motion::kinematic,
       .owner = kPlayerOne});
  game.missile = add(game, Role::missile,
                     {.shape = carom::Sphere{0.1f},
                      .position = {0, 0, 1.5},
                      .linear_velocity = {25, 0, 0},
                      .motion = Motion::kinematic,
                      .owner = kPlayerOne});
  game.pickup = add(game, Role::pickup,
                    {.shape = carom::Sphere{0.25f},
                     .position = {2, 0, 0.5},
                     .motion = Motion::fixed,
                     .sensor = true});
}

// --- Dynamics: not part of Carom --------------------------------------------------------------

// Applies gravity and velocities straight in the arrays of the world.
void move_bodies(Game& game) {
  const carom::BodyArrays arrays = game.world.arrays();
  const auto velocities = game.world.linear_velocities();
  for (const BodyId id : game.movers) {
    Eigen::Vector3f& velocity = velocities[id.index];
    if (game.world.motion(id) == Motion::dynamic) velocity.z() += kGravity * kTimeStep;
    float* position = arrays.record32 + 4 * id.index;
    for (int axis = 0; axis < 3; ++axis) position[axis] += velocity[axis] * kTimeStep;
  }
}

bool remove(Game& game, BodyId id) {
  std::erase(game.movers, id);
  return game.world.remove(id);
}

float inverse_mass(const World& world, BodyId id) {
  return world.motion(id) == Motion::dynamic ? 1.0f : 0.0f;
}

// --- The first two uses of contacts: pushing apart and rest
// ---------------------------------------

// Moving B by -separation * normal makes A and B touch. The lighter body moves further.
void push_apart(World& world, const Contact& contact) {
  const BodyId a = world.id_of(contact.a);
  const BodyId b = world.id_of(contact.b);
  const float mass_a = inverse_mass(world, a);
  const float mass_b = inverse_mass(world, b);
  if (mass_a + mass_b == 0) return;

  const Eigen::Vector3f way = -contact.separation / (mass_a + mass_b) * contact.normal;
  world.set_position(a, world.position(a) - (mass_a * way).cast<double>());
  world.set_position(b, world.position(b) + (mass_b * way).cast<double>());

  if (contact.normal_velocity >= 0) return;  // already separating
  const Eigen::Vector3f stop = -contact.normal_velocity / (mass_a + mass_b) * contact.normal;
  world.set_linear_velocity(a, world.linear_velocity(a) - mass_a * stop);
  world.set_linear_velocity(b, world.linear_velocity(b) + mass_b * stop);
}

// --- The third use: triggers ------------------------------------------------------------------

void explode(Game& game, const Event& event) {
  // The place is the witness point of A, relative to A's position.
  const Contact& contact = game.world.contacts()[event.contact];
  const Eigen::Vector3d at = game.world.position(event.a) + contact.arm_a.cast<double>();
  if (!remove(game, game.missile)) return;
  ++game.explosions;
  std::printf("%.2f s  the missile explodes at (%.2f, %.2f, %.2f)\n", game.time, at.x(), at.y(),
              at.z());
}

void consume(Game& game) {
  if (!remove(game, game.pickup)) return;
  ++game.pickups;
  std::printf("%.2f s  the player takes the pick-up\n", game.time);
}

bool involves(const World& world, const Event& event, Role role) {
  const auto has_role = [&](BodyId id) { return world.user(id) == static_cast<uint64_t>(role); };
  return has_role(event.a) || has_role(event.b);
}

void react(Game& game, const Event& event) {
  const World& world = game.world;
  if (event.kind != EventKind::begin) return;
  if (!world.contains(event.a) || !world.contains(event.b)) return;  // removed by another event
  if (involves(world, event, Role::missile) && event.contact != carom::kNoContact) {
    explode(game, event);
  } else if (involves(world, event, Role::pickup) && involves(world, event, Role::player)) {
    consume(game);
  } else if (event.a == game.ball || event.b == game.ball) {
    std::printf("%.2f s  the ball lands\n", game.time);
  }
}

// --- The loop ---------------------------------------------------------------------------------

void run_frame(Game& game) {
  game.time += kTimeStep;
  move_bodies(game);
  game.world.step();
  for (const Contact& contact : game.world.contacts()) push_apart(game.world, contact);
  for (const Event& event : game.world.events()) react(game, event);
}

bool check(bool holds, const char* claim) {
  std::printf("%-6s %s\n", holds ? "ok" : "FAILED", claim);
  return holds;
}

bool is_near(double x, double y) { return std::abs(x - y) < 1e-5; }

bool check_claims(const Game& game) {
  const World& world = game.world;
  const double gap = (world.position(game.right) - world.position(game.left)).norm() - 1;
  bool all = check(is_near(gap, 0), "the two balls were pushed apart and touch");
  all &= check(is_near(world.position(game.ball).z(), 0.5), "the ball lies on the ground");
  all &= check(world.linear_velocity(game.ball).norm() == 0, "the ball is at rest");
  all &= check(game.explosions == 1 && !world.contains(game.missile), "the missile exploded once");
  all &= check(game.pickups == 1 && !world.contains(game.pickup), "the pick-up was taken once");
  return all;
}

}  // namespace

int main() {
  Game game;
  set_up(game);
  for (int frame = 0; frame < kFrames; ++frame) run_frame(game);
  return check_claims(game) ? 0 : 1;
}

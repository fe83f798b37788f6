// Bullets in a room with walls as thin as paper. Each bullet moves to its first impact and bounces.
// Discrete detection would lose most of them in the first frames.
#include <carom/carom.h>

#include <cmath>
#include <cstdio>
#include <vector>

namespace {

constexpr float kTimeStep = 1.0f / 60;
constexpr float kRoom = 2;  // half the side, metres
constexpr float kWall = 0.001f;
constexpr int kBullets = 100;
constexpr int kFrames = 120;

void add_walls(carom::World& world) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      carom::Box wall{{kRoom, kRoom, kRoom}};
      wall.half[axis] = kWall;
      carom::BodyDesc body{.shape = wall, .motion = carom::Motion::fixed};
      body.position[axis] = side * kRoom;
      world.add(body);
    }
  }
}

struct Bullet {
  carom::BodyId id;
  Eigen::Vector3f velocity;

  bool goes_along(const Eigen::Vector3f& normal) const { return velocity.dot(normal) > 0; }
  void bounce_off(const Eigen::Vector3f& normal) {
    if (goes_along(normal)) velocity -= 2 * velocity.dot(normal) * normal;
  }
};

// 1 to 3 cm, 100 to 300 m/s: up to 5 m a frame, more than the room is wide.
std::vector<Bullet> add_bullets(carom::World& world) {
  std::vector<Bullet> bullets;
  for (int i = 0; i < kBullets; ++i) {
    const float turn = 2.4f * static_cast<float>(i), height = 0.018f * static_cast<float>(i) - 0.9f;
    const float speed = 100 + 2 * static_cast<float>(i);
    carom::BodyDesc body{.shape = carom::Sphere{0.01f + 0.0002f * static_cast<float>(i)}};
    body.position = {std::cos(turn), std::sin(turn), 1.5 * height};
    body.linear_velocity = {speed * std::sin(turn), speed * std::cos(turn), speed * height};
    body.detection = carom::Detection::continuous;
    body.user = bullets.size() + 1;  // walls have 0
    bullets.push_back({world.add(body), body.linear_velocity});
  }
  return bullets;
}

// After an impact a bullet touches the other body to within rounding. A bullet that would move on
// into a body it touches bounces instead, and `stays` for this frame.
void bounce_off_contacts(const carom::World& world, std::vector<Bullet>& bullets,
                         std::vector<bool>& stays) {
  const auto bounce = [&](uint32_t body, const Eigen::Vector3f& normal) {
    const uint64_t user = world.user(world.id_of(body));
    if (user == 0 || !bullets[user - 1].goes_along(normal)) return;
    bullets[user - 1].bounce_off(normal);
    stays[user - 1] = true;
  };
  for (const carom::Contact& contact : world.contacts()) {
    bounce(contact.a, contact.normal);  // the normal points from a to b
    bounce(contact.b, -contact.normal);
  }
}

// Moves the bullet to its first impact, or to the end of the frame. Returns whether there was one.
bool fly(carom::World& world, Bullet& bullet) {
  const carom::Impact* impact = world.first_impact(bullet.id);
  const float share = impact ? impact->toi : 1;
  const Eigen::Vector3d way = (bullet.velocity * (kTimeStep * share)).cast<double>();
  world.set_position(bullet.id, world.position(bullet.id) + way);
  if (!impact) return false;
  bullet.bounce_off(world.id_of(impact->a) == bullet.id ? impact->normal : -impact->normal);
  return true;
}

bool is_in_room(const Eigen::Vector3d& position) { return position.cwiseAbs().maxCoeff() < kRoom; }

}  // namespace

int main() {
  carom::World world({.dt = kTimeStep});
  add_walls(world);
  std::vector<Bullet> bullets = add_bullets(world);

  size_t bounces = 0;
  for (int frame = 0; frame < kFrames; ++frame) {
    world.step();
    std::vector<bool> stays(bullets.size());
    bounce_off_contacts(world, bullets, stays);
    for (size_t i = 0; i < bullets.size(); ++i) {
      if (!stays[i]) bounces += fly(world, bullets[i]);
    }
    for (const Bullet& bullet : bullets) world.set_linear_velocity(bullet.id, bullet.velocity);
  }

  size_t in_room = 0;
  for (const Bullet& bullet : bullets) in_room += is_in_room(world.position(bullet.id));
  std::printf("%zu of %d bullets are in the room after %zu bounces\n", in_room, kBullets, bounces);
  return in_room == bullets.size() && bounces > 0 ? 0 : 1;
}

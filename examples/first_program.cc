// A ball that sinks into the ground by ten centimetres.
#include <carom/carom.h>

#include <cstdio>

int main() {
  carom::World world;
  world.add({.shape = carom::Sphere{0.5f}, .position = {0, 0, 0.4}});
  world.add({.shape = carom::Aabb{{-10, -10, -1}, {10, 10, 0}}, .motion = carom::Motion::fixed});

  world.step();
  for (const carom::Contact& contact : world.contacts()) {
    std::printf("bodies %u and %u: %.1f m deep, normal (%g, %g, %g)\n", contact.a, contact.b,
                -contact.separation, contact.normal.x(), contact.normal.y(), contact.normal.z());
  }
  return world.contacts().size() == 1 ? 0 : 1;
}

#include "tests/world/tolerance.h"

#include "carom/reference/reference.h"

namespace carom::test {

double true_separation(const World& world, Pair pair) {
  const BodyId a = world.id_of(pair.a), b = world.id_of(pair.b);
  return reference::collide(world.shape(a), {world.position(a), world.orientation(a)},
                            world.shape(b), {world.position(b), world.orientation(b)},
                            world.settings().positions)
      .separation;
}

}  // namespace carom::test

// Keeps a set of neighbours for every body of a drifting crowd, from the pairs that begin and end.
// The margin makes pairs last, so most steps change only a few.
#include <carom/carom.h>

#include <cmath>
#include <cstdio>
#include <set>
#include <vector>

namespace {

constexpr int kSide = 12;  // bodies along each edge of a square
constexpr int kSteps = 100;

using Neighbours = std::vector<std::set<uint32_t>>;

void follow(const carom::World& world, Neighbours& neighbours) {
  // Removed pairs first: a pair is in both lists if another body took over an index.
  for (const carom::Pair& pair : world.removed_pairs()) {
    neighbours[pair.a].erase(pair.b);
    neighbours[pair.b].erase(pair.a);
  }
  for (const carom::Pair& pair : world.added_pairs()) {
    neighbours[pair.a].insert(pair.b);
    neighbours[pair.b].insert(pair.a);
  }
}

}  // namespace

int main() {
  carom::World world({.detail = carom::Detail::pairs, .margin = 0.2f, .pair_changes = true});
  std::vector<carom::BodyId> ids;
  for (int i = 0; i < kSide * kSide; ++i) {
    ids.push_back(world.add(
        {.shape = carom::Sphere{0.4f}, .position = {double(i % kSide), double(i / kSide), 0}}));
  }

  Neighbours neighbours(ids.size());
  size_t changes = 0;
  size_t quiet_steps = 0;
  for (int step = 0; step < kSteps; ++step) {
    world.step();
    follow(world, neighbours);
    const size_t changed = world.added_pairs().size() + world.removed_pairs().size();
    changes += changed;
    quiet_steps += changed == 0;
    for (size_t i = 0; i < ids.size(); ++i) {
      const double angle = 0.7 * static_cast<double>(i);
      const Eigen::Vector3d way(std::cos(angle), std::sin(angle), 0);
      world.set_position(ids[i], world.position(ids[i]) + 0.005 * way);
    }
  }

  size_t known = 0;
  for (const std::set<uint32_t>& near : neighbours) known += near.size();
  std::printf("%zu pairs of neighbours, %zu changes; nothing changed in %zu of %d steps\n",
              known / 2, changes, quiet_steps, kSteps);
  return known == 2 * world.pairs().size() && quiet_steps > 0 ? 0 : 1;
}

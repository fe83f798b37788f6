#include "carom/results/space_groups.h"

#include <algorithm>

#include "world/world_state.h"

namespace carom {
namespace {

// Bodies without an entry in `space` are in space 0.
template <class Result>
void group(std::span<const Result> results, std::span<const uint32_t> space, SpaceGroups& groups) {
  const auto space_of = [&](uint32_t i) {
    return results[i].a < space.size() ? space[results[i].a] : 0;
  };
  groups.items.resize(results.size());
  for (uint32_t i = 0; i < results.size(); ++i) groups.items[i] = i;
  const auto is_before = [&](uint32_t i, uint32_t k) { return space_of(i) < space_of(k); };
  // In order already where the bodies of a space follow one another.
  if (!std::is_sorted(groups.items.begin(), groups.items.end(), is_before)) {
    std::stable_sort(groups.items.begin(), groups.items.end(), is_before);
  }
  groups.spaces.clear();
  groups.first.clear();
  for (uint32_t i = 0; i < groups.items.size(); ++i) {
    const uint32_t own = space_of(groups.items[i]);
    if (i > 0 && own == groups.spaces.back()) continue;
    groups.spaces.push_back(own);
    groups.first.push_back(i);
  }
  groups.first.push_back(static_cast<uint32_t>(groups.items.size()));
}

}  // namespace

void World::group_pairs(SpaceGroups& groups) const {
  group(pairs(), state_->bodies.spaces(), groups);
}

void World::group_contacts(SpaceGroups& groups) const {
  group(contacts(), state_->bodies.spaces(), groups);
}

}  // namespace carom

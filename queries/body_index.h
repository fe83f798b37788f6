// Bodies as queries search them: by the tree of their bounds, and half-spaces one by one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/halfspace_pairs.h"
#include "carom/shapes/views.h"
#include "trees/tree.h"

namespace carom {

struct BodyIndex {
  BoxTree tree;  // of bounds that have been grown by what tests of a pair may err
  std::vector<WorldHalfspace> halfspaces;

  size_t bytes() const { return tree.bytes() + halfspaces.capacity() * sizeof(WorldHalfspace); }
};

// Of bodies with these bounds, which are empty for half-spaces and what takes no part.
BodyIndex index_bodies(const Collidables& bodies, const BoundsView& bounds,
                       std::span<const WorldHalfspace> halfspaces, Parallelism parallelism);

// Of all valid bodies of the view.
BodyIndex index_bodies(const Collidables& bodies, Parallelism parallelism);

// Bodies with their index, and which of them queries meet: those whose layer (nullptr: all bits)
// has a bit of the mask.
struct SearchedBodies {
  const Collidables& bodies;
  const BodyIndex& index;
  const uint32_t* layer = nullptr;
  uint32_t mask = 0xffffffffu;

  bool is_met(uint32_t body) const { return ((layer ? layer[body] : ~0u) & mask) != 0; }
};

}  // namespace carom

// An index of bodies for queries: a tree of their bounds, and a list of half-spaces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/halfspace_pairs.h"
#include "carom/shapes/views.h"
#include "trees/tree.h"

namespace carom {

struct BodyIndex {
  BoxTree tree;  // of bounds, grown by the error of pair tests
  std::vector<WorldHalfspace> halfspaces;

  size_t bytes() const { return tree.bytes() + halfspaces.capacity() * sizeof(WorldHalfspace); }
};

// Indexes bodies with these bounds. The bounds of half-spaces and of bodies that take no part are
// empty.
BodyIndex index_bodies(const Collidables& bodies, const BoundsView& bounds,
                       std::span<const WorldHalfspace> halfspaces, Parallelism parallelism);

// Indexes all valid bodies of the view.
BodyIndex index_bodies(const Collidables& bodies, Parallelism parallelism);

// Bodies with their index. Queries meet a body if its layer (nullptr: all bits) has a bit of the
// mask.
struct SearchedBodies {
  const Collidables& bodies;
  const BodyIndex& index;
  const uint32_t* layer = nullptr;
  uint32_t mask = 0xffffffffu;

  bool is_met(uint32_t body) const { return ((layer ? layer[body] : ~0u) & mask) != 0; }
};

}  // namespace carom

// The world's entry to the mid-phase and the narrow phase.
#pragma once

#include <span>

#include "carom/narrowphase/collide.h"
#include "midphase/extra_contacts.h"
#include "narrowphase/batch/packed_direction.h"
#include "narrowphase/blocks/kept_shells.h"

namespace carom {

// Pairs of bodies of one set.
struct PairsOfWorld {
  const Collidables& bodies;
  std::span<const Pair> pairs;
  bool has_composites;  // whether there may be meshes and compounds
  // nullptr, or one entry a pair, kNoDirection at first. The caller hands an entry in again with
  // the pair's next test; a pair that is still separate in that direction takes a short cut.
  // Results are the same. It must be nullptr unless only overlapping pairs are measured, without
  // contact distances.
  uint32_t* direction = nullptr;
  // nullptr, or the shells of the step, with a tolerance; pair i is row first_row + i there.
  ShellLists* shells = nullptr;
  size_t first_row = 0;
  // nullptr, or at Detail::regions what receives the contacts beside the first one of a pair.
  ExtraContacts* extra = nullptr;
};

// collide() within one set. The kinds must have been checked when the bodies were added, and so
// must the contact distances.
void collide_pairs(const PairsOfWorld& tested, Detail detail, const ResultColumns& out,
                   const CollideOptions& options);

// Fails if no kernel exists for the kinds of some pair.
Result<void> check_pairs(const Collidables& a, const Collidables& b, std::span<const Pair> pairs);

// Whether the test of these kinds uses a direction.
bool uses_directions(ShapeKind a, ShapeKind b);

}  // namespace carom

// An index of bodies for queries: a tree of their bounds, and a list of half-spaces.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/halfspace_pairs.h"
#include "carom/queries/query_options.h"
#include "carom/shapes/views.h"
#include "trees/refitted_tree.h"

namespace carom {

// Follows bodies from call to call. Static bodies and others are in two parts of the tree. A part
// in which no box changed stays as it is; otherwise it is refitted, or rebuilt if it has become
// worn or a new body has come. Hits do not depend on which of these happened.
class BodyIndex {
 public:
  // Brings the index up to date with bodies that have these bounds. The bounds of half-spaces and
  // of bodies that take no part are empty. `motion` nullptr: no body is static.
  void update(const Collidables& bodies, const BoundsView& bounds, const Motion* motion,
              std::span<const WorldHalfspace> halfspaces, Parallelism parallelism);

  const BoxTree& tree() const {
    return tree_.tree();
  }  // of bounds grown by the error of pair tests
  std::span<const WorldHalfspace> halfspaces() const { return halfspaces_; }

  // How often each part was refitted or rebuilt.
  struct Counts {
    size_t refits = 0, builds = 0;
  };
  const Counts& counts(size_t part) const { return counts_[part]; }

  size_t bytes() const;

 private:
  // What has happened to the boxes of a part, as bits.
  static constexpr uint32_t kMoved = 1;
  static constexpr uint32_t kJoined = 2;  // a body has come, or gone over to the other part
  using PartChanges = std::array<uint32_t, RefittedTree::kParts>;

  PartChanges update_boxes(const Collidables& bodies, const BoundsView& bounds,
                           const Motion* motion, Parallelism parallelism);

  void leave_out_empty(size_t first_part);

  RefittedTree tree_;
  std::vector<TreeBox> boxes_;
  std::vector<uint8_t> part_;  // of each body in the tree when it was built
  std::vector<WorldHalfspace> halfspaces_;
  std::array<Counts, RefittedTree::kParts> counts_;
};

// Indexes all valid bodies of the view.
BodyIndex index_bodies(const Collidables& bodies, Parallelism parallelism);

// Bodies with their index, and which of them queries meet.
struct SearchedBodies {
  const Collidables& bodies;
  const BodyIndex& index;
  QueryFilter filter = {};
};

}  // namespace carom

#include "queries/body_index.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <optional>

#include "broadphase/box_source.h"
#include "carom/bounds/bounds.h"
#include "queries/bounds_of.h"
#include "queries/grown_bounds.h"
#include "shapes/body_reader.h"

namespace carom {
namespace {

constexpr size_t kBodiesPerBlock = 4096;
constexpr uint8_t kMoving = 1, kStatic = 0, kNoPart = 2;  // parts of the tree: static bodies first

uint8_t part_of(const Motion* motion, size_t body) {
  return motion && motion[body] == Motion::fixed ? kStatic : kMoving;
}

// The part in which all bodies of a run were and are, if all are there.
std::optional<uint8_t> common_part(std::span<const uint8_t> parts, const Motion* motion,
                                   size_t first, uint64_t are_there) {
  if (std::popcount(are_there) != static_cast<int>(parts.size())) return std::nullopt;
  const uint8_t part = part_of(motion, first);
  unsigned differ = 0;
  for (const uint8_t other : parts) differ |= other ^ part;
  for (size_t i = 0; motion && i < parts.size(); ++i) differ |= part_of(motion, first + i) ^ part;
  return differ == 0 ? std::optional(part) : std::nullopt;
}

}  // namespace

void BodyIndex::update(const Collidables& bodies, const BoundsView& bounds, const Motion* motion,
                       std::span<const WorldHalfspace> halfspaces, Parallelism parallelism) {
  if (bounds.count < boxes_.size() / 2) *this = {};  // most places of the tree would be empty
  halfspaces_.assign(halfspaces.begin(), halfspaces.end());
  const PartChanges changes = update_boxes(bodies, bounds, motion, parallelism);
  for (size_t part = 0; part < RefittedTree::kParts; ++part) {
    const bool build = !tree_.is_built() || (changes[part] & kJoined) != 0;
    if (!build && changes[part] != 0) {
      tree_.refit(part, boxes_, parallelism);
      ++counts_[part].refits;
    }
    if (!build && !tree_.is_worn(part)) continue;
    leave_out_empty(part);
    // Nodes of the parts behind move, so they are built, too.
    tree_.build(part, boxes_, part_, parallelism);
    for (size_t built = part; built < RefittedTree::kParts; ++built) ++counts_[built].builds;
    return;
  }
}

// Bodies without a box get no place in the parts that are built. In the others they keep theirs.
void BodyIndex::leave_out_empty(size_t first_part) {
  for (size_t i = 0; i < boxes_.size(); ++i) {
    if (part_[i] >= first_part && is_empty(boxes_[i])) part_[i] = kNoPart;
  }
}

// Updates the boxes, and the parts of bodies that come into a part. The part of a body whose box
// becomes empty stays, as does its place in the tree.
BodyIndex::PartChanges BodyIndex::update_boxes(const Collidables& bodies, const BoundsView& bounds,
                                               const Motion* motion, Parallelism parallelism) {
  const size_t rows = std::max(boxes_.size(), bounds.count);
  boxes_.resize(rows, kNothing);
  part_.resize(rows, kNoPart);
  std::array<std::atomic<uint32_t>, RefittedTree::kParts> changes{};
  for_each_block(rows, kBodiesPerBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    PartChanges in_block{};
    for (size_t first = begin; first < end; first += kBodiesAtOnce) {
      const size_t count = std::min(kBodiesAtOnce, end - first);
      const ChangedBoxes in_run = update_grown_bounds(bodies, bounds, first, count, &boxes_[first]);
      const auto parts = std::span<const uint8_t>(part_).subspan(first, count);
      if (const auto part = common_part(parts, motion, first, in_run.are_there)) {
        if (in_run.changed != 0) in_block[*part] |= kMoved;
        continue;
      }
      for (size_t i = first; i < first + count; ++i) {
        const uint64_t bit = uint64_t{1} << (i - first);
        if ((in_run.are_there & bit) == 0) {
          if ((in_run.changed & bit) != 0) in_block[part_[i]] |= kMoved;
          continue;
        }
        const uint8_t part = part_of(motion, i);
        if (part != part_[i]) {
          if (part_[i] != kNoPart) in_block[part_[i]] |= kJoined;
          in_block[part] |= kJoined;
          part_[i] = part;
        } else if ((in_run.changed & bit) != 0) {
          in_block[part] |= kMoved;
        }
      }
    }
    for (size_t part = 0; part < RefittedTree::kParts; ++part) {
      if (in_block[part] != 0) changes[part].fetch_or(in_block[part], std::memory_order_relaxed);
    }
  });
  return {changes[0].load(std::memory_order_relaxed), changes[1].load(std::memory_order_relaxed)};
}

size_t BodyIndex::bytes() const {
  return tree_.tree().bytes() + boxes_.capacity() * sizeof(TreeBox) + part_.capacity() +
         halfspaces_.capacity() * sizeof(WorldHalfspace);
}

BodyIndex index_bodies(const Collidables& bodies, Parallelism parallelism) {
  BoundsOf bounds(bodies, parallelism);
  std::vector<WorldHalfspace> halfspaces;
  const BodyReader reader{bodies};
  const bool may_have_halfspaces = bodies.kind || bodies.uniform_kind == ShapeKind::halfspace;
  for (uint32_t i = 0; may_have_halfspaces && i < bodies.count; ++i) {
    if (reader.kind(i) != ShapeKind::halfspace || !takes_part(bounds.view(), i)) continue;
    halfspaces.push_back(world_halfspace(bodies, i));
    bounds.empty(i);
  }
  BodyIndex index;
  index.update(bodies, bounds.view(), nullptr, halfspaces, parallelism);
  return index;
}

}  // namespace carom

/// @file
/// Options of queries: which bodies they meet, and which threads they may use.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "carom/base/function_ref.h"
#include "carom/base/parallelism.h"
#include "carom/broadphase/find_pairs.h"
#include "carom/results/pair.h"
#include "carom/shapes/body.h"

namespace carom {

/// A test of the caller. It gets candidates (a: index of the query, b: index of the body), and sets
/// keep[i] to 0 where candidate i shall not be a hit; all entries are 1 before.
///
/// It is called with some candidates at a time, which have passed all other filters but need not be
/// hits, in no particular order, and from any thread that the query uses, several at a time. The
/// answer for a pair must depend on the pair alone. Then hits do not depend on how often or in
/// which order pairs are asked about. It must not change the bodies.
using QueryPredicate = FunctionRef<void(std::span<const Pair> candidates, std::span<uint8_t> keep)>;

/// Which bodies queries meet. The defaults meet all bodies, sensors included. The rules are those
/// of pairs of bodies (docs/filters.md), in this order: owner, space, group, layers and masks,
/// excluded pairs, predicate. Whether a body is fixed does not count.
struct QueryFilter {
  uint32_t mask = 0xffffffffu;  ///< meets bodies with a layer that is in this mask
  /// The layers of the queries: meets bodies whose mask has one of them; 0: does not ask for masks.
  uint32_t layer = 0;
  uint32_t owner = 0;  ///< does not meet bodies of this owner; 0: does not ask for owners
  /// How `mask` and `layer` go together. either: one of the two is enough, as in MuJoCo and ODE.
  FilterRule rule = FilterRule::both;
  /// Negative: does not meet bodies of the same group. Positive: meets those of the same group
  /// whatever their layers and masks are. 0: does not ask for groups.
  int32_t group = 0;
  std::optional<uint32_t> space = {};   ///< meets bodies of this space alone; empty: of all spaces
  std::span<const Pair> excluded = {};  ///< never met; a: query, b: body, sorted by (a, b)
  QueryPredicate predicate = {};        ///< meets bodies that this keeps; empty: keeps all
  /// The layers, masks, owners, groups and spaces of the bodies of a call on arrays; without them
  /// all bodies have all layers, a full mask, no owner and no group, and are in space 0. Nothing
  /// else of it counts. Worlds use those of their bodies, not these.
  PairFilter bodies = {};
};

/// Options of find_overlaps(), find_nearest() and World::find_points().
struct QueryOptions {
  QueryFilter filter = {};                      ///< which bodies are met
  Parallelism parallelism = Parallelism::none;  ///< which threads the call may use
};

}  // namespace carom

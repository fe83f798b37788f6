// A batch: pairs of one pair of kinds, and where their data lies.
#pragma once

#include <cstddef>
#include <cstdint>

#include "carom/results/pair.h"
#include "carom/results/result_columns.h"
#include "carom/shapes/views.h"

namespace carom {

// How the positions of both sides are stored.
enum class PositionLayout : uint8_t {
  none,       // both at the origin: boxes in world coordinates
  records32,  // x, y, z, w float32
  records64,  // x, y, z, w float64
};

// One side of the batch. Names as in Collidables, restricted to what kernels load. `orientation`
// always has data: bodies that are not turned share one identity, with stride 0.
struct BatchSide {
  const void* records = nullptr;
  size_t record_stride = 0;
  AabbColumns boxes;
  const uint32_t* box_slot = nullptr;  // nullptr: the body's own index
  OrientationView orientation;
  ShapeRows rows;
  const DopGeometry* const* dops = nullptr;
};

// What one run of a batch does. Every pass takes all pairs of the batch.
enum class Pass : uint8_t {
  direction,  // overlap 0: the pair is separate along its old direction and needs no test
  recall,     // results of pairs whose closest features are those in `features`; others are unsure
  shell,      // results of pairs whose shells prove depths within the slack; overlap 0: others
  balls,      // decisions of two hulls by balls in and about them; others are unsure
  test,       // decision and contact; separate pairs may have none if there is a distance pass
  distance,   // contact columns of separate pairs; for GJK kinds, all columns of all pairs
  clearance,  // GJK kinds only: decision, and the contact columns of separate pairs
  manifold,   // manifold points of pairs whose contacts are in `tested`
};

// The passes of a kind beside the test. For GJK kinds the overlap test is the first part of the
// distance search, so the distance pass or the clearance pass replaces the test. They have a
// direction pass as well: other tests take no longer than looking for the direction.
enum class MorePasses : uint8_t {
  none,
  manifold,
  distance,             // distance and manifold
  clearance,            // GJK kinds: direction, distance, clearance and manifold
  recall_and_clearance  // GJK kinds: recall, and those of `clearance`
};

// Kernels may read lists of pairs, and other input by row, up to the next multiple of this. (The
// test pass reads no further than `count`.)
inline constexpr size_t kMostLanes = 16;

struct OpenSearches;
struct Shell;

// Row i tests a[pairs[i].a] against b[pairs[i].b] and writes to row i of `out`. `out` has every
// column that the detail fills.
struct Batch {
  BatchSide a;
  BatchSide b;
  PositionLayout layout = PositionLayout::records32;
  const Pair* pairs = nullptr;
  bool pairs_are_rows = false;  // pairs[i] = (i, i)
  size_t count = 0;
  Detail detail = Detail::contact;
  WitnessFrame frame = WitnessFrame::world;
  Pass pass = Pass::test;
  ResultColumns out;
  // One byte a row, zero on entry: 1 where neither float32 nor lanes of doubles are sure of the
  // decision, even if the answer of doubles is given. At Pass::manifold: 1 where the kernel defers
  // the points. nullptr: the caller does not need it.
  uint8_t* unsure = nullptr;
  bool single_precision = false;  // Tier::fast
  float slack = 0;                // metres by which depths may be too great
  // The points of hulls are rounded by up to 2^-24 of the size. Kernels in float32 allow for it;
  // double precision proves no decision then.
  bool has_rounded_points = false;
  const uint32_t* direction = nullptr;  // Pass::direction only: packed_direction.h
  uint64_t* features = nullptr;         // Pass::recall reads it, distance and clearance write it
  OpenSearches* open = nullptr;         // of the second stage: hulls/core_stages-inl.h
  // Each row's, or nullptr: Pass::shell uses those that there are, the test makes new ones
  // (hulls/shell.h). nullptr: no row is to have one.
  Shell* const* shells = nullptr;
  // Whether separate rows need their contact columns, too. Tests of rounded shapes measure those
  // that they have to in any case, and then measure the others with them.
  bool measures = false;
  const float* reach = nullptr;  // contact distance by row, metres; nullptr: 0
  // Pass::manifold only.
  ResultColumns tested;                    // separation, normal and point_a, relative to A
  const uint16_t* manifold_row = nullptr;  // the row of `out` for row i
};

// The value in Batch::unsure of a deferred row whose cores surely overlap: only its depth is still
// to be found.
inline constexpr uint8_t kDeep = 2;

// Whether only decisions are wanted, and these as good as those of the standard tier.
inline bool is_plain_decision(const Batch& batch) {
  return batch.detail == Detail::overlap && !batch.single_precision;
}

// Tests pairs with a cylinder, a cone or an ellipsoid.
void run_round_pair(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b);

// Tests pairs with a box or a hull that has a rounding.
void run_rounded_pair(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b);

// run_NAME(batch) for every pair kind, on the ISA in use.
#define CAROM_PAIR(name, kind_a, kind_b, passes) void run_##name(const Batch& batch);
#include "narrowphase/pairs/pair_list.inc"
#undef CAROM_PAIR

}  // namespace carom

// One batch: pairs of one pair of kinds, and where their data lies.
#pragma once

#include <cstddef>
#include <cstdint>

#include "carom/results/contact.h"
#include "carom/results/pair.h"
#include "carom/shapes/views.h"

namespace carom {

// How the positions of both sides are stored.
enum class PositionLayout : uint8_t {
  none,       // both at the origin: boxes in world coordinates
  records32,  // x, y, z, w float32
  records64,  // x, y, z, w float64
};

// One side of the batch. Names as in Collidables, restricted to what kernels load. There is always
// an orientation: one for all with stride 0 where nothing is turned.
struct BatchSide {
  const void* records = nullptr;
  size_t record_stride = 0;
  AabbColumns boxes;
  const uint32_t* box_slot = nullptr;  // nullptr: the body's own index
  OrientationView orientation;
  ShapeRows rows;
};

// What a run of a batch does. All pairs are tested; some kinds leave work for rows that need it.
enum class Pass : uint8_t {
  direction,  // whether pairs are apart along a direction, and need no test
  recall,     // the contact columns of pairs that are nearest where they were; others are unsure
  test,      // decision, and the contact of overlapping pairs; where there is no distance pass, all
  distance,  // the contact columns of separate pairs; of kinds that measure at once, of all
  clearance,  // of those kinds: decision, and the contact columns of separate pairs
  manifold,   // points of overlapping pairs, whose results are in `tested`
};

// The passes of a kind beside the test. A direction pass pays where the test tries many axes. Kinds
// whose way to a decision is the beginning of their way to a distance measure at once: their
// distance pass, and a clearance pass, are run in place of the test.
enum class MorePasses : uint8_t {
  none,
  manifold,
  direction_and_manifold,
  distance,             // and those
  clearance,            // and those, which measures at once
  recall_and_clearance  // and those
};

// Lists of pairs, and what else is read by row, may be read up to a multiple of this. (The test
// pass reads no further than `count`.)
inline constexpr size_t kMostLanes = 16;

struct OpenSearches;

// Row i tests a[pairs[i].a] against b[pairs[i].b]; the result goes to row i of `out`, which has
// every column that the detail fills.
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
  // One a row, zero before; set where the decision was not beyond the doubt of float32, whatever
  // was made of it then; at Pass::manifold where points are left to find. nullptr: nobody asks.
  uint8_t* unsure = nullptr;
  bool single_precision = false;        // FastKnobs
  bool faces_only = false;              // FastKnobs
  const uint32_t* direction = nullptr;  // Pass::direction alone: packed_direction.h
  uint64_t* features = nullptr;         // read by Pass::recall, written by distance and clearance
  OpenSearches* open = nullptr;         // of hulls: core_stages-inl.h
  // Pass::manifold alone.
  ResultColumns tested;                    // separation, normal and point_a, relative to A
  const uint16_t* manifold_row = nullptr;  // the row of `out` that row i goes to
};

// In Batch::unsure, where other kernels set one: the cores surely overlap, and the depth is to be
// found.
inline constexpr uint8_t kDeep = 2;

// run_NAME(batch) for every pair kind, on the ISA in use.
#define CAROM_PAIR(name, kind_a, kind_b, passes) void run_##name(const Batch& batch);
#include "narrowphase/pairs/pair_list.inc"
#undef CAROM_PAIR

}  // namespace carom

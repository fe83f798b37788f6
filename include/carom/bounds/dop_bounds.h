// World-space k-DOPs of bodies: bounds tighter than boxes, to drop pairs of overlapping boxes
// before they are tested.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "carom/base/parallelism.h"
#include "carom/export.h"
#include "carom/results/pair.h"
#include "carom/shapes/dop.h"
#include "carom/shapes/views.h"

namespace carom {

// The first three slabs of a k-DOP are the world bounds (compute_bounds); the others are found
// here.
inline constexpr size_t kBoundsSlabs = 3;
constexpr size_t extra_slab_count(DopKind kind) { return slab_count(kind) - kBoundsSlabs; }

// How many floats a body has: its extra slabs in fours, first four lower ends, then four upper
// ones. Pairs come in any order: a record is one cache line or two where columns would be many.
constexpr size_t dop_record_size(DopKind kind) { return (extra_slab_count(kind) + 3) / 4 * 8; }

// Where the record of a body has the lower end of an extra slab; the upper one is 4 floats on.
constexpr size_t place_in_record(size_t extra_slab) { return extra_slab / 4 * 8 + extra_slab % 4; }

// One record a body, one after the other.
struct DopRecords {
  DopKind kind = DopKind::k14;
  float* data = nullptr;
};

// Writes the record of every body, or of those whose byte in `which` (one a body) is not zero. The
// slabs hold the shape, and bodies that a test calls touching have slabs that overlap. Of boxes and
// capsules, which are computed in float32, an end is at most 2^-15 of the shape's size and 2^-20 of
// the position's coordinates further out than it has to be, of others a few floats. Half-spaces get
// -inf to +inf. A body with NaN, infinity, a negative size, or a quaternion or normal of zero gets
// empty slabs (+inf to -inf). Kinds that are none of sphere, aabb, capsule, box and triangle get
// the slabs of their box along the world axes.
CAROM_EXPORT void compute_dops(const Collidables& bodies, const DopRecords& out,
                               Parallelism parallelism = Parallelism::none,
                               std::span<const uint8_t> which = {});

// Writes 1 for every pair of bodies of which all extra slabs overlap, touching ones included, and 0
// where one slab parts them. Returns how many pairs overlap.
CAROM_EXPORT size_t drop_separate_dops(const DopRecords& records, std::span<const Pair> pairs,
                                       uint8_t* overlap,
                                       Parallelism parallelism = Parallelism::none);

}  // namespace carom

/// @file
/// World-space k-DOPs of bodies: bounds tighter than boxes, which rule out pairs with overlapping
/// boxes before the narrow phase tests them.
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

/// The first three slabs of a k-DOP are the world bounds, which compute_bounds() finds; the other
/// ("extra") slabs are found here.
inline constexpr size_t kBoundsSlabs = 3;

/// How many slabs of a k-DOP are not world bounds.
constexpr size_t extra_slab_count(DopKind kind) { return slab_count(kind) - kBoundsSlabs; }

/// Floats in the record of one body: its extra slabs in fours, first four lower ends, then four
/// upper ends. Pairs come in any order, and a record is one or two cache lines where columns would
/// be many.
constexpr size_t dop_record_size(DopKind kind) { return (extra_slab_count(kind) + 3) / 4 * 8; }

/// Index in a record of the lower end of an extra slab; its upper end is 4 floats further on.
constexpr size_t place_in_record(size_t extra_slab) { return extra_slab / 4 * 8 + extra_slab % 4; }

/// The records of all bodies, one after the other in the order of the bodies.
struct DopRecords {
  DopKind kind = DopKind::k14;  ///< the k-DOP of every record
  float* data = nullptr;        ///< dop_record_size(kind) floats a body
};

/// Writes the record of every body, or, if `which` is not empty, of every body whose byte in
/// `which` (one a body) is not zero. The slabs contain the shape, and the slabs of two bodies that
/// a test calls touching overlap. Boxes and capsules are computed in float32: an end lies at most
/// 2^-15 of the shape's size plus 2^-20 of the position's coordinates too far out. The ends of
/// other kinds lie at most a few floats too far out. Half-spaces get -inf to +inf. A body with NaN,
/// infinity, a negative size, or a quaternion or normal of zero gets empty slabs (+inf to -inf).
/// Kinds other than sphere, aabb, capsule, box and triangle get the slabs of their world-axis box.
CAROM_EXPORT void compute_dops(const Collidables& bodies, const DopRecords& out,
                               Parallelism parallelism = Parallelism::none,
                               std::span<const uint8_t> which = {});

/// Compares the extra slabs of every pair of bodies. Writes to `overlap` (one entry a pair) 1 where
/// all of them overlap or touch, and 0 where one slab separates the bodies. Returns how many pairs
/// overlap.
CAROM_EXPORT size_t drop_separate_dops(const DopRecords& records, std::span<const Pair> pairs,
                                       uint8_t* overlap,
                                       Parallelism parallelism = Parallelism::none);

}  // namespace carom

// The directions of the extra slabs in columns, and bounds on how far the results are rounded.
#pragma once

#include <cmath>

#include "bounds/dop_core.h"
#include "carom/bounds/dop_bounds.h"

namespace carom {

// More than half a unit in the last place of a float, as a share of it. Near zero the least float
// is added.
inline constexpr double kFloatRounding = 0x1.0002p-24;
inline constexpr double kLeastFloat = 0x1p-149;

// Projections of positions are clamped here: sums stay finite, and no float reaches that far.
inline constexpr double kBeyondFloats = 0x1p1000;

// Rounding in float32 for boxes and capsules, as shares of the 1-norms of their coordinates and
// positions. A rotation, projections and their sums round to at most 45 units of 2^-24 of the
// shape's norm, and to 4 of the position's.
inline constexpr float kLaneSizeRounding = 0x1p-18f;
inline constexpr float kLanePositionRounding = 0x1p-21f;

// The norms for which that holds: nothing overflows, and what underflows is negligible.
inline constexpr float kLeastPlain = 0x1p-100f;
inline constexpr float kGreatestPlain = 0x1p100f;

inline constexpr size_t kMostRecordSize = dop_record_size(DopKind::k26);

// The extra slabs of a kind, padded with zeros to a multiple of four.
struct SlabColumns {
  size_t count;
  alignas(32) double x[12] = {};
  alignas(32) double y[12] = {};
  alignas(32) double z[12] = {};
  alignas(32) double length[12] = {};

  explicit SlabColumns(DopKind kind) : count(dop_record_size(kind) / 2) {
    const auto directions = slab_directions(kind);
    for (size_t s = kBoundsSlabs; s < directions.size(); ++s) {
      const auto& d = directions[s];
      const size_t to = s - kBoundsSlabs;
      x[to] = d[0];
      y[to] = d[1];
      z[to] = d[2];
      length[to] = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    }
  }
};

// A generous bound on the rounding in double precision, here and in tests of touching pairs. It is
// negligible beside the rounding to float32.
inline double slack_of(const DopCore& core, const Double3& position) {
  return 0x1p-30 * core.size +
         ((0x1p-50 * std::fabs(position[0]) + 0x1p-50 * std::fabs(position[1])) +
          0x1p-50 * std::fabs(position[2]));
}

}  // namespace carom

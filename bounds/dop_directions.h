// What the loops over extra slabs need: directions in columns, and how far results are rounded.
#pragma once

#include <cmath>

#include "bounds/dop_core.h"
#include "carom/bounds/dop_bounds.h"

namespace carom {

// More than half a unit in the last place of a float, as a share of it; of those near zero the
// least one.
inline constexpr double kFloatRounding = 0x1.0002p-24;
inline constexpr double kLeastFloat = 0x1p-149;

// Projections of positions are cut off here: sums stay finite, and no float reaches that far.
inline constexpr double kBeyondFloats = 0x1p1000;

// In float32, of boxes and capsules: shares of the 1-norms of their coordinates and positions. A
// rotation, projections and their sums round to at most 45 units of 2^-24 of a shape's, and to 4 of
// a position's.
inline constexpr float kLaneSizeRounding = 0x1p-18f;
inline constexpr float kLanePositionRounding = 0x1p-21f;

// Norms for which that is so: nothing overflows, and what vanishes does not count.
inline constexpr float kLeastPlain = 0x1p-100f;
inline constexpr float kGreatestPlain = 0x1p100f;

inline constexpr size_t kMostRecordSize = dop_record_size(DopKind::k26);

// Extra slabs of a kind, zero behind the last one up to a multiple of four.
struct DopDirections {
  size_t count;
  alignas(32) double x[12] = {};
  alignas(32) double y[12] = {};
  alignas(32) double z[12] = {};
  alignas(32) double length[12] = {};

  explicit DopDirections(DopKind kind) : count(dop_record_size(kind) / 2) {
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

// What double precision rounds, here and in tests of pairs that touch, with room to spare; for
// float32 results next to nothing.
inline double slack_of(const DopCore& core, const Double3& position) {
  return 0x1p-30 * core.size +
         ((0x1p-50 * std::fabs(position[0]) + 0x1p-50 * std::fabs(position[1])) +
          0x1p-50 * std::fabs(position[2]));
}

}  // namespace carom

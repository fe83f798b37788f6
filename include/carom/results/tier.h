/// @file
/// The accuracy tiers: how fast, how accurate and how certain results are.
#pragma once

#include <cstdint>

namespace carom {

/// How certain decisions are. "Exact" refers to a shape as it is stored: its numbers are the floats
/// that they are, R(q) = M(q) / |q|^2 in rationals, and a thick triangle reaches `thickness` along
/// its exact unit normal.
enum class Tier : uint8_t {
  /// Float32 alone: of spheres, capsules, boxes and aabbs nothing is recomputed in float64, so that
  /// decisions within 2^-17 of their size may be wrong. Other kinds are as in the standard tier.
  fast,
  standard,   ///< float32, and float64 where that is unsure; equal bits on every instruction set
  certified,  ///< the standard results; overlaps of 1 and 0 are proven, all others are kUndecided
  /// As certified, but exact arithmetic decides the rest: always right. Not for cylinders, cones
  /// and ellipsoids (is_decided_exactly()): calls for pairs fail, World::add() throws.
  exact
};

/// Whether this tier proves its decisions.
constexpr bool has_proofs(Tier tier) { return tier >= Tier::certified; }

/// The overlap of a pair that the certified tier could not prove.
inline constexpr uint8_t kUndecided = 2;

/// How certain decisions are, and how wrong results may be.
struct Accuracy {
  Tier tier = Tier::standard;  ///< how certain decisions are

  /// How wrong results may be, in metres, finite, >= 0 (otherwise World throws
  /// std::invalid_argument, and calls for pairs fail); 0: the standard tier, to the bit. In calls
  /// for pairs depths may be off by it: that of two hulls may be too great, that of two
  /// meshes too small; all else is as without it. The rest is about worlds. Results of a
  /// pair are then those of two shapes whose distances from the true ones (Hausdorff)
  /// are no more than this together. So a separation is off by the tolerance at most (beside the
  /// rounding of the standard tier), no overlap that is deeper is missed, and none is reported
  /// across a wider gap. Depths of surfaces that cross depend on their triangles: where models
  /// stand for meshes (carom/shapes/ladder.h), they are those of the models. BodyDesc::tolerance
  /// replaces it for a body. A world uses the models that shapes have, and builds none:
  /// build_ladder() does (carom/ladders/build_ladder.h). docs/accuracy.md says how, and what it
  /// saves. Not for Tier::certified and Tier::exact, which prove decisions about shapes where they
  /// are.
  float tolerance = 0;
};

}  // namespace carom

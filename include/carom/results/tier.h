/// @file
/// The accuracy tiers: how fast, how accurate and how certain results are.
#pragma once

#include <cstdint>

namespace carom {

/// How certain decisions are. "Exact" refers to a shape as it is stored: its numbers are the floats
/// that they are, R(q) = M(q) / |q|^2 in rationals, and a thick triangle reaches `thickness` along
/// its exact unit normal.
enum class Tier : uint8_t {
  fast,       ///< the standard tier, loosened by FastKnobs
  standard,   ///< float32, and float64 where that is unsure; equal bits on every instruction set
  certified,  ///< the standard results; overlaps of 1 and 0 are proven, all others are kUndecided
  exact       ///< as certified, but exact arithmetic decides the rest: always right
};

/// Whether this tier proves its decisions.
constexpr bool has_proofs(Tier tier) { return tier >= Tier::certified; }

/// The overlap of a pair that the certified tier could not prove.
inline constexpr uint8_t kUndecided = 2;

/// What Tier::fast gives up. Every knob is off until it is set; docs/accuracy.md has the gain and
/// the error of each.
struct FastKnobs {
  /// Nothing is recomputed in float64: decisions within 2^-17 of the shapes' size may be wrong.
  /// Does not change triangles, half-spaces and kinds without a float32 kernel.
  bool single_precision = false;

  /// Boxes are tested against boxes with the six face normals only. Pairs separated along an edge
  /// axis count as overlapping, never the other way round; their witness points may not face each
  /// other.
  bool faces_only = false;

  /// Worlds: replaces every body but half-spaces by the ball about its position that contains its
  /// shape. Reports overlaps that are none, and misses none except by rounding.
  bool proxy_spheres = false;
};

/// A tier with its knobs.
struct Accuracy {
  Tier tier = Tier::standard;  ///< how certain decisions are
  FastKnobs knobs = {};        ///< read at Tier::fast only

  /// Worlds: how wrong results may be, in metres, finite, >= 0; 0: the standard tier, to the bit.
  /// Results of a pair are then those of two shapes whose distances from the true ones (Hausdorff)
  /// are no more than this together. So a separation is off by the tolerance at most (beside the
  /// rounding of the standard tier), no overlap that is deeper is missed, and none is reported
  /// across a wider gap. Depths of surfaces that cross depend on their triangles: where models
  /// stand for meshes (carom/shapes/ladder.h), they are those of the models. BodyDesc::tolerance
  /// replaces it for a body. docs/accuracy.md says how, and what it saves. Not for Tier::certified
  /// and Tier::exact, which prove decisions about shapes where they are.
  float tolerance = 0;
};

}  // namespace carom

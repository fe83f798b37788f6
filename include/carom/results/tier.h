// What a user trades: how fast, how accurate, how certain.
#pragma once

#include <cstdint>

namespace carom {

// fast       what FastKnobs loosens, and nothing else
// standard   float32 with float64 where that cannot decide; the same bits on every instruction set
// certified  the standard results, and of every decision a proof: overlap 1 and 0 are right for the
//            shapes exactly as they are stored, everything that is not proven is 2, undecided
// exact      what is undecided is computed in exact arithmetic: always right, never 2
//
// A shape as it is stored: numbers are the floats that they are, R(q) = M(q) / |q|^2 in rationals,
// a thick triangle reaches `thickness` along its exact unit normal.
enum class Tier : uint8_t { fast, standard, certified, exact };

constexpr bool has_proofs(Tier tier) { return tier >= Tier::certified; }

// Overlap of a pair that the certified tier could not prove.
inline constexpr uint8_t kUndecided = 2;

// Tier::fast. Every knob is off until it is set; docs/accuracy.md has the gain and the error of
// each.
struct FastKnobs {
  // Nothing is computed again in float64: decisions within 2^-17 of the shapes' size may be wrong.
  // Triangles, half-spaces and kinds that have no kernel in float32 are computed as ever.
  bool single_precision = false;

  // Boxes against boxes by the six normals of their faces alone: boxes that only edges part count
  // as overlapping, never the other way round. Witness points of such pairs may not face each
  // other.
  bool faces_only = false;

  // Worlds: every body but half-spaces is the ball about its position that holds its shape. Finds
  // overlaps that are none, misses none but by rounding.
  bool proxy_spheres = false;

  // Worlds: a body's results stay as they are until a point of it may have moved by more than this,
  // in metres, since it was tested. Separations are off by up to twice as much.
  float motion_tolerance = 0;
};

struct Accuracy {
  Tier tier = Tier::standard;
  FastKnobs knobs = {};  // Tier::fast alone
};

}  // namespace carom

// The widest gaps between solids and cylinders, found in lanes: the features of one pair at a time,
// but the edges that need a search of many pairs together.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "narrowphase/hulls/solid_cylinder_scalar.h"

namespace carom {

// Edges of a vector of pairs that wait for a search, in columns: of each pair the one with the
// greatest bound, and the others whose bounds exceed what is known. What lies behind the last is
// searched, too, and not looked at.
struct WaitingArcs {
  static constexpr size_t kPairs = 16;
  static constexpr size_t kMost = 256;
  static constexpr size_t kPadding = 16;    // a vector is stored as a whole
  static constexpr size_t kArcColumns = 7;  // those of scalar::EdgeArc that an edge has of its own

  // Bits of floats.
  using Column = std::array<uint32_t, kMost + kPadding>;

  std::array<std::array<float, kPairs>, kArcColumns> first;
  std::array<uint32_t, kPairs> first_edge;
  uint32_t has_first = 0;  // bits of pairs

  std::array<Column, kArcColumns> rest;
  Column bound, edge, pair;
  size_t rest_count = 0;

  // Of the cylinders of pairs.
  std::array<float, kPairs> half_length, rim;
};

struct SolidWaySteps {
  // Sets ways[pair] to the best way of faces, caps and corners, and leaves edges to `waiting`. May
  // search those of other pairs first. `pair` is less than the lanes of a vector.
  void (*begin)(const Solid& solid, const scalar::PlacedCylinder& cylinder, uint8_t pair,
                scalar::SolidWay* ways, WaitingArcs& waiting);
  // Searches all that wait. Then ways[pair] is what scalar::find_solid_way() finds.
  void (*finish)(scalar::SolidWay* ways, WaitingArcs& waiting);
  // As scalar::contact_along().
  scalar::SolidContact (*contact)(const Solid& solid, const scalar::PlacedCylinder& cylinder,
                                  const scalar::SolidWay& way, bool is_blunt);
};

// On the ISA in use.
const SolidWaySteps& solid_way_steps_in_lanes();

}  // namespace carom

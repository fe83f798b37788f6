// The widest gaps between solids and cylinders, found in lanes: the features of one pair at a time,
// but the edges that need a search of many pairs together.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "narrowphase/hulls/solid_cylinder_scalar.h"

namespace carom {

// Edges of several pairs that wait for a search, in columns, as bits of floats.
struct WaitingArcs {
  static constexpr size_t kMost = 512;
  static constexpr size_t kPadding = 16;  // a vector is stored as a whole
  static constexpr size_t kColumns = 17;

  std::array<std::array<uint32_t, kMost + kPadding>, kColumns> column{};
  std::array<uint32_t, kMost + kPadding> edge{};
  std::array<uint8_t, kMost> pair{};
  size_t count = 0;
};

struct SolidWaySteps {
  // Sets ways[pair] to the best way of faces, caps and corners, and leaves edges to `waiting`. May
  // search those that wait already.
  void (*begin)(const Solid& solid, const scalar::PlacedCylinder& cylinder, uint8_t pair,
                scalar::SolidWay* ways, WaitingArcs& waiting);
  // Searches all that wait. Then ways[pair] is what scalar::find_solid_way() finds.
  void (*finish)(scalar::SolidWay* ways, WaitingArcs& waiting);
};

// On the ISA in use.
const SolidWaySteps& solid_way_steps_in_lanes();

}  // namespace carom

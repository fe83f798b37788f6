// The widest gaps between solids and cylinders, found in lanes: the features of one pair at a time,
// but the edges that need a search of many pairs together.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "narrowphase/hulls/solid_cylinder_scalar.h"

namespace carom {

// Edges of a vector of pairs that wait for a search, in columns. What lies behind the last is
// searched, too, and not looked at.
struct WaitingArcs {
  static constexpr size_t kMost = 128;
  static constexpr size_t kPadding = 16;  // a vector is stored as a whole
  static constexpr size_t kPairs = 16;

  // Of edges: the normals of both faces and the way from the edge to the middle of the cylinder, as
  // bits of floats; then which edge of which pair.
  std::array<std::array<uint32_t, kMost + kPadding>, 9> arc;
  std::array<uint32_t, kMost + kPadding> edge;
  std::array<uint8_t, kMost + kPadding> pair;
  size_t count = 0;
  // Of pairs: axis, middle, half length and rim of the cylinder.
  std::array<std::array<float, kPairs>, 8> cylinder;
};

struct SolidWaySteps {
  // Sets ways[pair] to the best way of faces, caps and corners, and leaves edges to `waiting`. May
  // search those that wait already. `pair` is less than the lanes of a vector.
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

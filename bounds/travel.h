// How far the points of bodies have travelled, as whole numbers of a small unit (ticks).
#pragma once

#include <cstddef>
#include <cstdint>

#include "carom/shapes/views.h"

namespace carom {

// Numbers of ticks are compared by their difference, as they may pass the greatest integer. This
// many stand for a body that is somewhere else altogether.
inline constexpr uint32_t kJump = 1u << 28;

// The bodies of a world, one entry each. Every body has an anchor: a pose that it had. Positions
// are records x, y, z, w; those of anchors, too, and of the same type.
struct TravelColumns {
  PositionType type;
  const void* position;
  const float* orientation;  // quaternions x, y, z, w; nullptr: no body turns
  // Of a ball about the position that holds the shape; 0: it does not turn; infinite: a plane.
  const float* turn_radius;
  void* anchor_position;
  float* anchor_orientation;  // nullptr with `orientation`
  uint32_t* anchored;         // ticks that the body had travelled when it was at its anchor
  uint32_t* travelled;        // in all: those until the anchor, and how far it is from there
};

struct TravelUnit {
  float ticks_per_metre;
  uint32_t leash;  // ticks from the anchor at which the present pose becomes the anchor
};

// Brings the columns of bodies [begin, end) up to date with their poses. The distance from the
// anchor is an upper bound for every point of the shape: that of the positions, and the chord of a
// point at the bounding radius. It is kJump if it is larger or a number is not finite. The same
// numbers on every instruction set.
void add_travel(const TravelColumns& bodies, const TravelUnit& unit, size_t begin, size_t end);

}  // namespace carom

// How far the points of bodies have travelled, as whole numbers of a small unit (ticks).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace carom {

// Numbers of ticks are compared by their difference, as they may pass the greatest integer. This
// many stand for a body that is somewhere else altogether: more than any limit allows.
inline constexpr uint32_t kJump = 1u << 28;

// The bodies of a world, one entry each. T is the type of its positions. Every body has an anchor:
// a pose that it had, which lies in columns.
template <class T>
struct TravelColumns {
  const T* position;         // records x, y, z, w
  const float* orientation;  // quaternions x, y, z, w; nullptr: no body turns
  const float* turn_radius;  // metres a radian, see turning_radius()
  std::array<T*, 3> anchor_position;
  std::array<float*, 4> anchor_orientation;  // not read without `orientation`
  uint32_t* anchored;          // ticks that the body had travelled when it was at its anchor
  uint32_t* travelled;         // in all: those until the anchor, and how far it is from there
  uint32_t* travelled_before;  // `travelled` before this call, which writes it
};

struct TravelUnit {
  float ticks_per_metre;
  uint32_t leash;  // ticks from the anchor at which the present pose becomes the anchor
};

// Brings the columns of bodies [begin, end) up to date with their poses. The distance from the
// anchor is an upper bound: that of the positions, and the chord of a point at the turning radius,
// which lies across the axis of the turn.
// It is kJump if it is larger or a number is not finite. Returns a number that has all bits of
// what the odometers have gained in this call, so that it is no less than any. The same numbers on
// every instruction set.
uint32_t add_travel(const TravelColumns<float>& bodies, const TravelUnit& unit, size_t begin,
                    size_t end);
uint32_t add_travel(const TravelColumns<double>& bodies, const TravelUnit& unit, size_t begin,
                    size_t end);

}  // namespace carom

/// @file
/// Which contact, and which points, of the last step a contact continues.
#pragma once

#include <array>
#include <cstdint>

#include "carom/results/contact.h"

namespace carom {

/// A `previous` of nothing: the contact or point is new.
inline constexpr uint32_t kNoPrevious = 0xffffffffu;

/// The place of a point in columns with four entries a contact, such as the impulses of a solver.
constexpr uint32_t point_place(uint32_t contact, uint32_t point) { return 4 * contact + point; }

/// The identity of one contact of a world and of its points, 56 bytes. Points are those of the
/// manifold, in their order; at Detail::contact one, the witness point.
///
/// A point of the last step is the same point if it has the same name. Points that are left then
/// continue the nearest one that is left, if it is no further away than a quarter of the contact's
/// shorter arm. Every point of the last step is continued at most once. A pair whose bodies were
/// removed or replaced, or that had no contact in the last step, continues nothing.
struct ContactIdentity {
  PointNames names;  ///< features of the points; unused entries are 0
  /// point_place() of each point in the contacts of the last step; kNoPrevious: new or unused.
  std::array<uint32_t, 4> previous_point;
  /// Index of the contact of the last step that most of the points continue; kNoPrevious: new.
  uint32_t previous;
  uint32_t reserved;  ///< zero
};
static_assert(sizeof(ContactIdentity) == 56);

}  // namespace carom

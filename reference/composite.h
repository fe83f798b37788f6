// Tests bodies that are made of parts by testing every pair of parts.
#pragma once

#include "carom/reference/reference.h"

namespace carom::reference {

// Whether a pair has a contact: it overlaps, or is separate by no more than `distance`.
inline bool has_contact(bool overlap, float separation, float distance) {
  return overlap || (distance > 0 && separation <= distance);
}

// The contract is that of find_contacts(). A or B is a mesh or a compound, and both are valid.
PairContacts collide_parts(const Shape& shape_a, const Pose& pose_a, const Shape& shape_b,
                           const Pose& pose_b, PositionType positions, float contact_distance,
                           const RegionLimits& limits);

}  // namespace carom::reference

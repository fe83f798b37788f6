// Tests bodies that are made of parts by testing every pair of parts.
#pragma once

#include "carom/reference/reference.h"

namespace carom::reference {

// The contract is that of collide(). A or B is a mesh or a compound, and both are valid.
PairResult collide_parts(const Shape& shape_a, const Pose& pose_a, const Shape& shape_b,
                         const Pose& pose_b, PositionType positions);

}  // namespace carom::reference

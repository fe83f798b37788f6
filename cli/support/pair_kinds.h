// Names the pairs of shape kinds that have a kernel.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "carom/shapes/shape.h"

namespace carom::cli {

using BodiesOfKind = std::array<uint64_t, kShapeKindCount>;

// "sphere-sphere", "sphere-box", ...: the pairs that this many bodies of each kind can form, in the
// order of the codes.
std::vector<std::string> pair_kinds(const BodiesOfKind& bodies);

}  // namespace carom::cli

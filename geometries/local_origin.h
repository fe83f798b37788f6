// Where tests of the triangles of a mesh or a height field count their corners from.
#pragma once

#include <array>
#include <optional>

#include "geometries/part.h"

namespace carom {

// Corners are counted from where the mesh has them. Nothing is added then: it would turn -0 into 0.
inline constexpr std::array<float, 3> kMeshOrigin = {};

// Whether corners may round: the normal of a sliver depends on their last bits, and thick and
// one-sided triangles, and those with inner edges that close, depend on the normal. `one_sided`: in
// place of the rules.
inline bool may_count_near(const MeshRules& rules, std::optional<bool> one_sided) {
  return rules.thickness == 0 && !one_sided.value_or(rules.one_sided);
}

// A place near another part, in the frame of a mesh. Corners that are counted from it have few
// digits even where the mesh reaches far, so that float32 decides what would need float64 if they
// were counted from the mesh's own origin. Coordinates are whole numbers of a power of two that is
// two to four times the size of the part: then most corners are exact, and the others are off by
// 2^-25 of the distance from there. kMeshOrigin where that is as near, and for half-spaces,
// which have no place.
//
// `turn` and `position` are those of the mesh; `other` lies at `other_position`.
std::array<float, 3> origin_near(const Turn& turn, const Double3& position, const Part& other,
                                 const Double3& other_position);

}  // namespace carom

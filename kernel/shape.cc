#include "carom/kernel/shape.h"

#include <array>

namespace carom {

const char* name(ShapeKind kind) {
  static constexpr std::array<const char*, kShapeKindCount> kNames = {
      "sphere", "capsule", "aabb", "box", "dop", "hull", "mesh", "compound", "halfspace"};
  const auto code = static_cast<size_t>(kind);
  return code < kNames.size() ? kNames[code] : "unknown";
}

}  // namespace carom

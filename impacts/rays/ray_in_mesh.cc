#include "impacts/rays/ray_in_mesh.h"

#include <algorithm>

namespace carom {

RayTarget::RayTarget(const MeshGeometry& of_mesh, bool is_one_sided)
    : mesh(&of_mesh), one_sided(is_one_sided) {
  for (size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<int>(axis);
    lower[axis] = mesh->lower()[i];
    upper[axis] = mesh->upper()[i];
  }
  greatest = std::max(carom::greatest(lower), carom::greatest(upper));
}

}  // namespace carom

#include "impacts/rays/ray_in_mesh.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "base/outward.h"
#include "impacts/slack.h"
#include "trees/box_path.h"

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

bool RayInMesh::set(const RayTarget& target, const Double3& from, const Double3& displacement,
                    double limit) {
  mesh = target.mesh;
  one_sided = target.one_sided;
  start = from;
  way = displacement;
  first = 0;
  last = limit;
  travel = greatest(way);
  lengths = greatest(start) + travel + target.greatest;
  const double slack = kPathSlack * lengths + FLT_TRUE_MIN;
  Double3 inverse_way;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double to_lower = (target.lower[axis] - slack) - start[axis];
    const double to_upper = (target.upper[axis] + slack) - start[axis];
    if (way[axis] == 0) {
      if (to_lower > 0 || to_upper < 0) last = -1;
      continue;
    }
    inverse_way[axis] = 1 / way[axis];
    const double at_lower = to_lower * inverse_way[axis], at_upper = to_upper * inverse_way[axis];
    first = std::max(first, std::min(at_lower, at_upper));
    last = std::min(last, std::max(at_lower, at_upper));
  }
  if (is_empty()) return true;
  Double3 at_first, on_path;
  for (size_t axis = 0; axis < 3; ++axis) {
    at_first[axis] = start[axis] + way[axis] * first;
    on_path[axis] = way[axis] * (last - first);
  }
  const double length = greatest(at_first) + greatest(on_path);
  if (!(length + slack < kLongestPath && travel < kLongestPath)) return false;
  const double margin = slack + kFloatSlack * length;
  for (size_t axis = 0; axis < 3; ++axis) {
    const bool moves = std::fabs(way[axis]) >= BoxPath::kLeastDisplacement;
    const double along = moves ? 0 : on_path[axis];
    lower[axis] = next_down(static_cast<float>(at_first[axis] + std::min(along, 0.0) - margin));
    upper[axis] = next_up(static_cast<float>(at_first[axis] + std::max(along, 0.0) + margin));
    inverse[axis] = moves ? static_cast<float>(inverse_way[axis]) : INFINITY;
  }
  return true;
}

}  // namespace carom

#include "impacts/ray_in_mesh.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "base/outward.h"
#include "impacts/slack.h"

namespace carom {
namespace {

// The reciprocal of a smaller displacement would be near the end of the range of float32, or
// beyond.
constexpr double kLeastDisplacement = 0x1p-120;

}  // namespace

bool RayInMesh::set(const Double3& from, const Double3& displacement, double limit) {
  start = from;
  way = displacement;
  first = 0;
  last = limit;
  travel = greatest(way);
  lengths = greatest(start) + travel;
  double of_mesh = 0;
  for (int axis = 0; axis < 3; ++axis) {
    of_mesh = std::max(
        {of_mesh, std::fabs(double{mesh->lower()[axis]}), std::fabs(double{mesh->upper()[axis]})});
  }
  lengths += of_mesh;
  const double slack = kPathSlack * lengths + FLT_TRUE_MIN;
  Double3 inverse_way;
  for (size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<int>(axis);
    const double to_lower = (double{mesh->lower()[i]} - slack) - start[axis];
    const double to_upper = (double{mesh->upper()[i]} + slack) - start[axis];
    if (way[axis] == 0) {
      if (to_lower > 0 || to_upper < 0) last = -1;
      continue;
    }
    inverse_way[axis] = 1 / way[axis];
    const bool forwards = way[axis] > 0;
    first = std::max(first, (forwards ? to_lower : to_upper) * inverse_way[axis]);
    last = std::min(last, (forwards ? to_upper : to_lower) * inverse_way[axis]);
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
    const bool moves = std::fabs(way[axis]) >= kLeastDisplacement;
    const double along = moves ? 0 : on_path[axis];
    lower[axis] = round_downwards(at_first[axis] + std::min(along, 0.0) - margin);
    upper[axis] = -round_downwards(-(at_first[axis] + std::max(along, 0.0) + margin));
    inverse[axis] = moves ? static_cast<float>(inverse_way[axis]) : INFINITY;
  }
  return true;
}

}  // namespace carom

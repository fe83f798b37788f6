#include "impacts/mesh_path.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "impacts/slack.h"

namespace carom {
namespace {

Double3 along(const Double3& start, const Double3& way, double t) {
  return {start[0] + way[0] * t, start[1] + way[1] * t, start[2] + way[2] * t};
}

// The half size of a box of a part, seen from the frame of another.
Double3 half_in_frame(const Turn& frame, const Turn& turn, const Double3& half) {
  Double3 seen{};
  for (size_t i = 0; i < 3; ++i) {
    const Double3 axis = turned_back(frame, {turn[0][i], turn[1][i], turn[2][i]});
    for (size_t k = 0; k < 3; ++k) seen[k] += std::fabs(axis[k]) * half[i];
  }
  return seen;
}

Double3 start_of(const PlacedPart& mesh, const PlacedPart& shape) {
  const Double3 middle = turned(shape.turn, box_of(*shape.part).middle);
  return turned_back(mesh.turn, minus(plus(shape.position, middle), mesh.position));
}

}  // namespace

bool MeshPath::serves(const PlacedPart& mesh, const BodySweep& mesh_sweep, const PlacedPart& shape,
                      const BodySweep& shape_sweep) {
  return mesh.kind() == ShapeKind::mesh && !shape.has_parts() &&
         shape.kind() != ShapeKind::halfspace && !mesh_sweep.is_turning() &&
         !shape_sweep.is_turning() && !mesh.is_scaled();
}

MeshPath::MeshPath(const PlacedPart& mesh, const BodySweep& mesh_sweep, const PlacedPart& shape,
                   const BodySweep& shape_sweep, double limit)
    : mesh_(mesh.mesh()),
      start_(start_of(mesh, shape)),
      way_(turned_back(mesh.turn, minus(shape_sweep.displacement, mesh_sweep.displacement))),
      first_(0),
      last_(limit) {
  const Double3 half = half_in_frame(mesh.turn, shape.turn, box_of(*shape.part).half);
  const Double3 lower = {mesh_.lower().x(), mesh_.lower().y(), mesh_.lower().z()};
  const Double3 upper = {mesh_.upper().x(), mesh_.upper().y(), mesh_.upper().z()};
  lengths_ = (greatest(start_) + greatest(way_)) +
             (greatest(half) + std::max(greatest(lower), greatest(upper)));
  const double slack = kPathSlack * lengths_ + FLT_TRUE_MIN;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double to_lower = (lower[axis] - half[axis] - slack) - start_[axis];
    const double to_upper = (upper[axis] + half[axis] + slack) - start_[axis];
    if (way_[axis] == 0) {
      if (to_lower > 0 || to_upper < 0) return;
      continue;
    }
    const auto [entry, exit] = std::minmax({to_lower / way_[axis], to_upper / way_[axis]});
    first_ = std::max(first_, entry);
    last_ = std::min(last_, exit);
  }
  if (!(first_ <= last_)) return;
  const Double3 from = along(start_, way_, first_);
  const Double3 way = along({}, way_, last_ - first_);
  const double on_path = greatest(from) + greatest(half) + greatest(way);
  is_in_range_ = on_path + slack < kLongestPath;
  if (!is_in_range_) return;
  const double margin = slack + kFloatSlack * on_path;
  const Double3 grown = {half[0] + margin, half[1] + margin, half[2] + margin};
  box_.emplace().set(
      rounded_outwards(from, grown),
      {static_cast<float>(way[0]), static_cast<float>(way[1]), static_cast<float>(way[2])});
}

// A time on the cut path, rounded upwards.
float MeshPath::limit_on_path(double limit) const {
  const double length = last_ - first_;
  if (!(length > 0) || limit >= last_) return limit >= first_ ? 1 : -1;
  return static_cast<float>((limit - first_) / length * (1 + kFloatSlack) + kFloatSlack);
}

MetSearch MeshPath::search(double limit, TreeWalk& walk, uint32_t* triangles) const {
  return {.tree = &mesh_.tree(),
          .box = &*box_,
          .limit = limit_on_path(limit),
          .walk = &walk,
          .items = triangles};
}

}  // namespace carom

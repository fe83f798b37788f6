#include "queries/query_boxes.h"

#include <algorithm>
#include <cmath>

#include "base/outward.h"
#include "bounds/extent.h"
#include "queries/grown_bounds.h"
#include "queries/grown_box.h"
#include "shapes/body_reader.h"
#include "shapes/run_of_bodies.h"

namespace carom {
namespace {

using Float3 = std::array<float, 3>;

bool is_finite(const Float3& v) {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

double length(double x, double y, double z) { return std::sqrt((x * x + y * y) + z * z); }

bool turns(ShapeKind kind) {
  return kind != ShapeKind::sphere && kind != ShapeKind::aabb && kind != ShapeKind::halfspace;
}

// The box of a body that rotates in place. No point is further from the position than the furthest
// corner of the bounds, and no point moves by more than an arc.
TreeBox turned_box(const BodyReader& reader, size_t i, double angle, double& arc) {
  const Extent extent = extent_of(reader, i);
  Float3 furthest;
  for (size_t axis = 0; axis < 3; ++axis) {
    furthest[axis] = std::max(std::abs(extent.lower[axis]), std::abs(extent.upper[axis]));
  }
  const double reach = length(furthest[0], furthest[1], furthest[2]);
  arc = angle * reach;
  const Position<double> p = reader.position<double>(i);
  const std::array<double, 3> position = {p.x, p.y, p.z};
  TreeBox box;
  for (size_t axis = 0; axis < 3; ++axis) {
    box.lower[axis] = sum_downwards(position[axis], std::max(-reach, extent.lower[axis] - arc));
    box.upper[axis] = sum_upwards(position[axis], std::min(reach, extent.upper[axis] + arc));
  }
  return box;
}

// The sweeps from the first one on; the first of them gets index 0.
SweepView sweeps_from(const SweepView& sweep, size_t first) {
  SweepView run = sweep;
  run.displacement = further(sweep.displacement, first * sweep.displacement_stride);
  run.rotation = further(sweep.rotation, first * sweep.rotation_stride);
  return run;
}

}  // namespace

void QueryBoxes::find(size_t first, size_t count, Parallelism parallelism) {
  first_ = first;
  const Collidables run = run_of_bodies(queries_, first, count);
  const SweepView sweep = sweeps_from(sweep_, first);
  bounds_.find(run, parallelism);
  at_start_.resize(count);
  for (size_t begin = 0; begin < count; begin += kBodiesAtOnce) {
    update_grown_bounds(run, bounds_.view(), begin, std::min(kBodiesAtOnce, count - begin),
                        &at_start_[begin], &sweep);
  }
}

bool QueryBoxes::set_box(size_t query, MovingBox& box) const {
  const TreeBox& at_start = at_start_[query - first_];
  if (is_empty(at_start)) return false;
  const auto displacement =
      load_strided<Float3>(sweep_.displacement, sweep_.displacement_stride, query);
  if (!is_finite(displacement)) return false;
  const BodyReader reader{queries_};
  if (!sweep_.rotation || !turns(reader.kind(query))) {
    box.set(at_start, displacement);
    return true;
  }

  const auto rotation = load_strided<Float3>(sweep_.rotation, sweep_.rotation_stride, query);
  if (!is_finite(rotation)) return false;
  const double angle = length(rotation[0], rotation[1], rotation[2]);
  if (!(angle > 0)) {
    box.set(at_start, displacement);
    return true;
  }
  double arc = 0;
  const TreeBox turned = turned_box(reader, query, angle, arc);
  // No less than the length.
  const double travel = std::abs(double{displacement[0]}) + std::abs(double{displacement[1]}) +
                        std::abs(double{displacement[2]}) + arc;
  box.set(grown(turned, reader.position<double>(query), travel), displacement);
  return true;
}

}  // namespace carom

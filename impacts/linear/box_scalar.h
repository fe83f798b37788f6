// The time at which a ball or a capsule that moves in a straight line meets a box, in the frame of
// the box.
//
// The squared distance of a point from a box is the sum over the axes of the squared distance from
// each slab. The times at which the point enters and leaves the slabs cut its path into at most
// seven pieces. On each piece the sum is the squared distance from one moving point, whose crossing
// is known (crossing_scalar.h).
#pragma once

#include <array>

#include "impacts/linear/crossing_scalar.h"

namespace carom::scalar {

// One axis: the times between which the point is inside the slab. `before` and `after` are its
// distance from the lower or upper end at t = 0, for the path before it enters and after it leaves.
struct SlabPassage {
  double enters, leaves;
  double before, after;

  SlabPassage(double from, double way, double half) {
    const bool stands = way == 0, is_inside = std::fabs(from) <= half;
    const double inverse = stands ? 0 : 1 / way;
    const double first = (-half - from) * inverse, second = (half - from) * inverse;
    enters = stands ? (is_inside ? -kNever : kNever) : min(first, second);
    leaves = stands ? kNever : max(first, second);
    const double below = from + half, above = from - half;
    before = stands ? (from < 0 ? below : above) : (way < 0 ? above : below);
    after = way < 0 ? below : above;
  }

  bool is_inside(double t) const { return t >= enters && t < leaves; }
  double beyond(double t) const { return t < enters ? before : t < leaves ? 0.0 : after; }
  double next(double t) const { return t < enters ? enters : t < leaves ? leaves : kNever; }
};

// The time at which a point comes within reach of a box about zero.
inline double meets_box(const MovingPoint& point, const Vector3d& half, double reach) {
  const SlabPassage x(point.from.x(), point.way.x(), half.x());
  const SlabPassage y(point.from.y(), point.way.y(), half.y());
  const SlabPassage z(point.from.z(), point.way.z(), half.z());
  double t = 0;
  while (t <= 1) {
    const Vector3d way(x.is_inside(t) ? 0.0 : point.way.x(), y.is_inside(t) ? 0.0 : point.way.y(),
                       z.is_inside(t) ? 0.0 : point.way.z());
    const Crossing crossing({{x.beyond(t), y.beyond(t), z.beyond(t)}, way}, reach);
    const double next = min(min(x.next(t), y.next(t)), z.next(t));
    const double first = max(crossing.entry, t);
    if (crossing.meets && first <= crossing.exit && first <= next) {
      return first <= 1 ? first : kNever;
    }
    t = next;
  }
  return kNever;
}

// Whether the segment from `from` along `edge` has a point in the box.
inline bool passes_through_box(const Vector3d& from, const Vector3d& edge, const Vector3d& half) {
  const SlabPassage x(from.x(), edge.x(), half.x()), y(from.y(), edge.y(), half.y()),
      z(from.z(), edge.z(), half.z());
  const double enters = max(max(x.enters, y.enters), max(z.enters, 0.0));
  const double leaves = min(min(x.leaves, y.leaves), min(z.leaves, 1.0));
  return enters <= leaves;
}

// The four edges of the box along one axis, swept by `depth`, are parallelograms. Their sides are 2
// * half[axis] along the axis, and `depth`.
inline double meets_swept_edges(const MovingPoint& point, const Vector3d& half,
                                const Vector3d& depth, int axis, double reach, double slack) {
  Vector3d side = Vector3d::Zero();
  side[axis] = 2 * half[axis];
  const Face face(side, depth);
  double first = kNever;
  for (int corner = 0; corner < 4; ++corner) {
    Vector3d start = -half;
    if (corner & 1) start[(axis + 1) % 3] = half[(axis + 1) % 3];
    if (corner & 2) start[(axis + 2) % 3] = half[(axis + 2) % 3];
    const double t =
        meets_face(point.seen_from(start), face, FaceKind::parallelogram, reach, slack);
    first = min(first, t);
  }
  return first;
}

// The eight corners of the box, swept by `depth`.
inline double meets_swept_corners(const MovingPoint& point, const Vector3d& half,
                                  const Vector3d& depth, double reach) {
  double first = kNever;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d start(corner & 1 ? half.x() : -half.x(), corner & 2 ? half.y() : -half.y(),
                         corner & 4 ? half.z() : -half.z());
    first = min(first, meets_edge(point.seen_from(start), depth, reach));
  }
  return first;
}

// The time at which a segment from the point along `edge` comes within reach of a box about zero.
inline double meets_box(const MovingPoint& point, const Vector3d& edge, const Vector3d& half,
                        double reach, double slack) {
  const Vector3d depth = -edge;
  double width = 0;
  bool is_slanted = false;
  for (int axis = 0; axis < 3; ++axis) {
    Vector3d side = Vector3d::Zero();
    side[axis] = 2 * half[axis];
    const Face face(side, depth);
    width = max(width, face.width());
    is_slanted = is_slanted || face.is_slanted;
  }
  if (is_slanted) return kNoClosedForm;
  const double edge_reach = reach + width;
  double first =
      min(meets_box(point, half, edge_reach), meets_box(point.seen_from(depth), half, edge_reach));
  for (int axis = 0; axis < 3; ++axis) {
    first = min(first, meets_swept_edges(point, half, depth, axis, reach, slack));
  }
  first = min(first, meets_swept_corners(point, half, depth, edge_reach));
  return passes_through_box(point.from, edge, half) ? 0.0 : first;
}

}  // namespace carom::scalar

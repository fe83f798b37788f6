// The gap between the line of an edge and a cylinder, along the directions between the normals of
// the edge's two faces, scalar form.
//
// Along these the edge is the furthest feature of its solid, so that the gap is that of the shapes.
// It is concave in any multiple of the direction, and its slope at the middle bounds it on the
// whole arc (R. T. Rockafellar, Convex Analysis, 1970, section 23). On the side of either cap it is
// smooth: Newton's method finds a greatest gap from the best of some directions.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "narrowphase/features/round_tolerances.h"
#include "narrowphase/scalar/vector.h"

namespace carom::scalar {

// A direction of an arc: a unit vector along the normal of the left face, u, and across it, v.
struct ArcPlace {
  float u, v;
};

struct EdgeArc {
  float u_way, v_way;           // from the edge's line to the middle of the cylinder
  float along, u_axis, v_axis;  // the cylinder's axis, along the edge and across
  float half_length, rim;
  ArcPlace end;  // the normal of the right face; v >= 0

  float along_axis(const ArcPlace& n) const { return n.u * u_axis + n.v * v_axis; }
  float aside(const ArcPlace& n) const { return n.u * v_axis - n.v * u_axis; }
  float off_axis(const ArcPlace& n) const {
    const float y = aside(n);
    return std::sqrt(along * along + y * y);
  }
  float gap(const ArcPlace& n) const {
    return (n.u * u_way + n.v * v_way) -
           (half_length * std::fabs(along_axis(n)) + rim * off_axis(n));
  }
  bool holds(const ArcPlace& n) const { return n.v > 0 && n.u * end.v - n.v * end.u > 0; }
};

inline ArcPlace unit(const ArcPlace& n) {
  const float over = 1 / std::sqrt(max(n.u * n.u + n.v * n.v, kLeastWay));
  return {n.u * over, n.v * over};
}

// The vector is nearly a unit vector already; the result is off by a square of what that is.
inline ArcPlace nearer_to_unit(const ArcPlace& n) {
  const float by = 1.5f - 0.5f * (n.u * n.u + n.v * n.v);
  return {n.u * by, n.v * by};
}

// The gap at the middle of an arc, and the most that it may be on the whole arc.
struct ArcBound {
  float at_middle, most;

  ArcBound(const EdgeArc& arc, const ArcPlace& middle) {
    const float x = arc.along_axis(middle);
    const float bend = arc.rim / max(arc.off_axis(middle), kLeastRim);
    const float reach = std::copysign(arc.half_length, x);
    const float u = (arc.u_way - reach * arc.u_axis) - (middle.u - x * arc.u_axis) * bend;
    const float v = (arc.v_way - reach * arc.v_axis) - (middle.v - x * arc.v_axis) * bend;
    at_middle = u * middle.u + v * middle.v;
    const float at_end = u * arc.end.u + v * arc.end.v;
    const float behind_end = v * arc.end.u - u * arc.end.v;
    most = v > 0 && behind_end < 0 ? std::sqrt(u * u + v * v) : max(u, at_end);
  }
};

// A search that has not ended counts a little less, so that it does not win by rounding.
struct ArcFound {
  float gap = -kLargest;
  ArcPlace n{1, 0};
  bool has_ended = false;

  void keep_if_wider(const ArcFound& next) {
    if (next.rank() > rank()) *this = next;
  }
  float rank() const { return gap - (has_ended ? 0.0f : kNotEnded); }
};

// The best of some directions on the side of either cap.
struct ArcStarts {
  ArcFound front, back;  // n . axis >= 0, and <= 0

  // Near the axis the gap has a narrow peak, so that the nearest direction to it is one of them.
  // The ends, which faces have as well, count where there is no other.
  ArcStarts(const EdgeArc& arc, std::span<const ArcPlace> places) {
    for (const ArcPlace& n : places) try_place(arc, n, true, true);
    const float sign = std::copysign(1.0f, arc.v_axis);
    const ArcPlace nearest = unit(ArcPlace{arc.u_axis * sign, arc.v_axis * sign});
    if (arc.holds(nearest)) try_place(arc, nearest, true, true);
    const bool has_no_front = front.gap == -kLargest, has_no_back = back.gap == -kLargest;
    try_place(arc, {1, 0}, has_no_front, has_no_back);
    try_place(arc, arc.end, has_no_front, has_no_back);
  }

 private:
  void try_place(const EdgeArc& arc, const ArcPlace& n, bool may_front, bool may_back) {
    const float x = arc.along_axis(n), wide = arc.gap(n);
    if (may_front && x >= 0 && wide > front.gap) front = {wide, n};
    if (may_back && x <= 0 && wide > back.gap) back = {wide, n};
  }
};

// A step of Newton's method for the gap on the side of one cap. Returns whether it was short. The
// length of the result is off by a square of the step's: the next step takes most of it away.
inline bool step_on_arc(const EdgeArc& arc, float sign, ArcPlace& n) {
  const float reach = sign * arc.half_length;
  const float u_way = arc.u_way - reach * arc.u_axis, v_way = arc.v_way - reach * arc.v_axis;
  const float x = arc.along_axis(n), y = arc.aside(n);
  const float off = max(arc.off_axis(n), kLeastRim);
  const float over = 1 / off;
  const float bend = arc.rim * over, tilt = (x * y) * over;
  const float slope = (n.u * v_way - n.v * u_way) + arc.rim * tilt;
  const float curve = bend * ((y * y - x * x) + tilt * tilt) - (n.u * u_way + n.v * v_way);
  const float step = curve < 0 ? -slope / curve : std::copysign(kShortArc, slope);
  const float most = min(kLongTurn, kRimStep * off);
  const float turn = clamp(step, -most, most);
  ArcPlace next = nearer_to_unit({n.u - n.v * turn, n.v + n.u * turn});
  if (next.v < 0) next = {1, 0};
  if (next.u * arc.end.v - next.v * arc.end.u < 0) next = arc.end;
  const float moved = n.u * next.v - n.v * next.u;
  n = next;
  return std::fabs(moved) <= kLastArc;
}

// The best on the side of one cap, from a start. What ends at an end is left to the faces.
inline ArcFound climb_arc(const EdgeArc& arc, float sign, ArcFound best) {
  for (size_t i = 0; i < kSolidArcSteps; ++i) best.has_ended = step_on_arc(arc, sign, best.n);
  best.n = nearer_to_unit(best.n);
  best.gap = best.gap > -kLargest && arc.holds(best.n) ? arc.gap(best.n) : -kLargest;
  return best;
}

}  // namespace carom::scalar

// Segment against box, scalar form. The box is centred at the origin, along the coordinate axes.
#pragma once

#include "narrowphase/features/axis_search_scalar.h"
#include "narrowphase/scalar/scaled.h"

namespace carom::scalar {

// start + s direction for s from 0 to `length`. The direction is scaled so that its greatest
// component is about one, however short the segment is.
template <class Real>
struct DirectedSegment {
  Vector3<Real> start;
  Vector3<Real> direction;
  Real length;

  DirectedSegment(const Vector3<Real>& from, const Vector3<Real>& d) : start(from) {
    const auto scale = scale_of(largest_component(d));
    direction = d * scale.down;
    length = scale.up;
  }

  Vector3<Real> at(Real s) const { return start + direction * s; }
};

// The part of a segment in which the slope of the distance to the box changes its sign.
template <class Real>
struct Bracket {
  Real low, high;
  Real slope_low, slope_high;

  void narrow(Real s, Real slope) {
    if (!(s > low && s < high)) return;
    if (slope <= 0) {
      low = s;
      slope_low = slope;
    } else {
      high = s;
      slope_high = slope;
    }
  }
};

// Slopes are those of half the squared distance. The bracket is one point, an end of the segment,
// if the distance only grows or only shrinks from end to end.
template <class Real>
Bracket<Real> bracket_of_ends(const DirectedSegment<Real>& segment, const Vector3<Real>& half) {
  const Vector3<Real> end = segment.at(segment.length);
  Bracket<Real> ends{0, segment.length, dot(beyond(segment.start, half), segment.direction),
                     dot(beyond(end, half), segment.direction)};
  if (ends.slope_low >= 0) return {0, 0, 0, 0};
  if (ends.slope_high <= 0) return {segment.length, segment.length, 0, 0};
  return ends;
}

// Narrows the bracket to one between planes of the box's faces: there the slope is linear.
template <class Real>
Bracket<Real> narrow_to_faces(Bracket<Real> bracket, const DirectedSegment<Real>& segment,
                              const Vector3<Real>& half) {
  for (int i = 0; i < 3; ++i) {
    const Real d = segment.direction[i];
    const Real inverse = d != 0 ? 1 / d : 0;
    for (const Real face : {-half[i], half[i]}) {
      const Real s = (face - segment.start[i]) * inverse;
      Vector3<Real> way = beyond(segment.at(s), half);
      way[i] = 0;
      bracket.narrow(s, dot(way, segment.direction));
    }
  }
  return bracket;
}

// The point of a segment that is nearest to the box.
template <class Real>
struct NearestToBox {
  Vector3<Real> point;
  Vector3<Real> way;  // from the nearest point of the box
};

// The distance to a convex set is convex along the segment, so its slope tells on which side of
// every face plane the nearest point is (S. Boyd, L. Vandenberghe, Convex Optimization, 2004, 3.1.3
// and 3.2.5). The last step makes the vector perpendicular to the segment, as far as the box
// allows.
template <class Real>
NearestToBox<Real> nearest_to_box(const DirectedSegment<Real>& segment, const Vector3<Real>& half) {
  const Bracket<Real> bracket = narrow_to_faces(bracket_of_ends(segment, half), segment, half);
  const Real width = bracket.high - bracket.low;
  const Real share =
      bracket.slope_low < 0 ? bracket.slope_low / (bracket.slope_low - bracket.slope_high) : 0;
  const Real s = bracket.low + width * share;
  const Vector3<Real> point = segment.at(s);
  Vector3<Real> way = beyond(point, half);

  // Only axes in which the segment is beyond the box all along the bracket contribute to the
  // vector.
  const Vector3<Real> in_bracket =
      beyond(segment.at((bracket.low + bracket.high) * Real(0.5)), half);
  Vector3<Real> free = segment.direction;
  for (int i = 0; i < 3; ++i) {
    if (in_bracket[i] == 0) way[i] = free[i] = 0;
  }
  const Real squared = dot(free, free);
  const Real newton = squared > 0 ? -dot(way, free) / squared : 0;
  const Real step = clamp<Real>(newton, bracket.low - s, bracket.high - s);
  return {point + segment.direction * step, way + free * step};
}

// The contact location or nearest points of a box and another shape.
template <class Real>
struct BoxContact {
  Real separation;       // of the cores
  Vector3<Real> normal;  // from the box to the other shape
  Vector3<Real> on_box, on_other;
  bool is_unsure;
};

// Moves an overlapping segment out of the box first; the nearest points are then the contact
// location.
template <class Real>
BoxContact<Real> segment_box(const Vector3<Real>& start, const Vector3<Real>& d,
                             const Vector3<Real>& half) {
  DirectedSegment<Real> segment(start, d);
  const Vector3<Real> end = segment.at(segment.length);
  AxisSearch<Real> search(half, min(start, end), max(start, end));
  search.try_crosses(segment.direction, start, start);
  const BoxAxis<Real> axis = search.best();

  const Vector3<Real> inwards = axis.normal * min(axis.gap, Real(0));
  segment.start = start - inwards;
  const NearestToBox<Real> nearest = nearest_to_box(segment, half);
  const Vector3<Real> on_box = nearest.point - beyond(nearest.point, half);

  const Real distance = std::sqrt(dot(nearest.way, nearest.way));
  const Vector3<Real> n = nearest.way * (distance > 0 ? 1 / distance : 0);
  const Real certain = min(dot(n, start), dot(n, end)) - reach(half, n);
  const CoreNormal<Real> core = core_normal(axis, nearest.way, certain);
  return {core.distance, core.normal, on_box, nearest.point + inwards, core.is_unsure};
}

}  // namespace carom::scalar

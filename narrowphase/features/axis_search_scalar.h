// Separating axes of a box and another convex shape, scalar. The box lies about the origin along
// the coordinate axes.
//
// Source: S. Gottschalk, M. C. Lin, D. Manocha, OBBTree: A Hierarchical Structure for Rapid
// Interference Detection, SIGGRAPH 1996, for the axes; every shape is projected in full, so that an
// axis that rounding has turned still gives a bound.
#pragma once

#include "base/tolerances.h"
#include "narrowphase/scalar/vector.h"

namespace carom::scalar {

// The way from the nearest point of the box to x: zero in axes in which x is not beyond the box.
template <class Real>
Vector3<Real> beyond(const Vector3<Real>& x, const Vector3<Real>& half) {
  Vector3<Real> way;
  for (int i = 0; i < 3; ++i) way[i] = x[i] - min(max(x[i], -half[i]), half[i]);
  return way;
}

// Extent of the box along n, from its centre.
template <class Real>
Real reach(const Vector3<Real>& half, const Vector3<Real>& n) {
  return (half.x() * std::fabs(n.x()) + half.y() * std::fabs(n.y())) + half.z() * std::fabs(n.z());
}

// Extent of the other shape along an axis.
template <class Real>
struct Interval {
  Real low;
  Real high;
};

// An axis of the box and the other shape.
template <class Real>
struct BoxAxis {
  Real gap;              // between the projections; negative: they overlap by that much
  Vector3<Real> normal;  // unit, from the box to the other shape
};

// Keeps the axis of the greatest gap; of equal ones the first. Axes need not be unit vectors: gaps
// are compared as squares with their sign, over squared lengths, so that the search takes no roots.
template <class Real>
class AxisSearch {
 public:
  // By the faces of the box.
  AxisSearch(const Vector3<Real>& half, const Vector3<Real>& low, const Vector3<Real>& high)
      : half_(half) {
    for (int i = 0; i < 3; ++i) {
      const Real above = low[i] - half[i];
      const Real below = -half[i] - high[i];
      const Real gap = max(above, below);
      if (i > 0 && !(gap > best_.gap)) continue;
      best_ = {Vector3<Real>::Zero(), 1, gap};
      best_.axis[i] = above >= below ? 1 : -1;
    }
  }

  void try_axis(const Vector3<Real>& n, const Interval<Real>& other) {
    const Real radius = reach(half_, n);
    const Real above = other.low - radius;
    const Real below = -radius - other.high;
    const Candidate next{above >= below ? n : Vector3<Real>(-n), dot(n, n), max(above, below)};
    const bool is_axis = next.squared > Real(kParallelSquared);
    if (is_axis && key(next) * best_.squared > key(best_) * next.squared) best_ = next;
  }

  // Across an edge of the box and an edge of the other shape with components of about one, which
  // projects to a point; `u` and `v` are the corners between which the other shape lies.
  void try_crosses(const Vector3<Real>& edge, const Vector3<Real>& u, const Vector3<Real>& v) {
    const Vector3<Real> along_u = cross(edge, u);
    const Vector3<Real> along_v = cross(edge, v);
    const Vector3<Real> axes[3] = {
        {0, -edge.z(), edge.y()}, {edge.z(), 0, -edge.x()}, {-edge.y(), edge.x(), 0}};
    for (int i = 0; i < 3; ++i) {
      try_axis(axes[i], {min(along_u[i], along_v[i]), max(along_u[i], along_v[i])});
    }
  }

  BoxAxis<Real> best() const {
    const Real to_unit = 1 / std::sqrt(best_.squared);
    return {best_.gap * to_unit, best_.axis * to_unit};
  }

 private:
  struct Candidate {
    Vector3<Real> axis;
    Real squared;
    Real gap;
  };

  static Real key(const Candidate& c) { return c.gap * std::fabs(c.gap); }

  Vector3<Real> half_;
  Candidate best_;
};

// The normal of two shapes that are apart, from an axis and a pair of nearest points.
template <class Real>
struct CoreNormal {
  Real distance;
  Vector3<Real> normal;
  bool is_unsure;
};

// `way` leads from the nearest point of the box to that of the other shape; its direction parts the
// two by `certain`. The axis is the better normal where both agree (faces, crossing edges), and the
// only one where the cores overlap.
template <class Real>
CoreNormal<Real> core_normal(const BoxAxis<Real>& axis, const Vector3<Real>& way, Real certain) {
  constexpr bool kIsFloat = std::is_same_v<Real, float>;
  constexpr Real kSame = kIsFloat ? Real(kSameWay) : Real(kSameWayDouble);
  constexpr Real kLoss = kIsFloat ? Real(kCertain) : Real(kCertainDouble);
  const Real distance = std::sqrt(dot(way, way));
  if (axis.gap <= 0) return {axis.gap, axis.normal, false};
  const bool agree = largest_component<Real>(way - axis.normal * axis.gap) <= kSame;
  const bool is_certain = certain >= distance - kLoss;
  if (agree || !is_certain) return {max(distance, axis.gap), axis.normal, !agree};
  return {max(distance, axis.gap), way * (1 / distance), false};
}

}  // namespace carom::scalar

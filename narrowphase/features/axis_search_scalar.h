// Separating axes of a box and another convex shape, scalar form. The box is centred at the origin,
// along the coordinate axes.
//
// Source of the axes: S. Gottschalk, M. C. Lin, D. Manocha, OBBTree: A Hierarchical Structure for
// Rapid Interference Detection, SIGGRAPH 1996. Every shape is projected in full, so that an axis
// that rounding has turned still gives a bound.
#pragma once

#include "base/tolerances.h"
#include "narrowphase/scalar/vector.h"

namespace carom::scalar {

// The vector from the nearest point of the box to x; zero in axes in which x is not beyond the box.
template <class Real>
Vector3<Real> beyond(const Vector3<Real>& x, const Vector3<Real>& half) {
  Vector3<Real> way;
  for (int i = 0; i < 3; ++i) way[i] = x[i] - min(max(x[i], -half[i]), half[i]);
  return way;
}

// How far the box reaches along n from its centre.
template <class Real>
Real reach(const Vector3<Real>& half, const Vector3<Real>& n) {
  return (half.x() * std::fabs(n.x()) + half.y() * std::fabs(n.y())) + half.z() * std::fabs(n.z());
}

// The projection of the other shape on an axis.
template <class Real>
struct Interval {
  Real low;
  Real high;
};

// An axis between the box and the other shape.
template <class Real>
struct BoxAxis {
  Real gap;              // between the projections; negative: they overlap by that much
  Vector3<Real> normal;  // unit, from the box to the other shape
};

// Keeps the axis with the greatest gap; ties go to the first axis. Axes need not be unit vectors:
// the search compares signed squares of gaps over squared lengths, so it takes no roots.
template <class Real>
class AxisSearch {
 public:
  // Starts with the face normals of the box. The other shape reaches from `low` to `high`.
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

  // Tries the cross products of `edge`, an edge of the other shape with components of about one,
  // and the edges of the box. The edge projects to a point on these axes; `u` and `v` are the
  // corners between whose projections the other shape lies.
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

// The normal of two separate shapes, from an axis and a pair of nearest points.
template <class Real>
struct CoreNormal {
  Real distance;
  Vector3<Real> normal;
  bool is_unsure;
};

// `way` is the vector from the nearest point of the box to that of the other shape; `certain` is
// the gap along its direction. If the two normals agree (faces, crossing edges), the axis is the
// better one; if the cores overlap, it is the only one.
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

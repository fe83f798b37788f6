// Two oriented boxes by the separating axis theorem.
//
// Source: S. Gottschalk, M. Lin, D. Manocha, OBBTree, SIGGRAPH 1996; C. Ericson, Real-Time
// Collision Detection, 2005, section 4.4.1. Unlike there, this test projects both boxes in full on
// the cross products of edges. These axes are exact in the frame of A, so the gap along them bounds
// the separation however the rotation was rounded and however nearly parallel the edges are.
#pragma once

#include "base/tolerances.h"
#include "narrowphase/scalar/vector.h"

namespace carom::scalar {

// Two boxes in the frame of A, with the origin at the centre of A.
template <class Real>
struct BoxPair {
  Vector3<Real> centre;  // of B
  Rotation<Real> turn;   // of B
  Vector3<Real> half_a, half_b;
};

template <class Real>
struct SeparatingAxis {
  Real gap;              // the greatest; the separation of overlapping boxes
  Vector3<Real> normal;  // unit, from A to B
  int edge_a = -1;       // the normal is the cross product of these axes of A and B;
  int edge_b = -1;       // -1: that of a face
};

template <class Real>
const Vector3<Real>& column(const Rotation<Real>& r, int j) {
  return j == 0 ? r.x : j == 1 ? r.y : r.z;
}

// Unit vector of axis i, cross v.
template <class Real>
Vector3<Real> axis_cross(int i, const Vector3<Real>& v) {
  if (i == 0) return {0, -v.z(), v.y()};
  if (i == 1) return {v.z(), 0, -v.x()};
  return {-v.y(), v.x(), 0};
}

template <class Real>
Real signed_square(Real x) {
  return x * std::fabs(x);
}

// The best face normal: first those of A, then those of B; ties go to the first.
template <class Real>
SeparatingAxis<Real> best_face(const BoxPair<Real>& p) {
  SeparatingAxis<Real> best{-std::numeric_limits<Real>::infinity(), {}};
  int axis = 0;
  for (int i = 0; i < 3; ++i) {
    const Vector3<Real> row(std::fabs(p.turn.x[i]), std::fabs(p.turn.y[i]), std::fabs(p.turn.z[i]));
    const Real gap = std::fabs(p.centre[i]) - (p.half_a[i] + dot(row, p.half_b));
    if (gap > best.gap) best.gap = gap, axis = i;
  }
  for (int j = 0; j < 3; ++j) {
    const Vector3<Real>& direction = column(p.turn, j);
    const Vector3<Real> size(std::fabs(direction.x()), std::fabs(direction.y()),
                             std::fabs(direction.z()));
    const Real gap = std::fabs(dot(direction, p.centre)) - (p.half_b[j] + dot(size, p.half_a));
    if (gap > best.gap) best.gap = gap, axis = 3 + j;
  }
  best.normal = axis < 3 ? Vector3<Real>(Vector3<Real>::Unit(axis)) : column(p.turn, axis - 3);
  return best;
}

template <class Real>
struct EdgeAxis {
  Real signed_square = -1;  // of the gap along the cross product
  Real squared = 0;         // of the cross product; 0: no two edges have a common normal
  int a = -1, b = -1;

  bool is_less_than(Real other_square, Real other_squared) const {
    return other_square * squared > signed_square * other_squared;
  }
};

// The gap along (axis i of A) x (axis j of B), times the length of that vector.
template <class Real>
Real edge_gap(const BoxPair<Real>& p, int i, int j) {
  const int k = (i + 1) % 3, l = (i + 2) % 3;
  const Vector3<Real>& v = column(p.turn, j);
  // Component i of (axis j) x (axis m): the projection of axis m.
  const auto projection = [&](int m) {
    const Vector3<Real>& w = column(p.turn, m);
    return std::fabs(v[k] * w[l] - v[l] * w[k]);
  };
  const int m = j == 0 ? 1 : 0, n = j == 2 ? 1 : 2;
  const Real distance = std::fabs(p.centre[l] * v[k] - p.centre[k] * v[l]);
  const Real reach_a = p.half_a[k] * std::fabs(v[l]) + p.half_a[l] * std::fabs(v[k]);
  const Real reach_b = p.half_b[m] * projection(m) + p.half_b[n] * projection(n);
  return distance - (reach_a + reach_b);
}

template <class Real>
EdgeAxis<Real> best_edges(const BoxPair<Real>& p) {
  EdgeAxis<Real> best;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const int k = (i + 1) % 3, l = (i + 2) % 3;
      const Vector3<Real>& v = column(p.turn, j);
      const Real squared = v[k] * v[k] + v[l] * v[l];
      const Real square = signed_square(edge_gap(p, i, j));
      if (squared >= kLeastCross<Real> &&
          (best.squared == 0 || best.is_less_than(square, squared))) {
        best = {square, squared, i, j};
      }
    }
  }
  return best;
}

template <class Real>
SeparatingAxis<Real> edge_axis(const BoxPair<Real>& p, const EdgeAxis<Real>& edges) {
  const Real magnitude = std::sqrt(std::fabs(edges.signed_square) / edges.squared);
  const Vector3<Real> n = axis_cross(edges.a, column(p.turn, edges.b));
  return {edges.signed_square > 0 ? magnitude : -magnitude, n * (1 / std::sqrt(edges.squared)),
          edges.a, edges.b};
}

template <class Real>
SeparatingAxis<Real> best_axis(const BoxPair<Real>& p) {
  SeparatingAxis<Real> best = best_face(p);
  const EdgeAxis<Real> edges = best_edges(p);
  if (edges.squared > 0) {
    const SeparatingAxis<Real> crossed = edge_axis(p, edges);
    if (crossed.gap > best.gap) best = crossed;
  }
  if (dot(best.normal, p.centre) < 0) best.normal = -best.normal;
  return best;
}

}  // namespace carom::scalar

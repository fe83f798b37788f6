// The distance of two separate boxes.
//
// Two separate boxes attain their distance at a corner of one of them, or at two crossing edges. So
// the distance is the least of the distances of 16 corners from the other box and of the two edges
// on the best edge axis. (Weak duality: no separating axis has a greater gap than the distance.)
#pragma once

#include "narrowphase/features/boxes_contact_scalar.h"

namespace carom::scalar {

template <class Real>
struct BoxDistance {
  Real distance;
  Vector3<Real> normal;
  BoxWitness<Real> witness;
};

// The corner of a box, with its centre at `centre` and half axes h, that is nearest to a box about
// the origin.
template <class Real>
struct NearestCorner {
  Real squared = std::numeric_limits<Real>::infinity();
  Vector3<Real> corner;

  NearestCorner(const Vector3<Real>& half, const Vector3<Real>& centre,
                const std::array<Vector3<Real>, 3>& h) {
    for (int signs = 0; signs < 8; ++signs) {
      const Vector3<Real> x =
          signs & 1 ? Vector3<Real>(centre + h[0]) : Vector3<Real>(centre - h[0]);
      const Vector3<Real> y = signs & 2 ? Vector3<Real>(x + h[1]) : Vector3<Real>(x - h[1]);
      const Vector3<Real> z = signs & 4 ? Vector3<Real>(y + h[2]) : Vector3<Real>(y - h[2]);
      Vector3<Real> outside;
      for (int i = 0; i < 3; ++i) outside[i] = max(std::fabs(z[i]) - half[i], Real(0));
      const Real s = dot(outside, outside);
      if (s < squared) squared = s, corner = z;
    }
  }
};

template <class Real>
NearestCorner<Real> nearest_corner_of_b(const BoxPair<Real>& p) {
  return {p.half_a,
          p.centre,
          {p.turn.x * p.half_b.x(), p.turn.y * p.half_b.y(), p.turn.z * p.half_b.z()}};
}

// In the frame of B.
template <class Real>
NearestCorner<Real> nearest_corner_of_a(const BoxPair<Real>& p) {
  const Vector3<Real> row_x(p.turn.x.x(), p.turn.y.x(), p.turn.z.x());
  const Vector3<Real> row_y(p.turn.x.y(), p.turn.y.y(), p.turn.z.y());
  const Vector3<Real> row_z(p.turn.x.z(), p.turn.y.z(), p.turn.z.z());
  return {p.half_b,
          -rotate_back(p.turn, p.centre),
          {row_x * p.half_a.x(), row_y * p.half_a.y(), row_z * p.half_a.z()}};
}

// A point of A near the nearest one, to start the projections from.
template <class Real>
Vector3<Real> start_on_a(const BoxPair<Real>& p) {
  const NearestCorner<Real> of_b = nearest_corner_of_b(p);
  const NearestCorner<Real> of_a = nearest_corner_of_a(p);
  Real least = of_b.squared;
  Vector3<Real> x = clamp_to_box(of_b.corner, p.half_a);
  if (of_a.squared < least) {
    least = of_a.squared;
    x = from_b(p, of_a.corner);
  }
  const EdgeAxis<Real> edges = best_edges(p);
  if (edges.squared > 0) {
    SeparatingAxis<Real> axis = edge_axis(p, edges);
    if (dot(axis.normal, p.centre) < 0) axis.normal = -axis.normal;
    const BoxWitness<Real> w = facing_edges(p, axis);
    const Vector3<Real> way = w.on_b - w.on_a;
    if (dot(way, way) < least) x = w.on_a;
  }
  return x;
}

// Coordinates strictly inside the box: 0 corner, 1 edge, 2 face, 3 interior.
template <class Real>
int free_axes(const Vector3<Real>& x, const Vector3<Real>& half) {
  int count = 0;
  for (int i = 0; i < 3; ++i) count += std::fabs(x[i]) < half[i];
  return count;
}

// The gap along a unit vector from A to B.
template <class Real>
Real gap_along(const BoxPair<Real>& p, const Vector3<Real>& n) {
  const Vector3<Real> in_b = rotate_back(p.turn, n);
  const Real reach_a = dot(Vector3<Real>(n.cwiseAbs()), p.half_a);
  const Real reach_b = dot(Vector3<Real>(in_b.cwiseAbs()), p.half_b);
  return dot(n, p.centre) - (reach_a + reach_b);
}

template <class Real>
BoxDistance<Real> distance_of(const BoxPair<Real>& p, const SeparatingAxis<Real>& axis) {
  Vector3<Real> x = start_on_a(p);
  // Two steps of alternating projection, because rounding may have chosen any of several corners
  // that are equally near.
  Vector3<Real> q, y;
  for (int round = 0; round < 2; ++round) {
    q = to_b(p, x);
    y = from_b(p, clamp_to_box(q, p.half_b));
    x = clamp_to_box(y, p.half_a);
  }
  q = to_b(p, x);
  const Vector3<Real> q_on_b = clamp_to_box(q, p.half_b);
  y = from_b(p, q_on_b);

  // Computes the vector from A to B in the frame of the box whose nearest feature has more free
  // axes: in that frame its components along the feature are exactly zero.
  const bool in_frame_b = free_axes(q, p.half_b) > free_axes(y, p.half_a);
  const Vector3<Real> way =
      in_frame_b ? rotate<Real>(p.turn, q_on_b - q) : Vector3<Real>(y - clamp_to_box(y, p.half_a));
  const Real distance = std::sqrt(dot(way, way));
  const Vector3<Real> normal = way * (1 / distance);
  // The better normal is the one with the greater gap, whichever has the nearer points. Rounding
  // tilts short vectors.
  const Real gap = gap_along(p, normal);
  if (!(gap > axis.gap)) return {axis.gap, axis.normal, witness_along(p, axis)};
  const bool is_tilted = gap < distance - CoreTolerance<Real>::kTilt;
  return {distance, normal, {y - normal * distance, y, is_tilted}};
}

}  // namespace carom::scalar

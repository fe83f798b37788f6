// Nearest points of two oriented boxes along a separating axis.
#pragma once

#include <algorithm>

#include "narrowphase/features/boxes_sat_scalar.h"
#include "narrowphase/features/contact_location.h"

namespace carom::scalar {

// Nearest points in the frame of A, about its centre.
template <class Real>
struct BoxWitness {
  Vector3<Real> on_a, on_b;
  bool is_unsure = false;  // axes have equal gaps: Real cannot tell along which the boxes meet
};

// The point nearest to `target` on the support feature of a box along `direction`: its face, edge
// or corner that lies furthest that way. All in the frame of the box.
template <class Real>
Vector3<Real> on_feature(const Vector3<Real>& half, const Vector3<Real>& direction,
                         const Vector3<Real>& target) {
  Vector3<Real> point;
  for (int i = 0; i < 3; ++i) {
    const bool across = std::fabs(direction[i]) <= kAcross<Real>;
    point[i] = across             ? clamp<Real>(target[i], -half[i], half[i])
               : direction[i] > 0 ? half[i]
                                  : -half[i];
  }
  return point;
}

template <class Real>
Vector3<Real> to_b(const BoxPair<Real>& p, const Vector3<Real>& x) {
  return rotate_back<Real>(p.turn, x - p.centre);
}
template <class Real>
Vector3<Real> from_b(const BoxPair<Real>& p, const Vector3<Real>& q) {
  return rotate(p.turn, q) + p.centre;
}
template <class Real>
Vector3<Real> clamp_to_box(const Vector3<Real>& x, const Vector3<Real>& half) {
  return {clamp<Real>(x.x(), -half.x(), half.x()), clamp<Real>(x.y(), -half.y(), half.y()),
          clamp<Real>(x.z(), -half.z(), half.z())};
}

// Points of the two support features along the normal, by alternating projections (von Neumann).
// These end after one step if one of the features is a corner.
template <class Real>
BoxWitness<Real> project_features(const BoxPair<Real>& p, const Vector3<Real>& normal) {
  const Vector3<Real> from_b_out = -rotate_back(p.turn, normal);
  BoxWitness<Real> w;
  w.on_a = on_feature(p.half_a, normal, p.centre);
  for (int round = 0; round < 2; ++round) {
    w.on_b = from_b(p, on_feature(p.half_b, from_b_out, to_b(p, w.on_a)));
    w.on_a = on_feature(p.half_a, normal, w.on_b);
  }
  return w;
}

template <class Real>
Real off_axis_squared(const BoxWitness<Real>& w, const Vector3<Real>& normal) {
  const Vector3<Real> way = w.on_b - w.on_a;
  const Vector3<Real> across = way - normal * dot(way, normal);
  return dot(across, across);
}

template <class Real>
BoxWitness<Real> facing_features(const BoxPair<Real>& p, const Vector3<Real>& normal) {
  return project_features(p, normal);
}

// The corners of the support feature of a box along `direction`.
inline Meeting::Points feature_corners(const Vector3d& half, const Vector3d& direction) {
  Meeting::Points corners;
  for (int i = 0; i < 8; ++i) {
    const Vector3d target(i & 1 ? half.x() : -half.x(), i & 2 ? half.y() : -half.y(),
                          i & 4 ? half.z() : -half.z());
    const Vector3d corner = on_feature(half, direction, target);
    const auto is_same = [&](const Vector3d& known) { return known == corner; };
    if (std::none_of(corners.begin(), corners.end(), is_same)) corners.push_back(corner);
  }
  return corners;
}

// The middle of the region in which the two features meet.
inline BoxWitness<double> middle_of_features(const BoxPair<double>& p, const Vector3d& normal) {
  const Vector3d from_b_out = -rotate_back(p.turn, normal);
  Meeting::Points b = feature_corners(p.half_b, from_b_out);
  for (Vector3d& corner : b) corner = from_b(p, corner);
  BoxWitness<double> w;
  w.on_a = Meeting(feature_corners(p.half_a, normal), b, normal).point();
  w.on_b = from_b(p, on_feature(p.half_b, from_b_out, to_b(p, w.on_a)));
  return w;
}

// Two projections do not reach the contact location of faces that cross like strips, or that touch
// almost edge to edge and are slightly turned. Then it takes the middle.
template <>
inline BoxWitness<double> facing_features(const BoxPair<double>& p, const Vector3d& normal) {
  const BoxWitness<double> projected = project_features(p, normal);
  const bool do_face = off_axis_squared(projected, normal) <= kTouchingSquared;
  return do_face ? projected : middle_of_features(p, normal);
}

// The nearest points of the two edges that face each other along a cross product of edges.
template <class Real>
BoxWitness<Real> facing_edges(const BoxPair<Real>& p, const SeparatingAxis<Real>& axis) {
  const int i = axis.edge_a, j = axis.edge_b;
  const Vector3<Real>& v = column(p.turn, j);
  const Vector3<Real> from_b_out = -rotate_back(p.turn, axis.normal);
  Vector3<Real> a, q;  // middles of the edges, the second one in the frame of B
  for (int k = 0; k < 3; ++k) {
    a[k] = k == i ? 0 : axis.normal[k] > 0 ? p.half_a[k] : -p.half_a[k];
    q[k] = k == j ? 0 : from_b_out[k] > 0 ? p.half_b[k] : -p.half_b[k];
  }
  const Vector3<Real> b = from_b(p, q);
  const Vector3<Real> n = axis_cross(i, v);
  const Real s = dot(cross<Real>(b - a, v), n) / dot(n, n);
  BoxWitness<Real> w{a, b};
  w.on_a[i] = clamp<Real>(s, -p.half_a[i], p.half_a[i]);
  w.on_b = b + v * clamp<Real>(dot(v, Vector3<Real>(w.on_a - b)), -p.half_b[j], p.half_b[j]);
  w.on_a[i] = clamp<Real>(w.on_b[i], -p.half_a[i], p.half_a[i]);
  return w;
}

// Whether the support features along an edge axis are really edges, not the faces that they belong
// to.
template <class Real>
bool is_edge_contact(const BoxPair<Real>& p, const SeparatingAxis<Real>& axis) {
  if (axis.edge_a < 0) return false;
  const Vector3<Real> in_b = rotate_back(p.turn, axis.normal);
  bool is_edge = true;
  for (int k = 0; k < 3; ++k) {
    if (k != axis.edge_a) is_edge = is_edge && std::fabs(axis.normal[k]) > kAcross<Real>;
    if (k != axis.edge_b) is_edge = is_edge && std::fabs(in_b[k]) > kAcross<Real>;
  }
  return is_edge;
}

// The nearest points of the boxes if the normal is the axis.
template <class Real>
BoxWitness<Real> witness_along(const BoxPair<Real>& p, const SeparatingAxis<Real>& axis) {
  const BoxWitness<Real> found =
      is_edge_contact(p, axis) ? facing_edges(p, axis) : facing_features(p, axis.normal);
  const Vector3<Real> on_b = found.on_a + axis.normal * axis.gap;
  const Vector3<Real> off_axis = found.on_b - on_b;
  return {found.on_a, on_b, dot(off_axis, off_axis) > Real(kOffAxisSquared)};
}

}  // namespace carom::scalar

// The widest gap between a box and a cylinder, scalar form.
//
// As for two cylinders (cylinders_scalar.h), every pair of features that can face each other has
// its own direction, and the separation is the widest gap of all:
// - a face, a cap: along its normal;
// - a corner, and a side or a rim: away from the axis, or from the nearest point of the rim;
// - an edge and a side: across both;
// - an edge and a rim: the best direction between the normals of the edge's two faces
//   (edge_arc_scalar.h). Edges are searched by their bounds, greatest first, and few are.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/tolerances.h"
#include "narrowphase/features/edge_arc_scalar.h"
#include "narrowphase/features/round_tolerances.h"
#include "narrowphase/features/solid_contact_scalar.h"
#include "narrowphase/scalar/vector.h"

namespace carom::scalar {

// The coordinates from the given one on.
inline Vector3f cycled(const Vector3f& v, size_t first) {
  return {v[static_cast<int>(first)], v[static_cast<int>((first + 1) % 3)],
          v[static_cast<int>((first + 2) % 3)]};
}

inline Vector3f with_signs(const Vector3f& v, const Vector3f& signs) {
  return {std::copysign(v.x(), signs.x()), std::copysign(v.y(), signs.y()),
          std::copysign(v.z(), signs.z())};
}

// A cylinder in the frame of a box, seen so that dot(axis, middle) >= 0.
struct CylinderAtBox {
  Vector3f half;  // of the box
  Vector3f middle;
  AxialCore core;

  CylinderAtBox(const Vector3f& half_extents, const Vector3f& centre, const AxialCore& cylinder)
      : half(half_extents), middle(centre), core(cylinder) {
    if (dot(core.axis, middle) < 0) core.axis = -core.axis;
  }

  float gap(const Vector3f& n) const {
    const Vector3f across = cross(n, core.axis);
    const float reach =
        core.half_length * std::fabs(dot(n, core.axis)) + core.rim * std::sqrt(dot(across, across));
    const float height =
        (half.x() * std::fabs(n.x()) + half.y() * std::fabs(n.y())) + half.z() * std::fabs(n.z());
    return (dot(n, middle) - reach) - height;
  }
};

// A direction out of the box.
struct BoxWay {
  float gap = -kLargest;
  Vector3f n{0, 0, 1};
  Vector3f on_box{0, 0, 0};  // if it is known
  bool has_point = false;
  bool has_ended = true;  // of a search

  void keep_if_wider(const BoxWay& next) {
    if (next.rank() > rank()) *this = next;
  }
  float rank() const { return gap - (has_ended ? 0.0f : kNotEnded); }
};

// One of the edges: along the coordinate e / 4, between faces of these signs.
struct BoxEdge {
  static constexpr size_t kCount = 12;

  size_t first;
  float u_sign, v_sign;
  EdgeArc arc;

  BoxEdge(const CylinderAtBox& cylinder, size_t e)
      : first(e / 4), u_sign(e & 1 ? -1.0f : 1.0f), v_sign(e & 2 ? -1.0f : 1.0f) {
    const Vector3f middle = cycled(cylinder.middle, first), half = cycled(cylinder.half, first);
    const Vector3f axis = cycled(cylinder.core.axis, first);
    arc = {.u_way = middle.y() * u_sign - half.y(),
           .v_way = middle.z() * v_sign - half.z(),
           .along = axis.x(),
           .u_axis = axis.y() * u_sign,
           .v_axis = axis.z() * v_sign,
           .half_length = cylinder.core.half_length,
           .rim = cylinder.core.rim,
           .end = {0, 1}};
  }

  Vector3f direction(const ArcPlace& n) const {
    return cycled({0, n.u * u_sign, n.v * v_sign}, (3 - first) % 3);
  }
};

inline constexpr ArcPlace kQuarterMiddle = {kArcCosines[4], kArcCosines[4]};
inline constexpr std::array<ArcPlace, 7> kQuarterPlaces = {{{kArcCosines[1], kArcCosines[7]},
                                                            {kArcCosines[2], kArcCosines[6]},
                                                            {kArcCosines[3], kArcCosines[5]},
                                                            {kArcCosines[4], kArcCosines[4]},
                                                            {kArcCosines[5], kArcCosines[3]},
                                                            {kArcCosines[6], kArcCosines[2]},
                                                            {kArcCosines[7], kArcCosines[1]}}};

inline void search_quarter(const BoxEdge& edge, BoxWay& best) {
  const ArcStarts starts(edge.arc, kQuarterPlaces);
  for (const float sign : {1.0f, -1.0f}) {
    const ArcFound found = climb_arc(edge.arc, sign, sign > 0 ? starts.front : starts.back);
    best.keep_if_wider({found.gap, edge.direction(found.n), {0, 0, 0}, false, found.has_ended});
  }
}

inline void try_faces(const CylinderAtBox& cylinder, BoxWay& best) {
  for (size_t i = 0; i < 3; ++i) {
    const Vector3f middle = cycled(cylinder.middle, i);
    const Vector3f n = cycled({std::copysign(1.0f, middle.x()), 0, 0}, (3 - i) % 3);
    best.keep_if_wider({cylinder.gap(n), n});
  }
}

// An edge and a side. The point on the edge is where both lines cross, seen along the direction.
inline void try_crossing(const CylinderAtBox& cylinder, size_t first, BoxWay& best) {
  const Vector3f axis = cycled(cylinder.core.axis, first);
  const Vector3f middle = cycled(cylinder.middle, first), half = cycled(cylinder.half, first);
  const float squared = axis.y() * axis.y() + axis.z() * axis.z();
  if (!(squared > kLeastWay)) return;
  const float over = 1 / std::sqrt(squared);
  float u = -(axis.z() * over), v = axis.y() * over;
  if (u * middle.y() + v * middle.z() < 0) {
    u = -u;
    v = -v;
  }
  const float along = axis.y() * v - axis.z() * u;
  const float u_edge = std::copysign(half.y(), u), v_edge = std::copysign(half.z(), v);
  const float aside = (u_edge - middle.y()) * v - (v_edge - middle.z()) * u;
  const float t = middle.x() + (axis.x() * aside) / along;
  const size_t back = (3 - first) % 3;
  const Vector3f n = cycled({0, u, v}, back);
  best.keep_if_wider({cylinder.gap(n), n, cycled({t, u_edge, v_edge}, back), true});
}

inline BoxWay find_box_way(const CylinderAtBox& cylinder) {
  BoxWay best;
  try_faces(cylinder, best);
  const Vector3f axis = cylinder.core.axis;
  best.keep_if_wider({cylinder.gap(axis), axis, with_signs(cylinder.half, axis), true});
  for (size_t i = 0; i < 3; ++i) try_crossing(cylinder, i, best);
  for (size_t i = 0; i < 8; ++i) {
    const Vector3f corner = cylinder.half.cwiseProduct(
        Vector3f(i & 1 ? -1.0f : 1.0f, i & 2 ? -1.0f : 1.0f, i & 4 ? -1.0f : 1.0f));
    const Vector3f n = way_from_corner(corner, cylinder.middle, cylinder.core);
    best.keep_if_wider({cylinder.gap(n), n, corner, true});
  }
  std::array<float, BoxEdge::kCount> bounds;
  float known = best.gap;  // the widest gap that is known
  for (size_t e = 0; e < bounds.size(); ++e) {
    const ArcBound quarter(BoxEdge(cylinder, e).arc, kQuarterMiddle);
    bounds[e] = quarter.most;
    known = max(known, quarter.at_middle - kNotEnded);
  }
  for (;;) {
    size_t e = 0;
    for (size_t i = 1; i < bounds.size(); ++i) {
      if (bounds[i] > bounds[e]) e = i;
    }
    if (!(bounds[e] > max(known, best.rank()))) return best;
    search_quarter(BoxEdge(cylinder, e), best);
    bounds[e] = -kLargest;
  }
}

inline Vector3f clamped_to_box(const Vector3f& p, const Vector3f& half) {
  return {clamp(p.x(), -half.x(), half.x()), clamp(p.y(), -half.y(), half.y()),
          clamp(p.z(), -half.z(), half.z())};
}

// A contact is sure if its points lie on both shapes: then no other direction has a wider gap, if
// they are apart. Where a face and a cap or a side lie on each other, the point of the one shape
// that is known may lie beside the other, and a point of the other does not.
inline SolidContact contact_along(const CylinderAtBox& cylinder, const BoxWay& way) {
  const float gap = cylinder.gap(way.n);
  const Vector3f to_cylinder = way.n * gap;
  const auto is_held = [&](const Vector3f& on_box) {
    return holds(cylinder.core, (on_box + to_cylinder) - cylinder.middle, kBesideSolid);
  };
  const Vector3f on_cylinder = cylinder.middle - furthest_point(cylinder.core, way.n);
  const Vector3f nearest = clamped_to_box(on_cylinder - to_cylinder, cylinder.half);
  const Vector3f known = clamped_to_box(way.on_box, cylinder.half);
  const bool is_known = way.has_point && is_held(known);
  const Vector3f on_box = is_known ? known : nearest;
  const bool is_sure = way.has_ended && std::fabs(gap - way.gap) <= kBesideSolid && is_held(on_box);
  return {gap, way.n, on_box, is_sure};
}

// Whether the point between those of the contact lies in both by more than rounding.
inline bool has_common_point(const CylinderAtBox& cylinder, const SolidContact& contact) {
  const Vector3f common = contact.on_solid + contact.normal * (contact.separation * 0.5f);
  const Vector3f inside = cylinder.half - common.cwiseAbs();
  return min(min(inside.x(), inside.y()), inside.z()) >= kSureGap &&
         holds(cylinder.core, common - cylinder.middle, -kSureGap);
}

}  // namespace carom::scalar

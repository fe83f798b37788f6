// How near the triangles of a shell come to zero: the scalar form.
//
// A triangle is no nearer than its plane; or, if zero projects beside it, than its edges. An edge
// is no nearer than its line; or, if one of its ends is its nearest point, than both ends. Zero is
// inside if a ray from there leaves the surface once more than it enters. Each of these counts
// where it is certain, by more than float32 rounds (kShellSure and what follows in
// base/tolerances.h); where the ray meets an edge too closely, the answer is no.
#pragma once

#include <bit>

#include "base/tolerances.h"
#include "narrowphase/hulls/shell.h"

namespace carom::scalar {

// The squared distance of the edge from p to q, or less. `across`: p x q.
inline float edge_squared(const Vector3<float>& p, const Vector3<float>& q,
                          const Vector3<float>& across, float pp, float qq, float greatest) {
  const Vector3<float> e = q - p;
  const float pq = dot(p, q), sure = kShellSure * greatest;
  if (pq - pp > sure || pq - qq > sure) return min(pp, qq) * kShellShare;
  const float product = dot(across, across) * kShellShare - kShellEdgeRest * (greatest * greatest);
  return product > 0 ? product / dot(e, e) : 0;
}

struct ShellTriangle {
  Vector3<float> a, b, c, ab, bc, ca;  // the corners, and the products of each two
  float aa, bb, cc, greatest;          // squared distances of the corners from zero
  Vector3<float> normal;
  float volume;
  float height;   // no more than its amount
  float squared;  // of the plane's distance from zero, or less

  ShellTriangle(const Shell& shell, const ShellSpace& space, size_t i)
      : a(space.corner_at(shell.corner_of(i, 0))),
        b(space.corner_at(shell.corner_of(i, 1))),
        c(space.corner_at(shell.corner_of(i, 2))),
        ab(cross(a, b)),
        bc(cross(b, c)),
        ca(cross(c, a)),
        aa(dot(a, a)),
        bb(dot(b, b)),
        cc(dot(c, c)),
        greatest(max(max(aa, bb), cc)),
        normal((ab + bc) + ca),
        volume(dot(a, bc)),
        height(std::fabs(volume) - kShellSure * (greatest * (greatest + 1))),
        squared(height > 0 ? height * height / dot(normal, normal) : 0) {}
};

inline ShellCheck check_planes(const Shell& shell, ShellSpace& space) {
  ShellCheck check;
  check.least_squared = kLargest;
  const Vector3<float> ray(kShellRay[0], kShellRay[1], kShellRay[2]);
  bool is_sure = true;
  int crossings = 0;
  for (size_t i = 0; i < shell.triangle_count; ++i) {
    const ShellTriangle t(shell, space, i);
    for (size_t axis = 0; axis < 3; ++axis) {
      space.normal[axis][i] = t.normal[static_cast<int>(axis)];
    }
    space.volume[i] = t.volume;
    if (t.squared < check.least_squared) {
      check.least_squared = t.squared;
      check.nearest = i;
    }
    // The ray from zero.
    const float sure = kShellSure * t.greatest;
    const float beside_ab = dot(t.ab, ray), beside_bc = dot(t.bc, ray), beside_ca = dot(t.ca, ray);
    const float most = max(max(beside_ab, beside_bc), beside_ca);
    const float least = min(min(beside_ab, beside_bc), beside_ca);
    const bool is_missed = most > sure && least < -sure;
    const bool from_behind = least > sure, from_before = most < -sure;
    const bool is_hit = (from_behind || from_before) && t.height > 0;
    is_sure = is_sure && (is_missed || is_hit);
    crossings += is_hit && from_behind && t.volume > 0 ? 1 : 0;
    crossings -= is_hit && from_before && t.volume < 0 ? 1 : 0;
  }
  check.is_around = is_sure && crossings == 1;
  return check;
}

inline ShellCheck check_edges(const Shell& shell, const ShellSpace& space) {
  ShellCheck check;
  check.least_squared = kLargest;
  check.is_around = true;
  for (size_t i = 0; i < shell.triangle_count; ++i) {
    const ShellTriangle t(shell, space, i);
    const float beside = -kShellBeside * (t.greatest * t.greatest);
    const bool is_beside = dot(t.normal, t.ab) < beside || dot(t.normal, t.bc) < beside ||
                           dot(t.normal, t.ca) < beside;
    const float edges = min(min(edge_squared(t.a, t.b, t.ab, t.aa, t.bb, t.greatest),
                                edge_squared(t.b, t.c, t.bc, t.bb, t.cc, t.greatest)),
                            edge_squared(t.c, t.a, t.ca, t.cc, t.aa, t.greatest));
    const float squared = is_beside ? max(t.squared, edges) : t.squared;
    if (squared < check.least_squared) {
      check.least_squared = squared;
      check.nearest = i;
    }
  }
  return check;
}

inline uint64_t in_front(const Shell& shell, const ShellSpace& space, const Vector3<float>& point) {
  uint64_t found = 0;
  for (size_t i = 0; i < shell.triangle_count; ++i) {
    found |= uint64_t{dot(space.normal_at(i), point) > space.volume[i] + kShellInFront} << i;
  }
  return found;
}

}  // namespace carom::scalar

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
                          const Vector3<float>& across, float greatest) {
  const Vector3<float> e = q - p;
  const float pp = dot(p, p), qq = dot(q, q), pq = dot(p, q), sure = kShellSure * greatest;
  if (pq - pp > sure || pq - qq > sure) return min(pp, qq) * kShellShare;
  const float product = dot(across, across) * kShellShare - kShellEdgeRest * (greatest * greatest);
  return product > 0 ? product / dot(e, e) : 0;
}

struct ShellTriangle {
  Vector3<float> a, b, c;  // the corners
  float greatest;          // squared distance of a corner from zero
  Vector3<float> normal;
  float volume;
  float height;   // no more than its amount
  float squared;  // of the plane's distance from zero, or less

  ShellTriangle(const Shell& shell, const ShellSpace& space, size_t i)
      : a(space.corner_at(shell.corner_of(i, 0))),
        b(space.corner_at(shell.corner_of(i, 1))),
        c(space.corner_at(shell.corner_of(i, 2))),
        greatest(max(max(dot(a, a), dot(b, b)), dot(c, c))),
        normal(cross<float>(b - a, c - a)),
        volume(dot(a, normal)),
        height(std::fabs(volume) - kShellHeight * (greatest * (greatest + 1))),
        squared(height > 0 ? height * height / dot(normal, normal) : 0) {}
};

// A corner, seen along the ray.
struct ShellView {
  float u, v;

  explicit ShellView(const Vector3<float>& p) : u(dot(p, across(0))), v(dot(p, across(1))) {}
  static Vector3<float> across(size_t i) {
    return {kShellAcross[i][0], kShellAcross[i][1], kShellAcross[i][2]};
  }
};

// On which side of the edge from p to q the ray passes.
inline float beside(const ShellView& p, const ShellView& q) { return p.u * q.v - p.v * q.u; }

inline ShellCheck check_planes(const Shell& shell, ShellSpace& space) {
  ShellCheck check;
  check.least_squared = kLargest;
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
    const ShellView a(t.a), b(t.b), c(t.c);
    const float sure = kShellSure * t.greatest;
    const float beside_ab = beside(a, b), beside_bc = beside(b, c), beside_ca = beside(c, a);
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
    const Vector3<float> ab = cross(t.a, t.b), bc = cross(t.b, t.c), ca = cross(t.c, t.a);
    const float least = -kShellBeside * (t.greatest * t.greatest);
    const bool is_beside =
        dot(t.normal, ab) < least || dot(t.normal, bc) < least || dot(t.normal, ca) < least;
    const float edges =
        min(min(edge_squared(t.a, t.b, ab, t.greatest), edge_squared(t.b, t.c, bc, t.greatest)),
            edge_squared(t.c, t.a, ca, t.greatest));
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

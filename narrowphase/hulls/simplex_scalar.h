// Simplices of B - A, and their point nearest to zero. The search tries every side and face at the
// last corner, because the form in lanes has no branches that could save them.
#pragma once

#include <array>

#include "base/tolerances.h"
#include "narrowphase/scalar/vector.h"

namespace carom::scalar {

using Eigen::Vector3f;

// A corner of B - A, and the point of A that it belongs to.
struct Corner {
  Vector3f point, on_a;
};

// Up to three corners, in any places.
struct Simplex {
  std::array<Corner, 3> corner;
  std::array<bool, 3> is_used{};
};

// Whether zero is inside the tetrahedron of four corners: its barycentric coordinates have one
// sign.
struct ZeroInside {
  bool is_inside;
  bool is_sure;  // and deeper than float32 rounding

  // `of[i]`: volume of zero with all corners but the i-th. `volume`: of the whole tetrahedron, from
  // the sides at its last corner. Six times the volume, signed.
  ZeroInside(const std::array<float, 3>& of, float volume, const std::array<Vector3f, 4>& corner) {
    const float of_last = -(volume + ((of[0] + of[1]) + of[2]));
    const float least = min(min(of[0], of[1]), min(of[2], of_last));
    const float most = max(max(of[0], of[1]), max(of[2], of_last));
    const float depth = max(least, -most);
    const auto squared = [&](size_t i) { return dot(corner[i], corner[i]); };
    const float size = max(max(squared(0), squared(1)), max(squared(2), squared(3)));
    is_inside = depth > 0;
    is_sure = is_inside && depth > size * kSureVolume;
  }
};

// The point nearest to zero among all faces, sides and the corner itself that hold the new corner,
// and the old corners that span it too.
class NearestOfCorners {
 public:
  NearestOfCorners(const Simplex& simplex, const Vector3f& last)
      : last_(last), point(last), squared(dot(last, last)) {
    const auto& used = simplex.is_used;
    std::array<Side, 3> side;
    for (size_t i = 0; i < 3; ++i) side[i] = side_to(simplex.corner[i].point, used[i]);
    const Triangle pq = triangle_of(side[0], side[1]), pr = triangle_of(side[0], side[2]),
                   qr = triangle_of(side[1], side[2]);
    try_triangle(pq, 0, 1);
    try_triangle(pr, 0, 2);
    try_triangle(qr, 1, 2);
    try_sides(side, {pq.is_towards_second || pr.is_towards_second,
                     pq.is_towards_first || qr.is_towards_second,
                     pr.is_towards_first || qr.is_towards_first});
    if (used[0] && used[1] && used[2]) {
      const auto& corner = simplex.corner;
      const ZeroInside zero({qr.height, -pr.height, pq.height}, dot(pq.normal, side[2].way),
                            {corner[0].point, corner[1].point, corner[2].point, last});
      is_around = zero.is_inside;
      is_sure_around = zero.is_sure;
    }
  }

 private:
  // From the last corner to another.
  struct Side {
    Vector3f way;
    float along;  // projection of zero on the side, times its length
    float squared;
    bool is_used;
  };

  // The triangle of the last corner and two others.
  struct Triangle {
    Vector3f normal;
    float height;  // of the plane over zero, times the normal's length
    float squared_normal;
    bool is_towards_first, is_towards_second;  // zero is on that side of the other one
    bool is_over;                              // zero projects into the triangle
  };

  Vector3f last_;

 public:
  Vector3f point;
  float squared;
  std::array<bool, 3> is_kept{};
  bool is_around = false;       // zero lies inside the tetrahedron
  bool is_sure_around = false;  // and deeper than float32 rounding

 private:
  Side side_to(const Vector3f& corner, bool is_used) const {
    const Vector3f way = corner - last_;
    return {way, -dot(last_, way), dot(way, way), is_used};
  }

  // Lagrange's identity needs only dot products of the sides.
  Triangle triangle_of(const Side& p, const Side& q) const {
    if (!p.is_used || !q.is_used) return {};
    const float pq = dot(p.way, q.way);
    const float of_p = q.squared * p.along - q.along * pq;
    const float of_q = p.squared * q.along - p.along * pq;
    Triangle t;
    t.normal = cross<float>(p.way, q.way);
    t.height = dot(t.normal, last_);
    t.squared_normal = dot(t.normal, t.normal);
    t.is_towards_first = of_p > 0;
    t.is_towards_second = of_q > 0;
    t.is_over = t.is_towards_first && t.is_towards_second && t.squared_normal > of_p + of_q;
    return t;
  }

  // `is_left_out`: zero is nearer to a triangle at that side.
  void try_sides(const std::array<Side, 3>& sides, const std::array<bool, 3>& is_left_out) {
    for (size_t i = 0; i < 3; ++i) {
      const Side& s = sides[i];
      if (!s.is_used || is_left_out[i] || !(s.along > 0 && s.along < s.squared)) continue;
      const Vector3f beside = last_ + s.way * (s.along / s.squared);
      return keep(beside, dot(beside, beside), i, i);
    }
  }

  void try_triangle(const Triangle& t, size_t one, size_t other) {
    if (!t.is_over) return;
    const float share = t.height / t.squared_normal;
    keep(t.normal * share, share * t.height, one, other);
  }

  void keep(const Vector3f& p, float square, size_t one, size_t other) {
    if (!(square < squared)) return;
    squared = square;
    point = p;
    for (size_t i = 0; i < 3; ++i) is_kept[i] = i == one || i == other;
  }
};

}  // namespace carom::scalar

// The gap of two cores by plain GJK, and from the four corners that it ends with around zero by a
// portal: the face of a tetrahedron in front of zero, which moves outwards until it lies in the
// surface of B - A. Both run in lanes as well (plain_gap-inl.h). What they do not settle is left to
// the careful searches.
//
// Cores that touch to within rounding have zero next to a face of B - A, seldom next to an edge of
// it. GJK ends at that face from outside, and the portal from inside.
//
// Source: G. Snethen, "XenoCollide: Complex Collision Made Simple", Game Programming Gems 7, 2008
// (the portal).
#pragma once

#include <array>
#include <cmath>

#include "narrowphase/doubles/core_gap.h"
#include "narrowphase/doubles/plain_gjk.h"

namespace carom::scalar {

inline constexpr int kMostPortals = 16;  // two are usual

// Zero lies over a triangle if none of its shares there is below this.
inline constexpr double kWellInside = 0x1p-20;

// A triangle of corners of B - A.
struct CoreFace {
  CoreVector normal;  // towards those who see the corners counter-clockwise; of any length
  double squared;     // its length
  bool is_sliver;
  bool is_under_zero;  // zero lies well over it or well under it

  CoreFace(const CoreVector& p, const CoreVector& q, const CoreVector& r) {
    const CoreVector u = q - p, v = r - p;
    normal = cross(u, v);
    squared = dot(normal, normal);
    is_sliver = !(squared > kSliverSquared * (dot(u, u) * dot(v, v)));
    const CoreVector across = cross(normal, p);
    const double of_q = -dot(across, v), of_r = dot(across, u);
    const double least = min(min(of_q, of_r), squared - (of_q + of_r));
    is_under_zero = least > squared * kWellInside;
  }
};

// Whether the end of plain GJK at the nearest corners gives the gap.
inline bool find_nearest_gap(const PlainGjk& gjk, CoreGap& gap) {
  const auto& corner = gjk.simplex.corner;
  const CoreFace face(corner[0], corner[1], corner[2]);
  const bool has_face = gjk.simplex.used == 0b111 && !face.is_sliver;
  const double distance = std::sqrt(gjk.squared), parted = gjk.gap / distance;
  gap = {.size = distance,
         .normal = gjk.point * (1 / distance),
         .is_proven = parted > kProvenGap,
         .is_at_corners = distance > kFarFromTouching || (has_face && face.is_under_zero)};
  // The normal of a face is exact however near it is.
  const bool is_clear = distance > kTouchingWay || (distance > kTouchingCores && has_face);
  return is_clear && distance - parted <= kSameGap;
}

// Zero lies inside of a tetrahedron of corners of B - A: behind the portal, and in front of the
// fourth corner.
class Portal {
 public:
  explicit Portal(const std::array<CoreVector, 4>& corner) {
    double least = HUGE_VAL;
    for (size_t i = 0; i < 4; ++i) {
      const CoreVector &a = corner[(i + 1) % 4], &b = corner[(i + 2) % 4], &c = corner[(i + 3) % 4];
      const CoreVector n = cross(b - a, c - a);
      const double height = dot(n, a), squared = height * height / dot(n, n);
      if (!(squared < least)) continue;
      least = squared;
      behind_ = corner[i];
      p_ = a;
      q_ = height > 0 ? b : c;
      r_ = height > 0 ? c : b;
    }
    squared_ = least;
  }

  // The height of the nearest face over zero, squared.
  double squared_height() const { return squared_; }

  // Moves the portal outwards. False if it does not get to the nearest face of B - A.
  bool find_gap(const Core& a, const Core& b, FurthestPoint furthest, CoreGap& gap) {
    for (int round = 0; round < kMostPortals; ++round) {
      const CoreFace face(p_, q_, r_);
      const CoreVector n = face.normal * (1 / std::sqrt(face.squared));
      const double height = dot(n, p_);
      if (face.is_sliver || !(height > 0)) return false;
      const CoreVector next = difference_point(a, b, -n, furthest);
      const double reach = dot(n, next);
      if (reach - height <= kSameWayOut) {
        gap = {.size = -reach,
               .normal = -n,
               .is_proven = reach > kProvenGap,
               .is_at_corners = face.is_under_zero};
        return is_beyond(p_, q_, reach) && is_beyond(q_, r_, reach) && is_beyond(r_, p_, reach);
      }
      if (!move_to(next)) return false;
    }
    return false;
  }

 private:
  // Whether the face between two corners and that behind zero is no nearer to zero than `reach`.
  bool is_beyond(const CoreVector& p, const CoreVector& q, double reach) const {
    const CoreVector n = cross(p - behind_, q - behind_);
    const double height = -dot(n, behind_);
    return height > 0 && height * height >= reach * reach * dot(n, n);
  }

  // The corner takes the place of that which leaves the ray from behind through zero in the portal.
  bool move_to(const CoreVector& next) {
    const CoreVector across = cross(next, behind_);
    const bool p = dot(across, p_) > 0, q = dot(across, q_) > 0, r = dot(across, r_) > 0;
    if (q && !r) {
      p_ = next;
    } else if (r && !p) {
      q_ = next;
    } else if (p && !q) {
      r_ = next;
    } else {
      return false;
    }
    return true;
  }

  CoreVector behind_{}, p_{}, q_{}, r_{};
  double squared_;
};

// The gap, if the plain searches settle it.
inline bool find_plain_gap(const Core& a, const Core& b, const PlainGjk& gjk,
                           FurthestPoint furthest, bool decides_only, CoreGap& gap) {
  if (gjk.end == PlainGjk::End::nearest) return find_nearest_gap(gjk, gap);
  if (gjk.end != PlainGjk::End::around) return false;
  const auto& corner = gjk.simplex.corner;
  Portal portal({corner[0], corner[1], corner[2], gjk.last});
  if (decides_only && portal.squared_height() > kProvenGap * kProvenGap) {
    gap = {.size = -std::sqrt(portal.squared_height()), .normal = {1, 0, 0}, .is_proven = true};
    return true;
  }
  return portal.find_gap(a, b, furthest, gap);
}

}  // namespace carom::scalar

// GJK for two cores of which one is round, with plain simplices, as far as rounding decides nothing
// (round_gjk-inl.h is the same in lanes). A round core has no last corner: the search ends where
// the gap along the nearest vector shows its length to be the distance.
#pragma once

#include <cmath>

#include "narrowphase/doubles/core_gap.h"
#include "narrowphase/doubles/plain_gap.h"

namespace carom::scalar {

// A search that approaches a smooth surface has corners that lie nearly on a line. Below this
// squared sine rounding turns the normal of their triangle by as much as normals may be off.
inline constexpr double kRoundSliver = 0x1p-56;

// Added to the way from A to B for the first round: where that lies in a plane of symmetry of both
// cores, all corners would, and no tetrahedron would have zero inside.
inline constexpr CoreVector kOffPlane{0x1.3p-5, 0x1.9p-5, 0x1.5p-5};

// The most rounds; thirty are many.
inline constexpr int kMostRoundRounds = 64;

// Less than this share of a square is rounding.
inline constexpr double kRoundedSquare = 0x1p-50;

// A decision alone needs cores to be apart, or within their radii, by more than this, which
// exceeds kProvenGap.
inline constexpr double kClearRoundGap = 0x1p-30;

// Whether GJK has ended: the length of the vector exceeds the gap along it by no more than
// kSameRoundGap and a quarter of kSameRoundWay of itself, or by rounding. `gap`: times the length;
// `squared`: the square of the length.
inline bool is_as_near(double gap, double squared) {
  const double less = squared - gap;
  return less <= kRoundedSquare * squared ||
         (less <= kSameRoundWay / 4 * squared &&
          less * less <= (kSameRoundGap * kSameRoundGap) * squared);
}

// Says whether the caller wants the decision alone of separate shapes, and of overlapping ones.
struct RoundGoal {
  bool decides_separate = false;
  bool decides_overlapping = false;
};

class RoundGjk {
 public:
  enum class End {
    unclear,
    nearest,  // `point` is the nearest one
    apart,    // surely separate: the gap exceeds the radii
    within,   // surely overlapping: the cores are apart, but `point` is nearer than the radii
    around,   // zero lies inside of four corners
  };

  End end = End::unclear;
  PlainSimplex simplex;    // corners of B - A
  PlainSimplex of_a;       // the points of A that belong to them
  CoreVector point;        // nearest to zero
  double squared;          // its distance
  double gap = 0;          // at the end: between the projections on `point`, times its length
  double radius;           // of both together
  DifferencePoint last{};  // around zero: the fourth corner

  RoundGjk(const Core& a, const Core& b, FurthestPoint furthest, const RoundGoal& goal)
      : radius(a.radius + b.radius) {
    const double clear = radius + kClearRoundGap;
    const double within = goal.decides_overlapping ? max(radius - kClearRoundGap, 0.0) : 0;
    const DifferencePoint first =
        find_difference_point(a, b, (b.middle - a.middle) + kOffPlane, furthest);
    point = first.point;
    squared = dot(point, point);
    replace(0, first);
    for (int round = 0; round < kMostRoundRounds && squared > kTouchingSquared; ++round) {
      const DifferencePoint next = find_difference_point(a, b, point, furthest);
      gap = dot(point, next.point);
      if (is_as_near(gap, squared) || simplex.holds(next.point)) {
        end = End::nearest;
        return;
      }
      if (goal.decides_separate && gap > 0 && gap * gap > (clear * clear) * squared) {
        end = End::apart;
        return;
      }
      if (squared < within * within && gap > 0 &&
          gap * gap > (kClearRoundGap * kClearRoundGap) * squared) {
        end = End::within;
        return;
      }
      const PlainNearest nearer(simplex, next.point, kRoundSliver);
      if (nearer.is_around) {
        end = End::around;
        last = next;
        return;
      }
      if (nearer.is_unclear || !(nearer.squared < squared)) return;
      replace(nearer.kept, next);
      point = nearer.point;
      squared = nearer.squared;
    }
  }

  // The point of A that belongs to `point`.
  CoreVector point_of_a() const {
    const bool has_p = simplex.used & 0b001, has_q = simplex.used & 0b010;
    const size_t first = has_p ? 0 : has_q ? 1 : 2, second = has_p && has_q ? 1 : 2;
    const CoreVector &p = simplex.corner[first], &on_a = of_a.corner[first];
    const CoreVector u = simplex.corner[second] - p, way = point - p;
    const CoreVector along = of_a.corner[second] - on_a;
    if (simplex.used != 0b111) {
      if (first == 2 || simplex.used == 0b001 || simplex.used == 0b010) return on_a;
      return on_a + along * (dot(way, u) / dot(u, u));
    }
    const CoreVector v = simplex.corner[2] - p, n = cross(u, v);
    const double each = 1 / dot(n, n);
    const double of_u = dot(n, cross(way, v)) * each, of_v = dot(n, cross(u, way)) * each;
    return (on_a + along * of_u) + (of_a.corner[2] - on_a) * of_v;
  }

 private:
  void replace(unsigned kept, const DifferencePoint& next) {
    simplex.replace(kept, next.point);
    of_a.replace(kept, next.of_a);
  }
};

// The gap, if GJK settles it: the distance. Where the decision alone is wanted: less than the
// distance of separate shapes, no less than that of cores within their radii, and less than a
// depth.
inline bool find_plain_round_gap(const RoundGjk& gjk, const RoundGoal& goal, CoreGap& gap) {
  using End = RoundGjk::End;
  if (gjk.end == End::around && goal.decides_overlapping) {
    const auto& corner = gjk.simplex.corner;
    const Portal portal({corner[0], corner[1], corner[2], gjk.last.point});
    const double squared = portal.squared_height();
    gap = {.size = -std::sqrt(squared), .normal = {1, 0, 0}, .is_proven = true};
    return squared > kProvenGap * kProvenGap;
  }
  if (gjk.end == End::unclear || gjk.end == End::around) return false;
  const double distance = std::sqrt(gjk.squared), parted = gjk.gap / distance;
  gap = {.size = gjk.end == End::apart ? parted : distance,
         .normal = gjk.point * (1 / distance),
         .is_proven = distance <= gjk.radius || parted > gjk.radius + kProvenGap,
         .has_point = true,
         .of_a = gjk.point_of_a()};
  const double slack = min(kSameRoundWayOut, kSameRoundWay * distance);
  return gjk.end != End::nearest || (distance > kTouchingRound && distance - parted <= slack);
}

}  // namespace carom::scalar

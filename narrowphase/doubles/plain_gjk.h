// GJK with plain simplices, as far as rounding decides nothing (plain_gap-inl.h is the same in
// lanes). It ends at the nearest corners, or with zero inside of four; or it is unclear, and a
// careful search goes on from its corners.
#pragma once

#include "base/tolerances.h"
#include "narrowphase/doubles/core.h"
#include "narrowphase/doubles/plain_simplex.h"

namespace carom {

// A point of the difference B - A of two cores, and of A.
struct DifferencePoint {
  CoreVector point, of_a;
};

// The one that is furthest along -way.
inline DifferencePoint find_difference_point(const Core& a, const Core& b, const CoreVector& way,
                                             FurthestPoint furthest) {
  const CoreVector of_a = support_point(a, way, furthest);
  return {support_point(b, -way, furthest) - of_a, of_a};
}

inline CoreVector difference_point(const Core& a, const Core& b, const CoreVector& way,
                                   FurthestPoint furthest) {
  return support_point(b, -way, furthest) - support_point(a, way, furthest);
}

namespace scalar {

inline constexpr int kMostPlainRounds = 32;  // six are usual

class PlainGjk {
 public:
  enum class End { unclear, nearest, around };

  End end = End::unclear;
  PlainSimplex simplex;
  CoreVector point;   // nearest to zero
  double squared;     // its distance
  double gap = 0;     // at the end: between the projections on `point`, times its length
  CoreVector last{};  // around zero: the fourth corner

  PlainGjk(const Core& a, const Core& b, FurthestPoint furthest)
      : point(difference_point(a, b, b.middle - a.middle, furthest)), squared(dot(point, point)) {
    simplex.replace(0, point);
    for (int round = 0; round < kMostPlainRounds && squared > kTouchingSquared; ++round) {
      const CoreVector next = difference_point(a, b, point, furthest);
      gap = dot(point, next);
      if (gap >= squared || simplex.holds(next)) {
        end = End::nearest;
        return;
      }
      const PlainNearest nearer(simplex, next);
      if (nearer.is_around) {
        end = End::around;
        last = next;
        return;
      }
      if (nearer.is_unclear || !(nearer.squared < squared)) return;
      simplex.replace(nearer.kept, next);
      point = nearer.point;
      squared = nearer.squared;
    }
  }
};

}  // namespace scalar
}  // namespace carom

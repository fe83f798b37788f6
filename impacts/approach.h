// How far two cores certainly get that move without rotating: GJK at a time that goes on. Any
// direction along which the cores are apart tells when the gap along it closes; the search for the
// nearest points goes on at that time. Most pairs that do not meet are known after a few support
// points, long before the nearest ones.
//
// Source: G. van den Bergen, "Ray Casting against General Convex Objects with Application to
// Continuous Collision Detection", 2004.
#pragma once

#include <cmath>

#include "impacts/direction_gap.h"
#include "impacts/linear/crossing_scalar.h"
#include "narrowphase/doubles/gjk.h"
#include "narrowphase/doubles/plain_simplex.h"

namespace carom::scalar {

inline constexpr int kMostApproachRounds = 32;  // four are usual

// NearestPoint with the interface of PlainNearest, for what that leaves unclear.
class CarefulNearest {
 public:
  CoreVector point;
  double squared;
  unsigned kept = 0;
  bool is_around;
  static constexpr bool is_unclear = false;

  CarefulNearest(const PlainSimplex& simplex, const CoreVector& last) {
    NearestPoint::Corners corners;
    FewOf<unsigned, 4> place;
    for (unsigned i = 0; i < 3; ++i) {
      if (!(simplex.used >> i & 1) || are_same(simplex.corner[i], last)) continue;
      corners.push_back(simplex.corner[i]);
      place.push_back(1u << i);
    }
    corners.push_back(last);
    const NearestPoint nearest(corners);
    point = nearest.point();
    squared = nearest.squared();
    is_around = nearest.is_around_zero();
    for (size_t i = 0; i < place.size(); ++i) {
      if (nearest.spans(i)) kept |= place[i];
    }
  }
};

template <class Nearest>
class Approach {
 public:
  // Starts at time t. Cores that are `tolerance` apart count as touching.
  Approach(const MovingPair& pair, double t, double tolerance)
      : pair_(pair),
        from_(core_vector((pair.from + pair.b.arm) - pair.a.arm)),
        way_(core_vector(pair.way)),
        tolerance_(tolerance),
        t_(t) {
    run();
  }

  // Until this time the cores are apart; kNever if they are until pair.latest.
  double time() const { return t_; }
  // Whether they touch then, or never. If not, a more careful search has to go on.
  bool is_over() const { return is_over_; }

 private:
  void run() {
    const CoreVector middles = pair_.b.core->middle - pair_.a.core->middle;
    PlainSimplex simplex;  // at no offset
    CoreVector at = from_ + way_ * t_;
    simplex.replace(0, corner(middles + at));
    Nearest nearest({}, simplex.corner[0] + at);
    for (int round = 0; round < kMostApproachRounds; ++round) {
      const double distance = std::sqrt(nearest.squared);
      // A distance that rounding decides proves no touch.
      is_over_ = nearest.is_around || (!nearest.is_unclear && distance - pair_.radii <= tolerance_);
      if (is_over_ || nearest.is_unclear) return;
      const CoreVector n = nearest.point * (1 / distance), next = corner(n);
      const double gap = dot(n, next + at) - pair_.radii;
      double step = 0;
      if (gap > tolerance_) {
        step = time_to_close(gap, -dot(n, way_));
        if (is_over_) return;
        t_ += step;
        at = from_ + way_ * t_;
      }
      PlainSimplex placed = simplex;
      for (CoreVector& placed_corner : placed.corner) placed_corner = placed_corner + at;
      const Nearest nearer(placed, next + at);
      if (!(step > 0) && !(nearer.squared < nearest.squared)) return;
      simplex.replace(nearer.kept, next);
      nearest = nearer;
    }
  }

  // The corner of B - A that is lowest along n, at no offset.
  CoreVector corner(const CoreVector& n) const {
    return difference_point(*pair_.a.core, *pair_.b.core, n, pair_.furthest);
  }

  // Leaves half of the tolerance. Sets t_ and is_over_ if the gap certainly does not close in time:
  // a quarter of the tolerance covers the rounding, so that a pair that meets at the latest time to
  // the bit has that time.
  double time_to_close(double gap, double closing) {
    const double way = gap - tolerance_ / 2;
    is_over_ = !(closing * (pair_.latest - t_) >= way - tolerance_ / 4);
    if (is_over_) t_ = kNever;
    return way / closing;
  }

  const MovingPair& pair_;
  const CoreVector from_, way_;
  const double tolerance_;
  double t_;
  bool is_over_ = false;
};

}  // namespace carom::scalar

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

namespace carom::scalar {

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
  // Whether they touch then. If not, a more careful search has to go on.
  bool is_over() const { return is_over_; }

 private:
  using Corners = NearestPoint::Corners;

  void run() {
    constexpr int kMostRounds = 32;  // four are usual
    const CoreVector middles = pair_.b.core->middle - pair_.a.core->middle;
    NearestPoint nearest({corner(middles + (from_ + way_ * t_))});
    for (int round = 0; round < kMostRounds; ++round) {
      const double distance = std::sqrt(nearest.squared());
      is_over_ = nearest.is_around_zero() || distance - pair_.radii <= tolerance_;
      if (is_over_) return;
      const CoreVector n = nearest.point() * (1 / distance), next = corner(n);
      const double gap = dot(n, next) - pair_.radii;
      double step = 0;
      if (gap > tolerance_) {
        step = time_to_close(gap, -dot(n, way_));
        if (is_over_) return;
        t_ += step;
      }
      const NearestPoint nearer(moved(nearest.corners(), next, way_ * step));
      if (!(step > 0) && !(nearer.squared() < nearest.squared())) return;
      nearest = nearer;
    }
  }

  // The corner of B - A that is lowest along n, at the present time.
  CoreVector corner(const CoreVector& n) const {
    return difference_point(*pair_.a.core, *pair_.b.core, n, pair_.furthest) + (from_ + way_ * t_);
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

  static Corners moved(const Corners& corners, const CoreVector& last, const CoreVector& way) {
    Corners result;
    for (const CoreVector& corner : corners) {
      if (!are_same(corner, last)) result.push_back(corner + way);
    }
    result.push_back(last + way);
    return result;
  }

  const MovingPair& pair_;
  const CoreVector from_, way_;
  const double tolerance_;
  double t_;
  bool is_over_ = false;
};

}  // namespace carom::scalar

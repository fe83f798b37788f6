// Whether two hulls of points, each grown by a radius, have a common point: GJK in any number type,
// without division. In exact numbers it always ends with the right answer, because every round
// comes nearer to the origin and there are finitely many simplices.
//
// Source: E. G. Gilbert, D. W. Johnson, S. S. Keerthi, A Fast Procedure for Computing the Distance
// Between Complex Objects in Three-Dimensional Space, IEEE J. Robotics and Automation 4(2), 1988.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "narrowphase/proof/nearest_simplex.h"

namespace carom {

template <class Number>
struct GrownHull {
  std::vector<VectorOf<Number>> points;
  Number radius{0.0};
};

// The last state of the search, for proofs: a direction that separates the hulls, or points of B -
// A that contain the origin or come near enough.
template <class Number>
struct OverlapEvidence {
  bool overlap = false;
  VectorOf<Number> way{};
  FewOf<VectorOf<Number>, 4> simplex;  // contains the nearest point
};

template <class Number>
class OverlapSearch {
 public:
  using Vector = VectorOf<Number>;
  using Hull = GrownHull<Number>;
  using Evidence = OverlapEvidence<Number>;

  // `most_rounds`: a limit for number types that round, because they may cycle; -1: none.
  OverlapSearch(const Hull& a, const Hull& b, int most_rounds = -1)
      : a_(a.points), b_(b.points), reach_(a.radius + b.radius), rounds_left_(most_rounds) {
    for (const Points* points : {&a_, &b_}) greatest_ = std::max(greatest_, points->greatest);
  }

  Evidence run() {
    const Number reach_squared = reach_ * reach_;
    simplex_.push_back(b_.exact[0] - a_.exact[0]);
    while (true) {
      const NearestOfSimplex<Number> nearest = SimplexSearch<Number>::nearest(simplex_);
      keep(nearest.carriers);
      const Number within = nearest.numerator - reach_squared * nearest.denominator;
      if (nearest.is_origin() || sign_of(within) <= 0) return {true, nearest.way, simplex_};
      const Vector next = support(nearest.way);
      const Number height = dot(nearest.way, next);
      const Number length_squared = dot(nearest.way, nearest.way);
      const bool is_apart =
          sign_of(height) > 0 && sign_of(height * height - reach_squared * length_squared) > 0;
      const bool is_nearest = sign_of(height - dot(nearest.way, simplex_[0])) >= 0;
      if (is_apart || is_nearest || rounds_left_-- == 0) return {false, nearest.way, simplex_};
      simplex_.push_back(next);
    }
  }

 private:
  struct Points {
    const std::vector<Vector>& exact;
    std::vector<VectorOf<double>> rough;
    double greatest = 0;  // magnitude of a coordinate

    explicit Points(const std::vector<Vector>& points) : exact(points) {
      for (const Vector& p : points) {
        rough.push_back({approximately(p.x), approximately(p.y), approximately(p.z)});
        greatest = std::max({greatest, magnitude(p.x), magnitude(p.y), magnitude(p.z)});
      }
    }
  };

  void keep(const FewOf<uint8_t, 4>& carriers) {
    FewOf<Vector, 4> kept;
    for (const uint8_t i : carriers) kept.push_back(simplex_[i]);
    simplex_ = kept;
  }

  // The point of B - A with the least height along `way`.
  Vector support(const Vector& way) const {
    const VectorOf<double> rough = {approximately(way.x), approximately(way.y),
                                    approximately(way.z)};
    return b_.exact[furthest(b_, -way, -rough)] - a_.exact[furthest(a_, way, rough)];
  }

  // Doubles rule out most points. Points that doubles cannot distinguish are compared exactly.
  size_t furthest(const Points& points, const Vector& way, const VectorOf<double>& rough) const {
    const double reach = (magnitude(way.x) + magnitude(way.y) + magnitude(way.z)) * greatest_;
    const bool rough_is_good = reach > 1e-250 && reach < 1e250;
    double most = -HUGE_VAL;
    for (const VectorOf<double>& p : points.rough) most = std::max(most, dot(rough, p));
    size_t best = points.exact.size();
    for (size_t i = 0; i < points.exact.size(); ++i) {
      if (rough_is_good && dot(rough, points.rough[i]) < most - 0x1p-44 * reach) continue;
      const bool is_first = best == points.exact.size();
      if (is_first || sign_of(dot(way, points.exact[i] - points.exact[best])) > 0) best = i;
    }
    return best;
  }

  const Points a_, b_;
  const Number reach_;
  int rounds_left_;
  double greatest_ = 0;
  FewOf<Vector, 4> simplex_;
};

}  // namespace carom

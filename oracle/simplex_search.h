// The distance of a convex set from the origin by its support points, with a proof: a direction
// along which the whole set is at least that far away, and a point of the set that is no further.
// E. G. Gilbert, D. W. Johnson, S. S. Keerthi, A fast procedure for computing the distance between
// complex objects in three-dimensional space, IEEE J. Robotics and Automation 4(2), 1988.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "oracle/vec3.h"

namespace carom::oracle {

// A simplex of up to four points. Finds the point nearest to the origin by trying all corners,
// edges and faces.
template <class R>
class SearchSimplex {
 public:
  using Vec = Vec3<R>;

  void add(const Vec& point) { points_[count_++] = point; }
  bool holds(const Vec& point) const;

  // Returns the nearest point and drops the points that do not span it. The result is zero only if
  // the hull contains the origin.
  Vec reduce();

 private:
  static constexpr size_t kNone = 4;

  void keep(const Vec& point, const std::array<size_t, 3>& corners);

  void try_corner(size_t i) { keep(points_[i], {i, kNone, kNone}); }

  void try_edge(size_t i, size_t j);

  void try_face(size_t i, size_t j, size_t k);

  // Whether the origin is on the inner side of all four faces.
  bool holds_origin() const;

  std::array<Vec, 4> points_;
  size_t count_ = 0;
  R least_{0};
  Vec nearest_;
  std::array<size_t, 3> kept_{};
};

// A proven interval of a distance: at least `lower`, along the unit vector `normal`, and at most
// `upper`.
template <class R>
struct DistanceProof {
  Vec3<R> normal;
  R lower;
  R upper;
};

// `support` gives the support point of the set along a direction. Stops when the bounds are within
// `enough(lower)` of each other, or when rounding prevents progress. `upper` is zero if the set
// contains the origin.
template <class R, class Support, class Enough>
DistanceProof<R> distance_from_origin(const Support& support, const Enough& enough) {
  using Vec = Vec3<R>;
  constexpr int kMostSteps = 60;
  const R infinity = std::numeric_limits<R>::infinity();
  DistanceProof<R> proof{Vec{}, -infinity, infinity};
  SearchSimplex<R> simplex;
  simplex.add(support(Vec{R(1), R(0), R(0)}));
  for (int step = 0; step < kMostSteps; ++step) {
    const Vec nearest = simplex.reduce();
    const R distance = length(nearest);
    if (!(distance < proof.upper)) break;
    proof.upper = distance;
    if (!(distance > 0)) break;
    const Vec normal = nearest * (1 / distance);
    const Vec corner = support(-normal);
    const R lower = dot(corner, normal);
    if (lower > proof.lower) {
      proof.lower = lower;
      proof.normal = normal;
    }
    if (proof.upper - proof.lower <= enough(proof.lower) || simplex.holds(corner)) break;
    simplex.add(corner);
  }
  return proof;
}

}  // namespace carom::oracle

#include "oracle/support_oracle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <vector>

namespace carom::oracle {
namespace {

using Vec = Vec3<long double>;

// A direction, the point of A - B that is furthest along it, and how far.
struct Probe {
  Vec way, point;
  long double height;
};

// Directions between three of them.
struct SphereTriangle {
  std::array<Probe, 3> corner;
  long double least;  // no height in the triangle is less

  explicit SphereTriangle(const std::array<Probe, 3>& corners) : corner(corners) {
    // A direction n of the triangle is sum / |sum| for a weighted mean of the corners; |sum| is at
    // most 1, and at least the distance of the flat triangle.
    const Vec normal = cross(corner[1].way - corner[0].way, corner[2].way - corner[0].way);
    const long double shortest = std::fabs(dot(normal, corner[0].way)) / length(normal);
    least = -HUGE_VALL;
    for (const Probe& probe : corner) {
      long double lowest = HUGE_VALL;
      for (const Probe& other : corner) lowest = std::min(lowest, dot(other.way, probe.point));
      least = std::max(least, lowest < 0 ? lowest / shortest : lowest);
    }
  }

  // The corner opposite the longest side.
  size_t opposite_longest() const {
    const auto side = [this](size_t k) {
      return length(corner[(k + 1) % 3].way - corner[(k + 2) % 3].way);
    };
    const size_t first = side(0) >= side(1) ? 0 : 1;
    return side(first) >= side(2) ? first : 2;
  }
};

bool has_greater_least(const SphereTriangle& a, const SphereTriangle& b) {
  return a.least > b.least;
}

// Finds the direction of least height by halving triangles of the sphere, those with the least
// bound first (branch and bound: A. H. Land, A. G. Doig, "An Automatic Method of Solving Discrete
// Programming Problems", Econometrica 28(3), 1960).
class LeastHeight {
 public:
  LeastHeight(const SupportShape& a, const SupportShape& b) : a_(a), b_(b) {}

  void search(long double tolerance, size_t most_triangles) {
    const std::array<Vec, 6> axes = {Vec{1, 0, 0},  Vec{0, 1, 0},  Vec{0, 0, 1},
                                     Vec{-1, 0, 0}, Vec{0, -1, 0}, Vec{0, 0, -1}};
    std::array<Probe, 6> probes;
    for (size_t i = 0; i < 6; ++i) probes[i] = probe(axes[i]);
    for (size_t octant = 0; octant < 8; ++octant) {
      push({{probes[octant & 1 ? 3 : 0], probes[octant & 2 ? 4 : 1], probes[octant & 4 ? 5 : 2]}});
    }
    for (size_t count = 8; count < most_triangles && !is_done(tolerance); count += 2) halve();
  }

  const Probe& best() const { return best_; }
  long double least() const { return std::min(best_.height, open_.top().least); }

 private:
  Probe probe(const Vec& way) {
    const Vec point = a_.furthest(way) - b_.furthest(-way);
    const Probe found{way, point, dot(way, point)};
    if (found.height < best_.height) best_ = found;
    return found;
  }

  bool is_done(long double tolerance) const {
    return best_.height - open_.top().least <= tolerance;
  }

  void push(const std::array<Probe, 3>& corners) { open_.push(SphereTriangle(corners)); }

  void halve() {
    const SphereTriangle triangle = open_.top();
    open_.pop();
    const size_t k = triangle.opposite_longest();
    const Probe &apex = triangle.corner[k], &from = triangle.corner[(k + 1) % 3],
                &to = triangle.corner[(k + 2) % 3];
    const Probe middle = probe(normalized(from.way + to.way));
    push({apex, from, middle});
    push({apex, middle, to});
  }

  const SupportShape &a_, &b_;
  Probe best_{{}, {}, HUGE_VALL};
  std::priority_queue<SphereTriangle, std::vector<SphereTriangle>, decltype(&has_greater_least)>
      open_{&has_greater_least};
};

}  // namespace

// The separation is the greatest gap of all directions, which is the least height of A - B, with
// the other sign: if the cores are separate the distance (by duality), else the depth.
SeparationBounds separation_by_supports(const SupportShape& a, const SupportShape& b,
                                        long double tolerance, size_t most_triangles) {
  LeastHeight search(a, b);
  search.search(tolerance, most_triangles);
  const long double radii = a.radius + b.radius;
  return {-search.best().height - radii, -search.least() - radii, search.best().way};
}

}  // namespace carom::oracle

// The corners, edges and faces of k-DOPs for the oracle, from the intersections of every three
// planes. Works in any real type. It shares only the slab directions with the library.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "carom/shapes/dop.h"
#include "oracle/vec3.h"

namespace carom::oracle {

// Decides in long double which planes meet in a corner; computes the corner itself in the type R.
template <class R>
class ConvexDop {
 public:
  using Vec = Vec3<R>;

  struct Edge {
    Vec from, to;
  };

  explicit ConvexDop(const Dop& dop);

  const std::vector<Vec>& points() const { return points_; }
  const std::vector<Edge>& edges() const { return edges_; }
  // Every face is a convex polygon.
  const std::vector<std::vector<Vec>>& faces() const { return faces_; }
  const std::vector<Vec>& normals() const { return normals_; }

 private:
  using Wide = long double;
  using WideVec = Vec3<Wide>;

  struct Corner {
    WideVec at;
    std::vector<size_t> planes;
    Vec exact;
  };

  ConvexDop(const Dop& dop, bool widened);

  void find_corners();
  // By doubles, which spare most meetings of planes the long way.
  bool is_clearly_outside(size_t i, size_t j, size_t k) const;

  Wide length_of_limits(size_t i, size_t j, size_t k) const;

  template <class T>
  Vec3<T> meeting(size_t i, size_t j, size_t k) const {
    const auto n = [&](size_t p) {
      return Vec3<T>{T(normal_[p].x), T(normal_[p].y), T(normal_[p].z)};
    };
    const T share = 1 / dot(n(i), cross(n(j), n(k)));
    return (cross(n(j), n(k)) * T(limit_[i]) + cross(n(k), n(i)) * T(limit_[j]) +
            cross(n(i), n(j)) * T(limit_[k])) *
           share;
  }

  bool is_inside(const WideVec& at, Wide size) const;

  void add_corner(const WideVec& at, Wide size, const Vec& exact);

  std::vector<const Corner*> corners_on(std::initializer_list<size_t> planes) const;

  void find_edge(size_t p, size_t q);

  void find_face(size_t p);

  std::vector<WideVec> normal_;
  std::vector<Wide> limit_;
  std::vector<Corner> corners_;
  std::vector<Vec> points_;
  std::vector<Edge> edges_;
  std::vector<std::vector<Vec>> faces_;
  std::vector<Vec> normals_;
};

}  // namespace carom::oracle

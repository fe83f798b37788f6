// A linear program in three unknowns, solved from above: d is a sum of the normals of three planes
// with factors that are not negative, and the same sum of their heights is a bound. As long as the
// point where the three meet lies beyond another plane, that one takes the place of one of them,
// and the bound sinks.
//
// Source: C. E. Lemke, "The dual method of solving the linear programming problem", Naval Research
// Logistics Quarterly 1, 1954.
#include "shapes/dop_reach.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace carom {
namespace {

// The directions of a kind in columns.
struct Directions {
  size_t count = 0;
  std::array<double, kMostSlabs> x{}, y{}, z{};

  explicit Directions(DopKind kind) {
    for (const auto& d : slab_directions(kind)) {
      x[count] = d[0];
      y[count] = d[1];
      z[count++] = d[2];
    }
  }
};

const Directions& directions_of(DopKind kind) {
  static const Directions k6(DopKind::k6), k14(DopKind::k14), k18(DopKind::k18), k26(DopKind::k26);
  switch (kind) {
    case DopKind::k14:
      return k14;
    case DopKind::k18:
      return k18;
    case DopKind::k26:
      return k26;
    default:
      return k6;
  }
}

struct Plane {
  Double3 normal;
  double height;
};

Double3 cross(const Double3& a, const Double3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

class ReachSearch {
 public:
  ReachSearch(const DopSlabs& slabs, const Double3& d)
      : slabs_(slabs),
        directions_(directions_of(slabs.kind)),
        d_(d),
        tolerance_(kInDopPlane * slabs.size()) {
    for (size_t axis = 0; axis < 3; ++axis) base_[axis] = plane(axis, !(d[axis] < 0));
    solve();
  }

  std::optional<double> run() {
    constexpr int kMostSteps = 24;
    for (int step = 0; step < kMostSteps; ++step) {
      const std::optional<Plane> beyond = most_beyond();
      if (!beyond) return bound();
      if (!enter(*beyond)) return std::nullopt;
    }
    return std::nullopt;
  }

 private:
  Plane plane(size_t slab, bool upper) const {
    const double sign = upper ? 1 : -1;
    const Double3 normal = {sign * directions_.x[slab], sign * directions_.y[slab],
                            sign * directions_.z[slab]};
    return {normal, upper ? slabs_.upper[slab] : -slabs_.lower[slab]};
  }

  // Finds the vectors dual to the three normals, and the factors of d. The normals are small
  // integers, so that their products are exact.
  void solve() {
    const Double3 &a = base_[0].normal, &b = base_[1].normal, &c = base_[2].normal;
    dual_ = {cross(b, c), cross(c, a), cross(a, b)};
    const double share = 1 / dot(a, dual_[0]);
    for (size_t i = 0; i < 3; ++i) {
      for (double& x : dual_[i]) x *= share;
      factor_[i] = std::max(dot(dual_[i], d_), 0.0);
    }
  }

  double bound() const {
    return (factor_[0] * base_[0].height + factor_[1] * base_[1].height) +
           factor_[2] * base_[2].height;
  }

  // The plane that the common point of the three lies furthest beyond.
  std::optional<Plane> most_beyond() const {
    Double3 x;
    for (size_t k = 0; k < 3; ++k) {
      x[k] = (base_[0].height * dual_[0][k] + base_[1].height * dual_[1][k]) +
             base_[2].height * dual_[2][k];
    }
    std::array<double, kMostSlabs> above, below;
    for (size_t i = 0; i < directions_.count; ++i) {
      const double height =
          (directions_.x[i] * x[0] + directions_.y[i] * x[1]) + directions_.z[i] * x[2];
      above[i] = height - slabs_.upper[i];
      below[i] = slabs_.lower[i] - height;
    }
    double most = tolerance_;
    size_t slab = kMostSlabs;
    for (size_t i = 0; i < directions_.count; ++i) {
      const double beyond = std::max(above[i], below[i]);
      if (!(beyond > most)) continue;
      most = beyond;
      slab = i;
    }
    if (slab == kMostSlabs) return std::nullopt;
    return plane(slab, above[slab] > below[slab]);
  }

  // Puts the plane in the place of one of the three, so that no factor becomes negative.
  bool enter(const Plane& plane) {
    size_t leaves = 3;
    double least = HUGE_VAL;
    for (size_t i = 0; i < 3; ++i) {
      const double share = dot(dual_[i], plane.normal);
      if (!(share > 0x1p-20)) continue;
      if (factor_[i] / share >= least) continue;
      least = factor_[i] / share;
      leaves = i;
    }
    if (leaves == 3) return false;
    base_[leaves] = plane;
    solve();
    return true;
  }

  const DopSlabs& slabs_;
  const Directions& directions_;
  const Double3 d_;
  const double tolerance_;
  std::array<Plane, 3> base_;
  std::array<Double3, 3> dual_;
  Double3 factor_;
};

}  // namespace

std::optional<double> dop_reach(const DopSlabs& tight, const Double3& d) {
  return ReachSearch(tight, d).run();
}

}  // namespace carom

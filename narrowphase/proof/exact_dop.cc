#include "narrowphase/proof/exact_dop.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace carom {
namespace {

using Rough = VectorOf<double>;
using Exact = VectorOf<Dyadic>;

struct Plane {
  VectorOf<int> normal;
  double height;
};

template <class Number>
Number along(const VectorOf<int>& n, const VectorOf<Number>& x) {
  return (x.x * Number(n.x) + x.y * Number(n.y)) + x.z * Number(n.z);
}

// How far both ends of a slab move outwards: a share of the end itself, and a share of the greatest
// number of the three axis slabs.
struct Widening {
  double of_end = 0;
  double of_size = 0;
};

std::vector<Plane> planes_of(const Dop& dop, const Widening& wider) {
  double size = 0;
  for (size_t i = 0; i < 3; ++i) {
    size = std::max({size, double{std::fabs(dop.lower[i])}, double{std::fabs(dop.upper[i])}});
  }
  const auto widened = [&](double end) {
    return end + (wider.of_end * std::fabs(end) + wider.of_size * size);
  };
  std::vector<Plane> planes;
  for (size_t i = 0; i < slab_count(dop.kind); ++i) {
    const auto& [x, y, z] = slab_directions(dop.kind)[i];
    planes.push_back({{x, y, z}, widened(dop.upper[i])});
    planes.push_back({{-x, -y, -z}, widened(-dop.lower[i])});
  }
  return planes;
}

// The intersection of three planes, times kDopUnit.
template <class Number>
VectorOf<Number> meeting(const Plane& a, const Plane& b, const Plane& c, int volume) {
  const auto part = [volume](const Plane& of, const VectorOf<int>& n) -> VectorOf<Number> {
    const int scale = kDopUnit / volume;
    const Number height(of.height);
    return {height * Number(n.x * scale), height * Number(n.y * scale),
            height * Number(n.z * scale)};
  };
  return (part(a, cross(b.normal, c.normal)) + part(b, cross(c.normal, a.normal))) +
         part(c, cross(a.normal, b.normal));
}

// Finds the corners. Doubles rule out most intersections; exact numbers decide the rest.
class CornerSearch {
 public:
  explicit CornerSearch(std::vector<Plane> planes) : planes_(std::move(planes)) {
    for (const Plane& plane : planes_) size_ = std::max(size_, std::fabs(plane.height));
    for (size_t i = 0; i < planes_.size(); ++i) {
      for (size_t j = 0; j < i; ++j) {
        for (size_t k = 0; k < j; ++k) try_meeting(planes_[i], planes_[j], planes_[k]);
      }
    }
  }

  const std::vector<Exact>& corners() const { return corners_; }

 private:
  void try_meeting(const Plane& a, const Plane& b, const Plane& c) {
    const VectorOf<int> bc = cross(b.normal, c.normal);
    const int volume = dot(a.normal, bc);
    if (volume == 0) return;
    const Rough rough = meeting<double>(a, b, c, volume);
    if (!may_be_inside(rough)) return;
    const Exact exact = meeting<Dyadic>(a, b, c, volume);
    if (is_known(rough, exact) || !is_inside(rough, exact)) return;
    rough_.push_back(rough);
    corners_.push_back(exact);
  }

  double doubt() const { return size_ * 0x1p-40; }

  bool may_be_inside(const Rough& x) const {
    return std::all_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
      return along(plane.normal, x) <= kDopUnit * plane.height + doubt();
    });
  }

  bool is_inside(const Rough& rough, const Exact& x) const {
    return std::all_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
      if (along(plane.normal, rough) < kDopUnit * plane.height - doubt()) return true;
      return sign_of(along(plane.normal, x) - Dyadic(plane.height) * Dyadic(kDopUnit)) <= 0;
    });
  }

  bool is_known(const Rough& rough, const Exact& x) const {
    for (size_t i = 0; i < corners_.size(); ++i) {
      const Rough way = rough - rough_[i];
      if (std::fabs(way.x) + std::fabs(way.y) + std::fabs(way.z) > doubt()) continue;
      const Exact exact_way = x - corners_[i];
      if (exact_way.x.is_zero() && exact_way.y.is_zero() && exact_way.z.is_zero()) return true;
    }
    return false;
  }

  std::vector<Plane> planes_;
  double size_ = 0;
  std::vector<Rough> rough_;
  std::vector<Exact> corners_;
};

}  // namespace

std::vector<VectorOf<Dyadic>> exact_corners(const Dop& dop) {
  constexpr double kHalfUnit = 0x1p-24;
  std::vector<Exact> corners;
  for (const Widening wider :
       {Widening{}, Widening{.of_end = kHalfUnit}, Widening{.of_size = kHalfUnit}}) {
    corners = CornerSearch(planes_of(dop, wider)).corners();
    if (!corners.empty()) break;
  }
  return corners;
}

}  // namespace carom

// Definitions of the templates in convex_dop.h, for the files that say for which numbers they are
// compiled.
#pragma once

#include "oracle/convex_dop.h"

namespace carom::oracle {

template <class R>
ConvexDop<R>::ConvexDop(const Dop& dop) : ConvexDop(dop, false) {
  // Rounding of the slabs may leave the solid empty. Then widen each slab by half a unit in the
  // last place.
  if (points_.empty()) *this = ConvexDop(dop, true);
}

template <class R>
ConvexDop<R>::ConvexDop(const Dop& dop, bool widened) {
  for (size_t i = 0; i < slab_count(dop.kind); ++i) {
    const auto& d = slab_directions(dop.kind)[i];
    const Wide wider = widened ? 0x1p-24L : 0;
    const Wide upper = dop.upper[i] + wider * std::fabs(Wide{dop.upper[i]});
    const Wide lower = dop.lower[i] - wider * std::fabs(Wide{dop.lower[i]});
    normal_.push_back({Wide(d[0]), Wide(d[1]), Wide(d[2])});
    limit_.push_back(upper);
    normal_.push_back(-normal_.back());
    limit_.push_back(-lower);
    normals_.push_back(normalized(Vec{R(d[0]), R(d[1]), R(d[2])}));
  }
  find_corners();
  if (corners_.empty()) return;
  for (const Corner& corner : corners_) points_.push_back(corner.exact);
  for (size_t p = 0; p < normal_.size(); ++p) {
    find_face(p);
    for (size_t q = 0; q < p; ++q) find_edge(p, q);
  }
}

template <class R>
void ConvexDop<R>::find_corners() {
  for (size_t i = 0; i < normal_.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      for (size_t k = 0; k < j; ++k) {
        const Wide det = dot(normal_[i], cross(normal_[j], normal_[k]));
        if (det == 0 || is_clearly_outside(i, j, k)) continue;
        const WideVec at = meeting<Wide>(i, j, k);
        const Wide size = length(at) + length_of_limits(i, j, k);
        if (is_inside(at, size)) add_corner(at, size, meeting<R>(i, j, k));
      }
    }
  }
}

template <class R>
bool ConvexDop<R>::is_clearly_outside(size_t i, size_t j, size_t k) const {
  constexpr double kRounding = 1e-9;  // a million times that of doubles
  const auto at = meeting<double>(i, j, k);
  const double size = std::fabs(at.x) + std::fabs(at.y) + std::fabs(at.z) +
                      static_cast<double>(length_of_limits(i, j, k));
  for (size_t p = 0; p < normal_.size(); ++p) {
    const auto& [x, y, z] = normal_[p];
    const double height = static_cast<double>(x) * at.x + static_cast<double>(y) * at.y +
                          static_cast<double>(z) * at.z;
    const auto limit = static_cast<double>(limit_[p]);
    if (height - limit > kRounding * (size + std::fabs(limit))) return true;
  }
  return false;
}

template <class R>
long double ConvexDop<R>::length_of_limits(size_t i, size_t j, size_t k) const {
  return std::fabs(limit_[i]) + std::fabs(limit_[j]) + std::fabs(limit_[k]);
}

template <class R>
bool ConvexDop<R>::is_inside(const WideVec& at, Wide size) const {
  for (size_t p = 0; p < normal_.size(); ++p) {
    if (dot(normal_[p], at) > limit_[p] + size * 0x1p-55L) return false;
  }
  return true;
}

template <class R>
void ConvexDop<R>::add_corner(const WideVec& at, Wide size, const Vec& exact) {
  for (const Corner& known : corners_) {
    if (length(known.at - at) <= size * 0x1p-50L) return;
  }
  Corner corner{at, {}, exact};
  for (size_t p = 0; p < normal_.size(); ++p) {
    if (dot(normal_[p], at) >= limit_[p] - size * 0x1p-50L) corner.planes.push_back(p);
  }
  corners_.push_back(corner);
}

template <class R>
std::vector<const typename ConvexDop<R>::Corner*> ConvexDop<R>::corners_on(
    std::initializer_list<size_t> planes) const {
  std::vector<const Corner*> found;
  for (const Corner& corner : corners_) {
    const bool is_on = std::all_of(planes.begin(), planes.end(), [&](size_t p) {
      return std::find(corner.planes.begin(), corner.planes.end(), p) != corner.planes.end();
    });
    if (is_on) found.push_back(&corner);
  }
  return found;
}

template <class R>
void ConvexDop<R>::find_edge(size_t p, size_t q) {
  const WideVec way = cross(normal_[p], normal_[q]);
  if (dot(way, way) == 0) return;
  const auto on = corners_on({p, q});
  if (on.size() < 2) return;
  const auto [first, last] = std::minmax_element(
      on.begin(), on.end(),
      [&](const Corner* a, const Corner* b) { return dot(a->at, way) < dot(b->at, way); });
  edges_.push_back({(*first)->exact, (*last)->exact});
}

template <class R>
void ConvexDop<R>::find_face(size_t p) {
  auto on = corners_on({p});
  if (on.size() < 3) return;
  WideVec middle;
  for (const Corner* corner : on) middle = middle + corner->at * (1 / Wide(on.size()));
  const WideVec u = normalized(on[0]->at - middle);
  const WideVec v = cross(normalized(normal_[p]), u);
  const auto angle = [&](const Corner* corner) {
    const WideVec r = corner->at - middle;
    return std::atan2(dot(r, v), dot(r, u));
  };
  std::sort(on.begin(), on.end(),
            [&](const Corner* a, const Corner* b) { return angle(a) < angle(b); });
  std::vector<Vec> face;
  for (const Corner* corner : on) face.push_back(corner->exact);
  faces_.push_back(face);
}

}  // namespace carom::oracle

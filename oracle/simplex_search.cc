#include "oracle/simplex_search.h"

namespace carom::oracle {

template <class R>
bool SearchSimplex<R>::holds(const Vec& point) const {
  for (size_t i = 0; i < count_; ++i) {
    const Vec d = points_[i] - point;
    if (d.x == 0 && d.y == 0 && d.z == 0) return true;
  }
  return false;
}

template <class R>
Vec3<R> SearchSimplex<R>::reduce() {
  least_ = std::numeric_limits<R>::infinity();
  for (size_t i = 0; i < count_; ++i) try_corner(i);
  for (size_t i = 0; i < count_; ++i) {
    for (size_t j = i + 1; j < count_; ++j) try_edge(i, j);
  }
  for (size_t i = 0; i < count_; ++i) {
    for (size_t j = i + 1; j < count_; ++j) {
      for (size_t k = j + 1; k < count_; ++k) try_face(i, j, k);
    }
  }
  if (count_ == 4 && holds_origin()) return {};
  const std::array<Vec, 4> before = points_;
  count_ = 0;
  for (const size_t i : kept_) {
    if (i < before.size()) points_[count_++] = before[i];
  }
  return nearest_;
}

template <class R>
void SearchSimplex<R>::keep(const Vec& point, const std::array<size_t, 3>& corners) {
  const R squared = dot(point, point);
  if (!(squared < least_)) return;
  least_ = squared;
  nearest_ = point;
  kept_ = corners;
}

template <class R>
void SearchSimplex<R>::try_edge(size_t i, size_t j) {
  const Vec way = points_[j] - points_[i];
  const R squared = dot(way, way);
  const R along = -dot(points_[i], way);
  if (!(along > 0 && along < squared)) return;
  const Vec unit = normalized(way);
  keep(across(across(points_[i], unit), unit), {i, j, kNone});
}

template <class R>
void SearchSimplex<R>::try_face(size_t i, size_t j, size_t k) {
  const Vec &a = points_[i], &b = points_[j], &c = points_[k];
  const Vec normal = normalized(cross(b - a, c - a));
  if (!(dot(normal, normal) > 0)) return;
  const bool is_over =
      dot(cross(a, b), normal) > 0 && dot(cross(b, c), normal) > 0 && dot(cross(c, a), normal) > 0;
  if (is_over) keep(normal * dot(a, normal), {i, j, k});
}

template <class R>
bool SearchSimplex<R>::holds_origin() const {
  for (size_t i = 0; i < 4; ++i) {
    const Vec& a = points_[(i + 1) % 4];
    const Vec normal = cross(points_[(i + 2) % 4] - a, points_[(i + 3) % 4] - a);
    const R inside = dot(points_[i] - a, normal), origin = -dot(a, normal);
    if (!((inside > 0 && origin >= 0) || (inside < 0 && origin <= 0))) return false;
  }
  return true;
}

// The real types that are used.
template class SearchSimplex<double>;
template class SearchSimplex<long double>;
}  // namespace carom::oracle

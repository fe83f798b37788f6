#include "oracle/hull_faces.h"

namespace carom::oracle {

HullFaces::HullFaces(std::span<const Eigen::Vector3f> points) : points_(points) {
  const std::vector<uint32_t> all = distinct();
  const Outline plane = find_plane(all);
  if (plane.size() < 3) {
    dimension_ = static_cast<int>(plane.size()) - 1;
    corners_ = plane;
    return;
  }
  dimension_ = is_flat(all, plane) ? 2 : 3;
  if (dimension_ == 2) {
    faces_ = {outline(all, plane)};
    faces_.push_back({faces_[0].rbegin(), faces_[0].rend()});
  } else {
    find_faces(all);
  }
  for (const Outline& face : faces_) corners_.insert(corners_.end(), face.begin(), face.end());
  std::sort(corners_.begin(), corners_.end());
  corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
}

std::vector<uint32_t> HullFaces::distinct() const {
  std::vector<uint32_t> all;
  for (uint32_t i = 0; i < points_.size(); ++i) all.push_back(i);
  std::sort(all.begin(), all.end(), [&](uint32_t i, uint32_t j) {
    const Eigen::Vector3f &p = points_[i], &q = points_[j];
    return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
  });
  const auto same = [&](uint32_t i, uint32_t j) { return points_[i] == points_[j]; };
  all.erase(std::unique(all.begin(), all.end(), same), all.end());
  return all;
}

std::vector<uint32_t> HullFaces::find_plane(const std::vector<uint32_t>& all) const {
  if (all.size() == 1) return all;
  for (const uint32_t i : all) {
    if (!are_collinear(all[0], all[1], i)) return {all[0], all[1], i};
  }
  return {all.front(), all.back()};
}

bool HullFaces::is_flat(const std::vector<uint32_t>& all, const Outline& plane) const {
  const Plane through(*this, {plane[0], plane[1], plane[2]});
  return std::all_of(all.begin(), all.end(), [&](uint32_t i) { return through.side(i) == 0; });
}

void HullFaces::find_faces(const std::vector<uint32_t>& all) {
  std::vector<std::vector<uint32_t>> known;
  for (size_t i = 0; i < all.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      for (size_t k = 0; k < j; ++k) {
        const auto [on, front, back] = sides(all, {all[i], all[j], all[k]});
        if (front == back) continue;  // the three are collinear, so no point is off their plane
        if (std::find(known.begin(), known.end(), on) != known.end()) continue;
        known.push_back(on);
        faces_.push_back(
            outline(on, front ? Outline{all[j], all[i], all[k]} : Outline{all[i], all[j], all[k]}));
      }
    }
  }
}

HullFaces::Sides HullFaces::sides(const std::vector<uint32_t>& all,
                                  const std::array<uint32_t, 3>& plane) const {
  const Plane through(*this, plane);
  Sides found;
  for (const uint32_t i : all) {
    const int where = through.side(i);
    if (where == 0) found.on.push_back(i);
    found.front = found.front || where > 0;
    found.back = found.back || where < 0;
    if (found.front && found.back) break;
  }
  return found;
}

std::vector<uint32_t> HullFaces::outline(std::vector<uint32_t> on, const Outline& plane) const {
  int axis = 0;
  while (turn(plane[0], plane[1], plane[2], axis) == 0) ++axis;
  const bool looks_up = turn(plane[0], plane[1], plane[2], axis) > 0;
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::sort(on.begin(), on.end(), [&](uint32_t i, uint32_t j) {
    const Eigen::Vector3f &p = points_[i], &q = points_[j];
    return p[u] < q[u] || (p[u] == q[u] && p[v] < q[v]);
  });
  Outline corners = chain(on, axis);
  std::reverse(on.begin(), on.end());
  const Outline other = chain(on, axis);
  corners.insert(corners.end(), other.begin(), other.end());
  if (!looks_up) std::reverse(corners.begin(), corners.end());
  return corners;
}

std::vector<uint32_t> HullFaces::chain(const std::vector<uint32_t>& on, int axis) const {
  Outline half;
  for (const uint32_t i : on) {
    while (half.size() > 1 && turn(half[half.size() - 2], half.back(), i, axis) <= 0) {
      half.pop_back();
    }
    half.push_back(i);
  }
  half.pop_back();
  return half;
}

bool HullFaces::are_collinear(uint32_t i, uint32_t j, uint32_t k) const {
  return turn(i, j, k, 0) == 0 && turn(i, j, k, 1) == 0 && turn(i, j, k, 2) == 0;
}

int HullFaces::turn(uint32_t i, uint32_t j, uint32_t k, int axis) const {
  const size_t u = static_cast<size_t>(axis + 1) % 3, v = static_cast<size_t>(axis + 2) % 3;
  const auto p = way<long double>(i, j), q = way<long double>(i, k);
  const long double one = p[u] * q[v], other = p[v] * q[u];
  const long double size = std::fabs(one) + std::fabs(other);
  if (std::fabs(one - other) > kRounding * size) return one > other ? 1 : -1;
  if (size == 0) return 0;
  const auto a = way<Dyadic>(i, j), b = way<Dyadic>(i, k);
  return sign_of(a[u] * b[v] - a[v] * b[u]);
}

HullFaces::Plane::Plane(const HullFaces& hull, const std::array<uint32_t, 3>& corners)
    : hull_(hull), corners_(corners) {
  const auto a = hull.way<long double>(corners[0], corners[1]);
  const auto b = hull.way<long double>(corners[0], corners[2]);
  for (size_t u = 0; u < 3; ++u) {
    const size_t v = (u + 1) % 3, w = (u + 2) % 3;
    const long double one = a[v] * b[w], other = a[w] * b[v];
    normal_[u] = one - other;
    size_[u] = std::fabs(one) + std::fabs(other);
  }
}

int HullFaces::Plane::side(uint32_t i) const {
  const auto way = hull_.way<long double>(corners_[0], i);
  long double sum = 0, size = 0;
  for (size_t u = 0; u < 3; ++u) {
    sum += normal_[u] * way[u];
    size += size_[u] * std::fabs(way[u]);
  }
  if (std::fabs(sum) > kRounding * size) return sum > 0 ? 1 : -1;
  if (size == 0 || i == corners_[1] || i == corners_[2]) return 0;
  return exact_side(hull_.way<Dyadic>(corners_[0], corners_[1]),
                    hull_.way<Dyadic>(corners_[0], corners_[2]), hull_.way<Dyadic>(corners_[0], i));
}

int HullFaces::Plane::exact_side(const Triple<Dyadic>& a, const Triple<Dyadic>& b,
                                 const Triple<Dyadic>& way) {
  Dyadic sum;
  for (size_t u = 0; u < 3; ++u) {
    const size_t v = (u + 1) % 3, w = (u + 2) % 3;
    sum = sum + (a[v] * b[w] - a[w] * b[v]) * way[u];
  }
  return sign_of(sum);
}

Hull hull_of(const std::vector<Eigen::Vector3f>& points) {
  return {*make_hull(points, HullFaces(points).faces())};
}

}  // namespace carom::oracle

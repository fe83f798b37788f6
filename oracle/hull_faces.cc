#include "oracle/hull_faces.h"

#include <functional>

namespace carom::oracle {
namespace {

// The faces of hulls that were seen lately: the oracle meets most hulls several times, when a pair
// is placed and in each of its number types.
class KnownFaces {
 public:
  using Geometry = std::shared_ptr<const HullGeometry>;
  using Faces = std::shared_ptr<const HullFaces>;

  static KnownFaces& of_this_thread() {
    thread_local KnownFaces known;
    return known;
  }

  Faces find(const Geometry& geometry) {
    const Entry& entry = place_of(geometry);
    const bool is_it =
        !entry.geometry.owner_before(geometry) && !geometry.owner_before(entry.geometry);
    return is_it ? entry.faces : nullptr;
  }

  void remember(const Geometry& geometry, const Faces& faces) {
    place_of(geometry) = {geometry, faces};
  }

 private:
  struct Entry {
    std::weak_ptr<const HullGeometry> geometry;  // keeps its address from being used again
    Faces faces;
  };

  Entry& place_of(const Geometry& geometry) {
    return entries_[std::hash<Geometry>{}(geometry) / 64 % entries_.size()];
  }

  std::array<Entry, 1024> entries_;
};

}  // namespace

HullFaces::HullFaces(std::span<const Eigen::Vector3f> points) : points_(points) {
  find();
  points_ = {};  // the faces may outlive the points
}

void HullFaces::find() {
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
  Sides found;
  for (size_t i = 0; i < all.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      for (size_t k = 0; k < j; ++k) {
        find_sides(all, {all[i], all[j], all[k]}, found);
        // No face; or the three are collinear, so that no point is off their plane.
        if (found.front == found.back) continue;
        if (std::find(known.begin(), known.end(), found.on) != known.end()) continue;
        known.push_back(found.on);
        faces_.push_back(outline(found.on, found.front ? Outline{all[j], all[i], all[k]}
                                                       : Outline{all[i], all[j], all[k]}));
      }
    }
  }
}

void HullFaces::find_sides(const std::vector<uint32_t>& all, const std::array<uint32_t, 3>& plane,
                           Sides& found) const {
  const Plane through(*this, plane);
  found.on.clear();
  found.front = found.back = through.side(found.last_front) * through.side(found.last_back) < 0;
  if (found.front) return;
  for (const uint32_t i : all) {
    const int where = through.side(i);
    if (where == 0) found.on.push_back(i);
    if (where > 0) found.last_front = i;
    if (where < 0) found.last_back = i;
    found.front = found.front || where > 0;
    found.back = found.back || where < 0;
    if (found.front && found.back) break;
  }
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
  const auto p = way<double>(i, j), q = way<double>(i, k);
  const double one = p[u] * q[v], other = p[v] * q[u];
  const double size = std::fabs(one) + std::fabs(other);
  if (std::fabs(one - other) > kRounding * size) return one > other ? 1 : -1;
  if (size == 0) return 0;
  const auto a = way<Dyadic>(i, j), b = way<Dyadic>(i, k);
  return sign_of(a[u] * b[v] - a[v] * b[u]);
}

HullFaces::Plane::Plane(const HullFaces& hull, const std::array<uint32_t, 3>& corners)
    : hull_(hull), corners_(corners) {
  const Eigen::Vector3f& p = hull.points_[corners[0]];
  origin_ = {double{p.x()}, double{p.y()}, double{p.z()}};
  const auto a = hull.way<double>(corners[0], corners[1]);
  const auto b = hull.way<double>(corners[0], corners[2]);
  for (size_t u = 0; u < 3; ++u) {
    const size_t v = (u + 1) % 3, w = (u + 2) % 3;
    const double one = a[v] * b[w], other = a[w] * b[v];
    normal_[u] = one - other;
    size_[u] = std::fabs(one) + std::fabs(other);
  }
}

// The three products are written out: g++ would store the differences one by one and load two at a
// time, which waits for the stores.
int HullFaces::Plane::side(uint32_t i) const {
  if (i == corners_[0] || i == corners_[1] || i == corners_[2]) return 0;
  const Eigen::Vector3f& p = hull_.points_[i];
  const double x = p.x() - origin_[0], y = p.y() - origin_[1], z = p.z() - origin_[2];
  const double sum = normal_[0] * x + normal_[1] * y + normal_[2] * z;
  const double size = size_[0] * std::fabs(x) + size_[1] * std::fabs(y) + size_[2] * std::fabs(z);
  if (std::fabs(sum) > kRounding * size) return sum > 0 ? 1 : -1;
  return size == 0 ? 0 : exact_side(i);
}

[[gnu::noinline]] int HullFaces::Plane::exact_side(uint32_t i) const {
  const auto a = hull_.way<Dyadic>(corners_[0], corners_[1]);
  const auto b = hull_.way<Dyadic>(corners_[0], corners_[2]);
  const auto way = hull_.way<Dyadic>(corners_[0], i);
  Dyadic sum;
  for (size_t u = 0; u < 3; ++u) {
    const size_t v = (u + 1) % 3, w = (u + 2) % 3;
    sum = sum + (a[v] * b[w] - a[w] * b[v]) * way[u];
  }
  return sign_of(sum);
}

Hull hull_of(const std::vector<Eigen::Vector3f>& points) {
  const auto faces = std::make_shared<const HullFaces>(points);
  Hull hull{*make_hull(points, faces->faces())};
  KnownFaces::of_this_thread().remember(hull.geometry, faces);
  return hull;
}

std::shared_ptr<const HullFaces> faces_of(const std::shared_ptr<const HullGeometry>& geometry) {
  KnownFaces& known = KnownFaces::of_this_thread();
  std::shared_ptr<const HullFaces> faces = known.find(geometry);
  if (!faces) {
    faces = std::make_shared<const HullFaces>(geometry->points());
    known.remember(geometry, faces);
  }
  return faces;
}

}  // namespace carom::oracle

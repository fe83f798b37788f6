#include "hulls/merge_facets.h"

#include <algorithm>
#include <numeric>

#include "hulls/outline.h"

namespace carom::hulls {
namespace {

using Eigen::Vector3d;

// Points count as coplanar within kSlack times the rounding of one point, because the plane itself
// goes through rounded points, and never beyond kMostDistance.
constexpr double kSlack = 8;
constexpr double kMostDistance = 1e-4;

class FacetMerger {
 public:
  FacetMerger(std::span<const Vector3d> points, const std::vector<Facet>& facets,
              const Vector3d& rounding)
      : points_(points), facets_(facets), rounding_(rounding), is_merged_(facets.size(), false) {
    for (const Facet& facet : facets) {
      outlines_.push_back(outline(points, facet.vertices, facet.normal));
    }
  }

  HullFaces merge() {
    HullFaces result;
    result.is_corner.assign(points_.size(), false);
    for (const std::vector<uint32_t>& polygon : outlines_) {
      if (polygon.size() < 3) continue;
      for (const uint32_t corner : polygon) result.is_corner[corner] = true;
    }
    for (const uint32_t facet : largest_first()) {
      if (is_merged_[facet]) continue;
      std::vector<uint32_t> face = outline(points_, plane_of(facet), facets_[facet].normal);
      if (face.size() >= 3) result.faces.push_back(std::move(face));
    }
    return result;
  }

 private:
  std::vector<uint32_t> largest_first() const {
    std::vector<double> area;
    for (const std::vector<uint32_t>& polygon : outlines_) {
      area.push_back(area_vector(points_, polygon).squaredNorm());
    }
    std::vector<uint32_t> order(facets_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t i, uint32_t j) { return area[i] > area[j]; });
    return order;
  }

  // The corners, each once, of `seed` and all connected facets that lie in its plane.
  std::vector<uint32_t> plane_of(uint32_t seed) {
    const Vector3d& normal = facets_[seed].normal;
    const Vector3d& origin = points_[facets_[seed].vertices.front()];
    const double most = std::min(kSlack * normal.cwiseAbs().dot(rounding_), kMostDistance);
    const auto is_in_plane = [&](uint32_t facet) {
      const std::vector<uint32_t>& vertices = facets_[facet].vertices;
      return facets_[facet].normal.dot(normal) > 0 &&
             std::all_of(vertices.begin(), vertices.end(), [&](uint32_t i) {
               return std::abs(normal.dot(points_[i] - origin)) <= most;
             });
    };
    std::vector<uint32_t> corners;
    std::vector<uint32_t> found = {seed};
    is_merged_[seed] = true;
    for (size_t next = 0; next < found.size(); ++next) {
      const Facet& facet = facets_[found[next]];
      corners.insert(corners.end(), facet.vertices.begin(), facet.vertices.end());
      for (const uint32_t neighbor : facet.neighbors) {
        if (is_merged_[neighbor] || !is_in_plane(neighbor)) continue;
        is_merged_[neighbor] = true;
        found.push_back(neighbor);
      }
    }
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    return corners;
  }

  std::span<const Vector3d> points_;
  const std::vector<Facet>& facets_;
  Vector3d rounding_;
  std::vector<bool> is_merged_;
  std::vector<std::vector<uint32_t>> outlines_;
};

}  // namespace

HullFaces merge_facets(std::span<const Vector3d> points, const std::vector<Facet>& facets,
                       const Vector3d& rounding) {
  return FacetMerger(points, facets, rounding).merge();
}

}  // namespace carom::hulls

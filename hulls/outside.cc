#include "hulls/outside.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "hulls/facets.h"

namespace carom::hulls {
namespace {

using Eigen::Vector3d;

// Facets of points with volume; thicker ones may hide corners.
constexpr double kMostThickness = 1e-9;

// Cuts that gain less than this end the search.
constexpr double kLeastGain = 1e-7;

struct Plane {
  Vector3d normal;  // unit, outwards
  double offset;    // normal . x <= offset, x relative to the middle
};

Vector3d middle_of(std::span<const Vector3d> points) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

double reach(std::span<const Vector3d> points, const Vector3d& normal) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Vector3d& p : points) most = std::max(most, normal.dot(p));
  return most;
}

// The corners of the intersection of half-spaces around 0. A plane's dual is normal / offset; the
// facets of the hull of the duals are the duals of the corners. Nothing if it is not bounded.
std::optional<Corners> corners_of(const std::vector<Plane>& planes) {
  std::vector<Vector3d> duals;
  for (const Plane& plane : planes) {
    if (!(plane.offset > 0)) return std::nullopt;
    duals.push_back(plane.normal / plane.offset);
  }
  const std::optional<Facets> facets = find_facets(duals, false);
  if (!facets) return std::nullopt;
  Corners corners;
  for (const Facet& facet : facets->list) {
    double offset = 0;
    for (const uint32_t i : facet.vertices) offset += facet.normal.dot(duals[i]);
    offset /= static_cast<double>(facet.vertices.size());
    if (!(offset > 0)) return std::nullopt;
    corners.push_back(facet.normal / offset);
  }
  return corners;
}

// The directions of the planes to start with: of the box, and of four tetrahedra.
std::vector<std::vector<Vector3d>> starts() {
  std::vector<std::vector<Vector3d>> all(1);
  for (int axis = 0; axis < 3; ++axis) {
    all[0].push_back(Vector3d::Unit(axis));
    all[0].push_back(-Vector3d::Unit(axis));
  }
  for (const double side : {1.0, -1.0}) {
    all.push_back({Vector3d(side, side, side), Vector3d(side, -side, -side),
                   Vector3d(-side, side, -side), Vector3d(-side, -side, side)});
    all.push_back({Vector3d(-side, 0, 0), Vector3d(0, -side, 0), Vector3d(0, 0, -side),
                   Vector3d(side, side, side)});
  }
  return all;
}

struct Cut {
  Corners corners;  // relative to the middle
  double error = std::numeric_limits<double>::infinity();
};

class Cutter {
 public:
  Cutter(std::span<const Vector3d> inner, const Surface& surface, size_t most, double margin)
      : inner_(inner), middle_(middle_of(inner)), surface_(surface), most_(most), margin_(margin) {}

  // Cuts off the furthest corner while that leaves at most `most` of them.
  Cut cut(const std::vector<Vector3d>& directions) const {
    Cut best;
    std::vector<Plane> planes;
    planes.reserve(directions.size() + 2 * most_);
    for (const Vector3d& direction : directions) planes.push_back(touching(direction.normalized()));
    for (size_t round = 0; round < 2 * most_; ++round) {
      std::optional<Corners> corners = corners_of(planes);
      if (!corners || corners->size() > most_) return best;
      const auto [error, direction] = furthest(*corners);
      if (error >= best.error - kLeastGain) return best;
      best = {std::move(*corners), error};
      planes.push_back(touching(direction));
    }
    return best;
  }
  const Vector3d& middle() const { return middle_; }

 private:
  Plane touching(const Vector3d& normal) const {
    return {normal, reach(inner_, normal) - normal.dot(middle_) + margin_};
  }

  // The distance of the furthest corner, and the direction to it.
  std::pair<double, Vector3d> furthest(const Corners& corners) const {
    std::pair<double, Vector3d> found = {0, Vector3d::UnitX()};
    for (const Vector3d& corner : corners) {
      const Vector3d way = corner + middle_ - surface_.nearest(corner + middle_);
      if (way.norm() > found.first) found = {way.norm(), way.normalized()};
    }
    return found;
  }

  std::span<const Vector3d> inner_;
  Vector3d middle_;
  const Surface& surface_;
  size_t most_;
  double margin_;
};

}  // namespace

std::optional<Corners> scaled_around(const Corners& corners, std::span<const Vector3d> inner,
                                     double margin) {
  const std::optional<Facets> facets = find_facets(corners, false);
  if (!facets || facets->thickness > kMostThickness) return std::nullopt;
  const Vector3d middle = middle_of(inner);
  double factor = 0;
  for (const Facet& facet : facets->list) {
    // A facet goes through its lowest vertex.
    double offset = std::numeric_limits<double>::infinity();
    for (const uint32_t i : facet.vertices) offset = std::min(offset, facet.normal.dot(corners[i]));
    offset -= facet.normal.dot(middle);
    if (!(offset > 0)) return std::nullopt;
    const double wanted = reach(inner, facet.normal) - facet.normal.dot(middle) + margin;
    factor = std::max(factor, wanted / offset);
  }
  Corners scaled;
  for (const Vector3d& corner : corners) scaled.push_back(middle + factor * (corner - middle));
  return scaled;
}

std::optional<Corners> cut_around(std::span<const Vector3d> inner, const Surface& surface,
                                  size_t most, double margin) {
  const Cutter cutter(inner, surface, most, margin);
  Cut best;
  for (const std::vector<Vector3d>& directions : starts()) {
    Cut cut = cutter.cut(directions);
    if (cut.error < best.error) best = std::move(cut);
  }
  if (best.corners.empty()) return std::nullopt;
  for (Vector3d& corner : best.corners) corner += cutter.middle();
  return scaled_around(best.corners, inner, margin);
}

}  // namespace carom::hulls

#include "carom/shapes/hull.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "base/float_environment.h"
#include "shapes/dop_solid.h"
#include "shapes/hull_features.h"

namespace carom {
namespace {

std::shared_ptr<const float> columns_of(std::span<const Eigen::Vector3f> points) {
  const size_t padded = padded_count(points.size());
  std::shared_ptr<float[]> columns(new float[3 * padded]);
  for (size_t i = 0; i < padded; ++i) {
    const Eigen::Vector3f& point = points[i < points.size() ? i : 0];
    for (int axis = 0; axis < 3; ++axis) columns[axis * padded + i] = point[axis];
  }
  return {columns, columns.get()};
}

std::vector<std::array<float, 4>> records_of(std::span<const Eigen::Vector3f> points,
                                             const Eigen::Vector3f& middle) {
  std::vector<std::array<float, 4>> records;
  records.reserve(points.size() + 1);
  for (const Eigen::Vector3f& p : points) records.push_back({p.x(), p.y(), p.z(), 0});
  records.push_back({middle.x(), middle.y(), middle.z(), 0});
  return records;
}

Eigen::Vector3d mean_of(std::span<const Eigen::Vector3f> points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& point : points) sum += point.cast<double>();
  return sum / static_cast<double>(points.size());
}

// The normals of planes, as numbered by common_plane().
std::vector<Eigen::Vector3d> normals_of_planes(std::span<const uint8_t> planes) {
  std::vector<Eigen::Vector3d> normals;
  for (const uint8_t plane : planes) normals.push_back(normal_of_dop_plane(plane));
  return normals;
}

// The edges between planes, as numbered by common_plane(); nothing if there are too many, or if an
// edge has no direction.
std::optional<std::vector<DopSolid::Edge>> edges_between(std::span<const HullEdge> edges,
                                                         std::span<const uint8_t> planes) {
  if (edges.size() > DopSolid::kMostEdges) return std::nullopt;
  std::vector<DopSolid::Edge> between;
  for (const HullEdge& edge : edges) {
    between.push_back({edge.from, planes[edge.left], planes[edge.right]});
    const auto& [from, left, right] = between.back();
    if (DopDirections::get().edge(left, right).isZero(0)) return std::nullopt;
  }
  return between;
}

// Rounded up.
float radius_about(const Eigen::Vector3f& middle, std::span<const Eigen::Vector3f> points) {
  double radius = 0;
  for (const Eigen::Vector3f& point : points) {
    radius = std::max(radius, (point.cast<double>() - middle.cast<double>()).norm());
  }
  radius *= 1 + 0x1p-20;
  return radius <= double{FLT_MAX} ? static_cast<float>(radius) : HUGE_VALF;
}

}  // namespace

struct HullBuilder {
  // All but the features.
  static Result<void> build(std::span<const Eigen::Vector3f> points,
                            std::span<const std::vector<uint32_t>> faces, HullGeometry& hull) {
    if (points.empty()) return Error{"a hull without points"};
    for (size_t i = 0; i < points.size(); ++i) {
      if (!points[i].allFinite()) {
        return Error{"point " + std::to_string(i) + " of the hull is not finite"};
      }
      hull.size_ = std::max(hull.size_, points[i].cwiseAbs().maxCoeff());
    }
    hull.points_.assign(points.begin(), points.end());
    hull.columns_ = columns_of(points);
    hull.column_stride_ = static_cast<uint32_t>(padded_count(points.size()));
    hull.middle_ = mean_of(points);
    const Eigen::Vector3f middle = hull.middle_.cast<float>();
    hull.records_ = records_of(points, middle);
    hull.balls_.outer = {middle.x(), middle.y(), middle.z(), radius_about(middle, points)};
    for (size_t i = 0; i < faces.size(); ++i) {
      const std::vector<uint32_t>& face = faces[i];
      if (face.size() < 3) {
        return Error{"face " + std::to_string(i) + " of the hull has fewer than three corners"};
      }
      if (*std::max_element(face.begin(), face.end()) >= points.size()) {
        return Error{"face " + std::to_string(i) + " of the hull has a corner that does not exist"};
      }
      hull.faces_.push_back(
          {static_cast<uint32_t>(hull.corners_.size()), static_cast<uint32_t>(face.size())});
      hull.corners_.insert(hull.corners_.end(), face.begin(), face.end());
    }
    return {};
  }

  static void add_features(HullGeometry& hull) {
    hull.features_ = HullFeatures::of(hull);
    add_inner_ball(hull);
  }

  static void add_inner_ball(HullGeometry& hull) {
    if (!hull.features_) return;
    const Eigen::Vector3d off = hull.middle_ - hull.middle_.cast<float>().cast<double>();
    const double radius = (double{hull.features_->inner_radius()} - off.norm()) * (1 - 0x1p-20);
    hull.balls_.inner = static_cast<float>(std::max(radius, 0.0));
  }

  // The same of a k-DOP, by the planes of its faces.
  static void add_features(DopHull& dop, std::span<const uint8_t> planes) {
    HullGeometry& hull = dop.geometry;
    const auto edges = edges_of(hull);
    if (!edges || hull.points().size() > DopSolid::kMostPoints) return;
    const auto between = edges_between(*edges, planes);
    const auto features = HullFeatures::of(hull, normals_of_planes(planes));
    if (!between || !features) return;
    std::array<float, kDopPlanes> heights;
    heights.fill(HUGE_VALF);
    for (size_t f = 0; f < planes.size(); ++f) heights[planes[f]] = features->height(f);
    hull.features_ = features;
    add_inner_ball(hull);
    hull.dop_solid_ = &dop.solid.emplace(hull, features->inner_radius(), heights, *between);
    hull.columns_ = {std::shared_ptr<const float>(), hull.dop_solid_->column(0)};
    hull.column_stride_ = DopSolid::kMostPoints;
  }
};

Result<std::shared_ptr<const HullGeometry>> make_hull(
    std::span<const Eigen::Vector3f> points, std::span<const std::vector<uint32_t>> faces) {
  const FloatEnvironment environment;
  const auto hull = std::make_shared<HullGeometry>();
  if (const Result<void> built = HullBuilder::build(points, faces, *hull); !built) {
    return built.error();
  }
  HullBuilder::add_features(*hull);
  return std::shared_ptr<const HullGeometry>(hull);
}

void DopHull::make(std::span<const Eigen::Vector3f> points,
                   std::span<const std::vector<uint32_t>> faces, std::span<const uint8_t> planes) {
  const FloatEnvironment environment;
  (void)HullBuilder::build(points, faces, geometry);
  HullBuilder::add_features(*this, planes);
}

}  // namespace carom

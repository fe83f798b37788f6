#include "carom/shapes/hull.h"

#include <algorithm>
#include <string>

#include "base/float_environment.h"
#include "shapes/hull_features.h"

namespace carom {
namespace {

std::vector<float> columns_of(std::span<const Eigen::Vector3f> points) {
  const size_t padded = padded_count(points.size());
  std::vector<float> columns(3 * padded);
  for (size_t i = 0; i < padded; ++i) {
    const Eigen::Vector3f& point = points[i < points.size() ? i : 0];
    for (int axis = 0; axis < 3; ++axis) columns[axis * padded + i] = point[axis];
  }
  return columns;
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

}  // namespace

Result<std::shared_ptr<const HullGeometry>> make_hull(
    std::span<const Eigen::Vector3f> points, std::span<const std::vector<uint32_t>> faces) {
  const FloatEnvironment environment;
  if (points.empty()) return Error{"a hull without points"};
  auto hull = std::make_shared<HullGeometry>();
  for (size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) {
      return Error{"point " + std::to_string(i) + " of the hull is not finite"};
    }
    hull->size_ = std::max(hull->size_, points[i].cwiseAbs().maxCoeff());
  }
  hull->points_.assign(points.begin(), points.end());
  hull->columns_ = columns_of(points);
  hull->middle_ = mean_of(points);
  hull->records_ = records_of(points, hull->middle_.cast<float>());
  for (size_t i = 0; i < faces.size(); ++i) {
    const std::vector<uint32_t>& face = faces[i];
    if (face.size() < 3) {
      return Error{"face " + std::to_string(i) + " of the hull has fewer than three corners"};
    }
    if (*std::max_element(face.begin(), face.end()) >= points.size()) {
      return Error{"face " + std::to_string(i) + " of the hull has a corner that does not exist"};
    }
    hull->faces_.push_back(
        {static_cast<uint32_t>(hull->corners_.size()), static_cast<uint32_t>(face.size())});
    hull->corners_.insert(hull->corners_.end(), face.begin(), face.end());
  }
  hull->features_ = HullFeatures::of(*hull);
  return std::shared_ptr<const HullGeometry>(std::move(hull));
}

}  // namespace carom

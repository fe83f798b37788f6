#include "tests/support/hulls.h"

namespace carom::test {

PlacedShape placed_hull(const Points& points, const Eigen::Vector3d& position,
                        const Eigen::Quaternionf& turn) {
  return {oracle::hull_of(points), position, turn};
}

Points points_of(const Hull& hull) {
  return {hull.geometry->points().begin(), hull.geometry->points().end()};
}

Points box_corners(const Eigen::Vector3f& half) {
  Points corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back(
        Eigen::Vector3f(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1).cwiseProduct(half));
  }
  return corners;
}

Points cube_corners(float half) { return box_corners(Eigen::Vector3f::Constant(half)); }

Points bevelled_corners(const Eigen::Vector3f& half, float bevel) {
  Points corners;
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Vector3f less = Eigen::Vector3f::Constant(bevel);
    less[axis] = 0;
    const Points face = box_corners(half - less);
    corners.insert(corners.end(), face.begin(), face.end());
  }
  return corners;
}

Points pyramid(float height) {
  return {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, height}};
}

Points prism(size_t sides, float radius, float half_height) {
  Points points;
  for (size_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(sides);
    const auto x = static_cast<float>(radius * std::cos(angle));
    const auto y = static_cast<float>(radius * std::sin(angle));
    for (const float z : {-half_height, half_height}) points.emplace_back(x, y, z);
  }
  return points;
}

Points round_points(size_t count, const Eigen::Vector3f& half, oracle::Random& random) {
  Points points(count);
  for (Eigen::Vector3f& p : points) p = random.direction().cast<float>().cwiseProduct(half);
  return points;
}

Points scaled(Points points, float factor) {
  for (Eigen::Vector3f& p : points) p *= factor;
  return points;
}

}  // namespace carom::test

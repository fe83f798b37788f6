#include <algorithm>
#include <string>
#include <vector>

#include "carom/shapes/scaled.h"
#include "geometries/placed_shape.h"
#include "geometries/scale.h"

namespace carom {

Result<std::shared_ptr<const HullGeometry>> mapped(const HullGeometry& hull, const PointMap& map,
                                                   bool mirrors) {
  std::vector<Eigen::Vector3f> points;
  for (const Eigen::Vector3f& point : hull.points()) points.push_back(map(point));
  std::vector<std::vector<uint32_t>> faces;
  for (const HullGeometry::Face& face : hull.faces()) {
    const auto corners = hull.corners(face);
    faces.emplace_back(corners.begin(), corners.end());
    // Counter-clockwise again, from the same corner on.
    if (mirrors) std::reverse(faces.back().begin() + 1, faces.back().end());
  }
  return make_hull(points, faces);
}

Result<std::shared_ptr<const HullGeometry>> scaled(const std::shared_ptr<const HullGeometry>& hull,
                                                   const Eigen::Vector3f& scale) {
  if (!hull) return Error{"a hull without geometry"};
  if (Result<void> checked = check_scale(scale); !checked) return checked.error();
  const auto by_scale = [&scale](const Eigen::Vector3f& point) -> Eigen::Vector3f {
    return point.cwiseProduct(scale);
  };
  auto made = mapped(*hull, by_scale, is_mirroring(scale));
  if (made) return made;
  return Error{"by the scale " + text_of_scale(scale) + ": " + made.error().message};
}

}  // namespace carom

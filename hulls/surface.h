// Distances of points from a hull.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "carom/export.h"
#include "carom/shapes/hull.h"

namespace carom::hulls {

// Triangles of a hull: its faces, cut into fans. A hull without faces has the segments between all
// its points. So all of them lie in the hull, however its faces round. Exported, since
// carom_ladders is another library.
class CAROM_EXPORT Surface {
 public:
  using Triangle = std::array<Eigen::Vector3d, 3>;

  explicit Surface(const HullGeometry& hull);
  // The surface of the hull as if its points were these.
  Surface(const HullGeometry& hull, std::span<const Eigen::Vector3d> points);

  // The point of the surface that is nearest to p. For a p outside it is the nearest point of the
  // hull; up to the rounding of its coordinates it lies in the hull in any case, so that no p is
  // further from the hull than from it.
  Eigen::Vector3d nearest(const Eigen::Vector3d& p) const;
  double distance(const Eigen::Vector3d& p) const { return (nearest(p) - p).norm(); }

 private:
  std::vector<Triangle> triangles_;
};

}  // namespace carom::hulls

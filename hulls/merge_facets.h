// Merges coplanar facets of a hull into polygons.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "hulls/facets.h"

namespace carom::hulls {

struct HullFaces {
  std::vector<std::vector<uint32_t>> faces;  // outlines, counter-clockwise from outside
  std::vector<bool> is_corner;               // for each point: whether it is a corner of a facet
};

// Merges facets that lie in one plane, up to `rounding` of the coordinates in each axis. A facet's
// vertex that its outline drops (because it is on an edge) is not a corner.
HullFaces merge_facets(std::span<const Eigen::Vector3d> points, const std::vector<Facet>& facets,
                       const Eigen::Vector3d& rounding);

}  // namespace carom::hulls

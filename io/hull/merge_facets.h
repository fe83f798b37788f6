// Facets of a hull -> polygons.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "io/hull/facets.h"

namespace carom::io {

struct HullFaces {
  std::vector<std::vector<uint32_t>> faces;  // outlines, counter-clockwise from outside
  std::vector<bool> is_corner;               // one a point: a corner of some facet
};

// Facets that lie in one plane, up to `rounding` of their coordinates in each axis, become one
// face. Points of facets that are no corners of their outlines are no corners at all.
HullFaces merge_facets(std::span<const Eigen::Vector3d> points, const std::vector<Facet>& facets,
                       const Eigen::Vector3d& rounding);

}  // namespace carom::io

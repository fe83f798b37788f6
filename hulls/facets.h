// Finds the facets of a solid point set with Qhull.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace carom::hulls {

struct Facet {
  Eigen::Vector3d normal;           // unit, outwards
  std::vector<uint32_t> vertices;   // indices of points, in no order
  std::vector<uint32_t> neighbors;  // indices of facets
};

struct Facets {
  std::vector<Facet> list;
  // The largest distance of a point outside a facet, or of a facet's vertex below it; infinite if
  // unknown.
  double thickness = 0;
};

// `points` have size about one, do not lie in a plane, and are at most 2^31 - 1. With `joggle`
// Qhull moves the points at random, as little as it needs to succeed; facets are then triangles.
// Returns nothing if Qhull fails; never prints and never ends the program. C. B. Barber et al., The
// Quickhull algorithm for convex hulls, ACM Transactions on Mathematical Software 22(4), 1996.
std::optional<Facets> find_facets(std::span<const Eigen::Vector3d> points, bool joggle);

}  // namespace carom::hulls

// Qhull: points of a solid -> facets.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace carom::io {

struct Facet {
  Eigen::Vector3d normal;           // unit, outwards
  std::vector<uint32_t> vertices;   // indices of points, in no order
  std::vector<uint32_t> neighbors;  // indices of facets
};

struct Facets {
  std::vector<Facet> list;
  // The furthest that a point lies outside of a facet, or a vertex inside of its own; infinite if
  // that is not known.
  double thickness = 0;
};

// Points of about size one that do not lie in a plane, at most 2^31 - 1. With `joggle` the points
// are moved by chance, by as little as makes it work: facets are triangles then. Nothing if Qhull
// fails; never prints, never ends the program.
// C. B. Barber et al., The Quickhull algorithm for convex hulls, ACM Transactions on Mathematical
// Software 22(4), 1996.
std::optional<Facets> find_facets(std::span<const Eigen::Vector3d> points, bool joggle);

}  // namespace carom::io

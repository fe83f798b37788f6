// Checks how far contact points are from the surfaces on which they should lie.
#pragma once

#include <cstdint>
#include <vector>

#include "carom/world/world.h"

namespace carom::cli {

struct SurfaceDistances {
  std::vector<double> metres;  // one for each point and body
  double greatest = 0;
  size_t furthest_contact = 0;  // an index of World::contacts()

  void add(double distance, size_t contact);
};

// The oracle computes the distances by trying every face, edge and corner in long double. For
// compounds and meshes it is the distance from the nearest part.
struct SurfaceCheck {
  // Witness points of both bodies, and manifold points, which lie on A.
  SurfaceDistances on;
  // Manifold points moved by their separation along the contact's normal, measured from B. They
  // need not lie exactly on B if parts of a mesh or compound have other normals.
  SurfaceDistances across;
  uint64_t left_out = 0;  // points on bodies with a hull too large for the oracle
};

SurfaceCheck check_surfaces(const World& world);

}  // namespace carom::cli

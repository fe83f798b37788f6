// How far the points of contacts lie from the surfaces that they are said to lie on.
#pragma once

#include <cstdint>
#include <vector>

#include "carom/world/world.h"

namespace carom::cli {

struct SurfaceDistances {
  std::vector<double> metres;  // one a point and body
  double greatest = 0;
  size_t furthest_contact = 0;  // an index of World::contacts()

  void add(double distance, size_t contact);
};

// Distances are those of the oracle: every face, edge and corner is tried, in long double; of
// compounds and meshes those from the nearest part.
struct SurfaceCheck {
  // Witness points of both bodies, and the points of manifolds, which lie on A.
  SurfaceDistances on;
  // Points of manifolds, moved by their separation along the normal of the contact, from B: where
  // parts of a mesh or compound meet along other normals, B is not exactly there.
  SurfaceDistances across;
  uint64_t left_out = 0;  // points on bodies with a hull too large for the oracle
};

SurfaceCheck check_surfaces(const World& world);

}  // namespace carom::cli

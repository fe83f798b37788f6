// Converts bodies of streams for other libraries.
#pragma once

#include <span>
#include <vector>

#include "bench/peers/narrowphase/pair_peer.h"
#include "bench/support/bodies.h"

namespace carom::bench {

// Aabbs become boxes without rotation.
PeerBodies peer_bodies(ShapeKind kind, const std::vector<PlacedShape>& bodies);

// Bodies that share a mesh.
PeerBodies peer_meshes(std::span<const Eigen::Vector3f> vertices,
                       std::span<const std::array<uint32_t, 3>> triangles,
                       const std::vector<PlacedShape>& bodies);

}  // namespace carom::bench

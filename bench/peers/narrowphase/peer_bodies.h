// Converts bodies of streams for other libraries.
#pragma once

#include <vector>

#include "bench/peers/narrowphase/pair_peer.h"
#include "bench/support/bodies.h"
#include "bench/support/mesh_stream.h"

namespace carom::bench {

// Aabbs become boxes without rotation.
PeerBodies peer_bodies(ShapeKind kind, const std::vector<PlacedShape>& bodies);

// `count` bodies with the same terrain.
PeerBodies peer_ground(const Terrain& terrain, size_t count);

}  // namespace carom::bench

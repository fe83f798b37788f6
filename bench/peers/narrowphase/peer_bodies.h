// Bodies of streams as other libraries are given them.
#pragma once

#include <vector>

#include "bench/peers/narrowphase/pair_peer.h"
#include "bench/support/bodies.h"
#include "bench/support/mesh_stream.h"

namespace carom::bench {

// Boxes along the axes are boxes that are not turned.
PeerBodies peer_bodies(ShapeKind kind, const std::vector<PlacedShape>& bodies);

// The same terrain so many times.
PeerBodies peer_ground(const Terrain& terrain, size_t count);

}  // namespace carom::bench

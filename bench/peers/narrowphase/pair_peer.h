// What another library is given of a stream of pairs. Nothing here includes Eigen, as in
// broadphase/peer.h.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace carom::bench {

enum class PeerShape { sphere, capsule, box, triangle };

struct PeerBody {
  std::array<float, 3> position;
  std::array<float, 4> orientation;  // x, y, z, w; a unit quaternion
  // sphere: radius; capsule: radius and half the length, along y; box: half extents; triangle:
  // three corners
  std::array<float, 9> size;
};

struct PeerBodies {
  PeerShape shape;
  std::vector<PeerBody> bodies;
};

enum class PeerDetail { overlap, contact };

// Pair i is (a[i], b[i]).
class PairPeer {
 public:
  virtual ~PairPeer() = default;
  // One pass: writes whether each pair overlaps, and returns the number of contact points found.
  virtual size_t run(std::span<uint8_t> overlaps) = 0;
};

// bullet.cc. At PeerDetail::overlap boxes alone.
std::unique_ptr<PairPeer> make_bullet_pairs(const PeerBodies& a, const PeerBodies& b,
                                            PeerDetail detail);

}  // namespace carom::bench

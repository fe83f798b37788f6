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

enum class PeerShape { sphere, capsule, box, triangle, hull, mesh };

struct PeerBody {
  std::array<float, 3> position;
  std::array<float, 4> orientation;  // x, y, z, w; a unit quaternion
  // sphere: radius; capsule: radius and half the length, along y; box: half extents; triangle:
  // three corners
  std::array<float, 9> size;
  size_t hull = 0;  // which of the hulls; bodies share them
};

struct PeerBodies {
  PeerShape shape;
  std::vector<PeerBody> bodies = {};
  std::vector<std::vector<std::array<float, 3>>> hulls = {};  // points
  std::vector<std::array<float, 3>> vertices = {};            // of the mesh that all bodies share
  std::vector<std::array<uint32_t, 3>> triangles = {};
};

enum class PeerDetail { overlap, contact, distance };

// Pair i is (a[i], b[i]).
class PairPeer {
 public:
  virtual ~PairPeer() = default;
  // One pass: writes whether each pair overlaps, and returns the number of contact points found.
  virtual size_t run(std::span<uint8_t> overlaps) = 0;
};

// bullet.cc. At PeerDetail::overlap boxes alone; at PeerDetail::distance the points that are
// nearest of separate pairs, and the depth of the others.
std::unique_ptr<PairPeer> make_bullet_pairs(const PeerBodies& a, const PeerBodies& b,
                                            PeerDetail detail);

// Which of Bullet's casts: the one that its world's sweep test runs, or the one without turning,
// which is faster.
enum class PeerCast { continuous, gjk };

// bullet.cc. B moves by a displacement; "overlaps" are impacts, and as many are returned. Convex
// shapes alone.
std::unique_ptr<PairPeer> make_bullet_casts(const PeerBodies& a, const PeerBodies& b,
                                            std::vector<std::array<float, 3>> displacements,
                                            PeerCast cast);

}  // namespace carom::bench

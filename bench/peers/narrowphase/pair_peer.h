// The bodies of a stream in the form for another library, and its interface. Nothing here includes
// Eigen, as in broadphase/peer.h.
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
  size_t hull = 0;  // index into the hulls; bodies share them
};

struct PeerHull {
  std::vector<std::array<float, 3>> points;
  std::vector<std::vector<int>> faces;  // corners of each in order, seen from outside to the left
};

struct PeerBodies {
  PeerShape shape;
  std::vector<PeerBody> bodies = {};
  std::vector<PeerHull> hulls = {};
  std::vector<std::array<float, 3>> vertices = {};  // of the mesh; all bodies share it
  std::vector<std::array<uint32_t, 3>> triangles = {};
};

enum class PeerDetail { overlap, contact, manifold, distance };

// Pair i is (a[i], b[i]).
class PairPeer {
 public:
  virtual ~PairPeer() = default;
  // One pass: writes whether each pair overlaps, and returns the number of contact points found.
  virtual size_t run(std::span<uint8_t> overlaps) = 0;
};

// Defined in bullet.cc. PeerDetail::overlap is for boxes only. PeerDetail::distance finds the
// nearest points of separate pairs and the depth of the others.
std::unique_ptr<PairPeer> make_bullet_pairs(const PeerBodies& a, const PeerBodies& b,
                                            PeerDetail detail);

// The same of other libraries, defined in fcl.cc and ode.cc; nullptr where they have no call for
// the shapes or the detail.
std::unique_ptr<PairPeer> make_fcl_pairs(const PeerBodies& a, const PeerBodies& b,
                                         PeerDetail detail);
std::unique_ptr<PairPeer> make_ode_pairs(const PeerBodies& a, const PeerBodies& b,
                                         PeerDetail detail);

// One of Bullet's casts: the one that its world's sweep test runs, or the faster one without
// rotation.
enum class PeerCast { continuous, gjk };

// Defined in bullet.cc. B moves by a displacement; run() writes impacts as "overlaps" and returns
// their number. Convex shapes only.
std::unique_ptr<PairPeer> make_bullet_casts(const PeerBodies& a, const PeerBodies& b,
                                            std::vector<std::array<float, 3>> displacements,
                                            PeerCast cast);

}  // namespace carom::bench

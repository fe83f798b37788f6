// The bodies of a stream in the form for another library, and its interface. Nothing here includes
// Eigen, as in broadphase/peer.h.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace carom::bench {

enum class PeerShape { sphere, capsule, box, triangle, hull, mesh, cylinder, cone, ellipsoid };

struct PeerBody {
  std::array<float, 3> position;
  std::array<float, 4> orientation;  // x, y, z, w; a unit quaternion
  // sphere: radius; capsule: radius and half the length, along y; box: half extents; triangle:
  // three corners; cylinder, cone: radius and half the length, along z; ellipsoid: semi-axes
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

// What a library says of pairs. A separation is below zero, by the depth of the deepest contact,
// where the bodies overlap, and NaN where the library reports none.
struct PairAnswers {
  explicit PairAnswers(size_t count) : overlaps(count), separations(count) {}
  std::vector<uint8_t> overlaps;
  std::vector<float> separations;
};
inline constexpr float kNotReported = std::numeric_limits<float>::quiet_NaN();

// Pair i is (a[i], b[i]).
class PairPeer {
 public:
  virtual ~PairPeer() = default;
  // One pass over all pairs.
  virtual void run(PairAnswers& answers) = 0;
};
using MakePairPeer = std::unique_ptr<PairPeer>(const PeerBodies& a, const PeerBodies& b,
                                               PeerDetail detail);

// Each is defined in the file of its library, and returns nullptr where the library has no call for
// the shapes or the detail. PeerDetail::overlap is for boxes only. PeerDetail::distance finds the
// nearest points of separate pairs and the depth of the others.
MakePairPeer make_bullet_pairs, make_fcl_pairs, make_ode_pairs;
// libccd alone: GJK and EPA, or the refinement of portals (MPR).
MakePairPeer make_ccd_gjk_pairs, make_ccd_mpr_pairs;
// Exact decisions alone.
MakePairPeer make_cgal_pairs;
// Returns nullptr where Carom was built without MuJoCo.
MakePairPeer make_mujoco_pairs;
// Two meshes: FCL with all contacts, or with the first that it finds.
MakePairPeer make_fcl_mesh_pairs, make_fcl_first_mesh_pairs;

// One of Bullet's casts: the one that its world's sweep test runs, or the faster one without
// rotation.
enum class PeerCast { continuous, gjk };

// How bodies move from their poses.
struct PeerMotions {
  std::vector<std::array<float, 3>> displacements;     // of B
  std::vector<std::array<float, 3>> turns_a, turns_b;  // axis times angle; empty if none turns
};

// Defined in bullet_casts.cc. Writes impacts as overlaps. Convex shapes only.
std::unique_ptr<PairPeer> make_bullet_casts(const PeerBodies& a, const PeerBodies& b,
                                            PeerMotions motions, PeerCast cast);

}  // namespace carom::bench

// Bodies and casts for other libraries. Nothing here includes Eigen, as in broadphase/peer.h.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace carom::bench {

enum class CastShape { sphere, capsule, box, hull, mesh };

struct CastBody {
  CastShape shape;
  std::array<float, 3> position;
  std::array<float, 4> orientation;  // x, y, z, w; a unit quaternion
  // sphere: radius; capsule: radius and half the length, along z; box: half extents
  std::array<float, 3> size;
  size_t hull = 0;  // index into the hulls; bodies share them
};

struct CastHull {
  std::vector<std::array<float, 3>> points;
  std::vector<std::vector<uint32_t>> faces;  // outlines, counter-clockwise as seen from outside
};

struct CastScene {
  std::vector<CastBody> bodies;
  std::vector<CastHull> hulls;
  std::vector<std::array<float, 3>> vertices;  // of the mesh
  std::vector<std::array<uint32_t, 3>> triangles;
};

// Queries of one shape, with the hulls of the scene. They touch no body at the start.
struct CastList {
  std::vector<CastBody> queries;
  std::vector<std::array<float, 3>> displacements;
};

// Bodies of a scene and the queries in the form of one library, ready for casts.
class CastPeer {
 public:
  virtual ~CastPeer() = default;
  // Writes the time of the closest hit of the first times.size() casts, above 1 if there is none.
  virtual void run(std::span<float> times) = 0;
};

// Defined in casts_bullet.cc: btCollisionWorld::convexSweepTest() with a btDbvtBroadphase.
std::unique_ptr<CastPeer> make_bullet_casts(const CastScene& scene, const CastList& list);
// Defined in casts_fcl.cc. FCL has no cast at many bodies. A user asks its tree for the bodies in
// the box of the path, and continuousCollide() for each of these.
std::unique_ptr<CastPeer> make_fcl_casts(const CastScene& scene, const CastList& list);

}  // namespace carom::bench

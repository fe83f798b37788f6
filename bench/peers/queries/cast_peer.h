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

// The bodies of a scene in the form of one library.
class CastPeer {
 public:
  virtual ~CastPeer() = default;
  // Makes the queries; the list must outlive their runs.
  virtual void prepare(const CastList& list) = 0;
  // Writes the time of the closest hit of the first times.size() casts, above 1 if there is none.
  virtual void run(std::span<float> times) = 0;
};

// Defined in casts_bullet.cc and casts_fcl.cc. The scene must outlive the peer.
std::unique_ptr<CastPeer> make_bullet_casts(const CastScene& scene);
std::unique_ptr<CastPeer> make_fcl_casts(const CastScene& scene);

}  // namespace carom::bench

// The scenes of carom_cast_peers, for Carom and in plain arrays for the others.
#pragma once

#include <memory>
#include <vector>

#include "bench/peers/queries/cast_peer.h"
#include "carom/results/contact.h"
#include "carom/shapes/body.h"
#include "carom/world/world.h"
#include "oracle/random.h"

namespace carom::bench {

struct CastWorld {
  CastScene scene;
  std::vector<Hull> hulls;                   // those of the scene
  std::shared_ptr<const MeshGeometry> mesh;  // that of the scene

  Shape shape_of(const CastBody& body) const;
  Pose pose_of(const CastBody& body) const;
  // After its first step.
  World make_world() const;
};

// `bodies` spheres, boxes, capsules and hulls, which fill about 2 in 100 of a cube.
CastWorld make_yard(size_t bodies);
// The mesh of carom_ray_peers, 2 n^2 triangles on 100 x 100 m. It has the hulls of casts, too.
CastWorld make_terrain(uint32_t n);

// Queries of one shape in the arrays that Carom reads.
class CastArrays {
 public:
  CastArrays(const CastWorld& world, const CastList& list);
  CastArrays(const CastArrays&) = delete;
  CastArrays& operator=(const CastArrays&) = delete;

  const Collidables& queries() const { return queries_; }
  SweepView sweep() const { return {.displacement = displacements_[0].data()}; }
  // Those of one cast.
  Collidables query(size_t i) const;
  SweepView sweep(size_t i) const { return {.displacement = displacements_[i].data()}; }

 private:
  std::vector<std::array<float, 4>> records_, rows_;
  std::vector<std::array<float, 4>> orientations_;
  std::vector<std::array<float, 3>> displacements_;
  Collidables queries_;
};

// `count` casts of 0.2 to 0.5 m in random directions, `length` long, that start free.
CastList draw_casts(const CastWorld& scene, const World& world, CastShape shape, float length,
                    size_t count);

}  // namespace carom::bench

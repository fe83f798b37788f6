// Rays and moving shapes against bodies that stand still.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "carom/base/parallelism.h"
#include "carom/base/result.h"
#include "carom/export.h"
#include "carom/results/contact.h"
#include "carom/results/sweep.h"
#include "carom/shapes/views.h"

namespace carom {

// A query meets a body on its way. What it says is that of time_of_impact() for the two.
struct CastHit {
  uint32_t query;      // index of the query
  uint32_t body;       // index of the body
  uint32_t sub_shape;  // of the body, as in Contact
  // In [0, 1]; 0: they touch or overlap at the start. The query is at position + toi * displacement
  // then, in front of the body by a rounding at most.
  float toi;
  Eigen::Vector3f normal;  // unit, world frame, from the query to the body
  Eigen::Vector3f point;   // on the body, world axes, relative to the body's position
  float separation;        // about zero, or minus the depth of what overlaps at the start
  Status status;           // as of time_of_impact(); budget: the hit may be later, or none
};

enum class CastHits : uint8_t {
  closest,  // of every query the hit with the least toi, of equal ones that of the lowest body
  all,
};

// Replaces `hits` by those of all queries, sorted by (query, toi, body). Queries are bodies of any
// kind, rays, spheres, boxes, even meshes, which move as their row of `sweep` says (Sweep); bodies
// stand still. A pair hits if time_of_impact() says so: none is lost, however far a query goes. Two
// half-spaces do not meet.
//
// Bodies, queries or sweeps that are not valid (NaN, infinite, negative sizes) hit nothing and do
// not disturb the others. `hits` are the same bits on every instruction set and for any number of
// threads, and a query's hits do not depend on the other queries.
//
// Bodies are sorted into a tree in every call (World::cast() keeps it): many queries at once cost
// far less than as many calls. Fails, and leaves no hits, if a pair to test is of a kind that is
// none of ShapeKind.
CAROM_EXPORT Result<void> cast(const Collidables& queries, const SweepView& sweep,
                               const Collidables& bodies, CastHits which,
                               std::vector<CastHit>& hits,
                               Parallelism parallelism = Parallelism::none);

// Rays as queries: points that move by direction * length. Origins are read where they are, and
// must outlive this. `direction` need not be of unit length: toi * length then counts in its
// lengths. Rays whose end is not finite hit nothing.
class CAROM_EXPORT Rays {
 public:
  // `count` origins and directions, x, y, z float32, so many bytes apart.
  Rays(const float* origin, const float* direction, size_t count, float length,
       size_t origin_stride = 3 * sizeof(float), size_t direction_stride = 3 * sizeof(float));

  Collidables queries() const { return points(origin_, displacements_.size(), origin_stride_); }
  SweepView sweep() const {
    return {.displacement = displacements_.empty() ? nullptr : displacements_[0].data()};
  }

 private:
  const float* origin_;
  size_t origin_stride_;
  std::vector<Eigen::Vector3f> displacements_;
};

}  // namespace carom

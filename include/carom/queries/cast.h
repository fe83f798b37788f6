/// @file
/// Casts: rays and moving shapes against bodies that stand still.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "carom/base/parallelism.h"
#include "carom/base/result.h"
#include "carom/export.h"
#include "carom/queries/query_options.h"
#include "carom/results/contact.h"
#include "carom/results/sweep.h"
#include "carom/shapes/views.h"

namespace carom {

/// A query hits a body on its path. All numbers are those of time_of_impact() for the two.
struct CastHit {
  uint32_t query;      ///< index of the query
  uint32_t body;       ///< index of the body
  uint32_t sub_shape;  ///< part of the body, as in Contact
  /// In [0, 1]; 0: they touch or overlap at the start. At that time the query is at
  /// position + toi * displacement, short of the body by a rounding at most.
  float toi;
  /// Unit, world frame, from the query to the body: the opposite of the body's surface normal at
  /// the hit. At a triangle that the query hits from its back it points out of the front.
  Eigen::Vector3f normal;
  Eigen::Vector3f point;  ///< on the body, world axes, relative to the body's position
  float separation;       ///< metres; about zero, or minus the depth of an overlap at the start
  Status status;          ///< that of time_of_impact(); budget: the hit may be later, or none
};

/// The body of a hit of CastHits::any.
inline constexpr uint32_t kNoBody = 0xffffffffu;

/// The hits of a query that cast() keeps.
enum class CastHits : uint8_t {
  closest,  ///< the one with the least toi; among equal ones that of the lowest body index
  all,      ///< all of them
  /// Whether there is one, for lines of sight and shadows: the search ends at the first that it
  /// finds. A query that hits something has one hit, in which only `query` is set; `body` is
  /// kNoBody and all other numbers are zero, since which hit comes first is nobody's business.
  any,
};

/// From which side queries hit the triangles of meshes, those in compounds included. Bodies that
/// are single triangles always keep their own rule.
enum class Backfaces : uint8_t {
  as_made,  ///< one-sided meshes from their front alone, other meshes from both sides
  hit,      ///< all meshes from both sides, as if none were one-sided
  ignore,   ///< all meshes from their front alone, as if all were one-sided
};

/// Options of cast().
struct CastOptions {
  CastHits hits = CastHits::closest;            ///< which hits of a query are kept
  Backfaces backfaces = Backfaces::as_made;     ///< from which side meshes are hit
  QueryFilter filter = {};                      ///< which bodies are met
  Parallelism parallelism = Parallelism::none;  ///< which threads the call may use
};

/// Moves every query as its row of `sweep` says (Sweep) and replaces `hits` by the bodies that the
/// queries hit, sorted by (query, toi, body). Queries are bodies of any kind: rays, spheres, boxes,
/// even meshes. Bodies stand still. A query hits a body if time_of_impact() finds an impact: none
/// is lost, however far a query goes. Two half-spaces do not meet.
///
/// Bodies, queries or sweeps that are not valid (NaN, infinite, negative sizes) hit nothing and do
/// not disturb the others. `hits` has the same bits on every instruction set and for any number of
/// threads, and a query's hits do not depend on the other queries.
///
/// Every call sorts the bodies into a tree (World::cast() keeps it), so one call with many queries
/// costs far less than as many calls. Fails, and leaves no hits, if a body or query of a pair has a
/// kind that ShapeKind does not name.
CAROM_EXPORT Result<void> cast(const Collidables& queries, const SweepView& sweep,
                               const Collidables& bodies, std::vector<CastHit>& hits,
                               const CastOptions& options = {});

/// The form of version 0.2.
[[deprecated("pass CastOptions")]] inline Result<void> cast(
    const Collidables& queries, const SweepView& sweep, const Collidables& bodies, CastHits which,
    std::vector<CastHit>& hits, Parallelism parallelism = Parallelism::none) {
  return cast(queries, sweep, bodies, hits, CastOptions{.hits = which, .parallelism = parallelism});
}

/// Rays as queries of cast(): points that move by direction * length. Origins are not copied and
/// must outlive this object. `direction` need not be a unit vector: a hit is at
/// origin + toi * length * direction. Rays with an end that is not finite hit nothing.
class CAROM_EXPORT Rays {
 public:
  /// `count` origins and directions: x, y, z float32, world frame, strides in bytes.
  Rays(const float* origin, const float* direction, size_t count, float length,
       size_t origin_stride = 3 * sizeof(float), size_t direction_stride = 3 * sizeof(float));

  /// The rays as bodies: points at the origins. Valid as long as the origins are.
  Collidables queries() const { return points(origin_, displacements_.size(), origin_stride_); }
  /// The displacements of the rays. Valid as long as this object is.
  SweepView sweep() const {
    return {.displacement = displacements_.empty() ? nullptr : displacements_[0].data()};
  }

 private:
  const float* origin_;
  size_t origin_stride_;
  std::vector<Eigen::Vector3f> displacements_;
};

}  // namespace carom

// What overlaps a shape, and what is nearest to it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "carom/base/parallelism.h"
#include "carom/base/result.h"
#include "carom/export.h"
#include "carom/results/contact.h"
#include "carom/shapes/views.h"

namespace carom {

struct OverlapHit {
  uint32_t query;
  uint32_t body;

  friend bool operator==(const OverlapHit&, const OverlapHit&) = default;
};

// Replaces `hits` by all pairs of a query and a body that overlap, as collide() decides, sorted by
// (query, body). Queries are bodies of any kind; two half-spaces do not meet. Bodies and queries
// that are not valid are in no pair. The same bits on every instruction set and for any number of
// threads. Fails, and leaves no hits, if a pair to test is of a kind that is
// none of ShapeKind.
CAROM_EXPORT Result<void> find_overlaps(const Collidables& queries, const Collidables& bodies,
                                        std::vector<OverlapHit>& hits,
                                        Parallelism parallelism = Parallelism::none);

// The nearest body of a query, as collide() measures it at Detail::contact.
struct NearestHit {
  uint32_t query;
  uint32_t body;
  uint32_t sub_shape;           // of the body
  float separation;             // metres; <= 0: they overlap, by that much
  Eigen::Vector3f normal;       // unit, world frame, from the query to the body
  Eigen::Vector3f point_query;  // the nearest points: of the query, relative to its position,
  Eigen::Vector3f point_body;   // and of the body, relative to that one's; world axes
  Status status;
};

// Replaces `hits` by the nearest body of each query, if there is one with a separation of `within`
// metres or less; sorted by query. Of bodies that overlap the query the one that is met deepest, of
// equally near ones that of the lowest index. Infinite `within`: wherever it is. Each query looks
// at the bodies about in the order of their distance and stops when no nearer one can come, so that
// this costs little more than a small distance, unless many bodies are about as near as the
// nearest.
//
// What is not valid has no neighbours and is none, as for find_overlaps(); nor is what is behind a
// one-sided triangle its neighbour. No query has a nearest body within NaN.
CAROM_EXPORT Result<void> find_nearest(const Collidables& queries, float within,
                                       const Collidables& bodies, std::vector<NearestHit>& hits,
                                       Parallelism parallelism = Parallelism::none);

}  // namespace carom

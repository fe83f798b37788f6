/// @file
/// Overlap and nearest-body queries: which bodies overlap a shape, and which is nearest to it.
#pragma once

#include <Eigen/Core>
#include <concepts>
#include <cstdint>
#include <vector>

#include "carom/base/result.h"
#include "carom/export.h"
#include "carom/queries/query_options.h"
#include "carom/results/contact.h"
#include "carom/shapes/views.h"

namespace carom {

/// A query that overlaps a body.
struct OverlapHit {
  uint32_t query;  ///< index of the query
  uint32_t body;   ///< index of the body

  /// Compares both indices.
  friend bool operator==(const OverlapHit&, const OverlapHit&) = default;
};

/// Replaces `hits` by all pairs of a query and a body that overlap, as collide() decides, sorted by
/// (query, body). Queries are bodies of any kind; two half-spaces do not meet. Bodies and queries
/// that are not valid are in no pair. The hits are the same on every instruction set and for any
/// number of threads. Fails, and leaves no hits, if a body or query of a pair has a kind that
/// ShapeKind does not name.
CAROM_EXPORT Result<void> find_overlaps(const Collidables& queries, const Collidables& bodies,
                                        std::vector<OverlapHit>& hits,
                                        const QueryOptions& options = {});

/// The nearest body of a query, as collide() measures it at Detail::contact.
struct NearestHit {
  uint32_t query;          ///< index of the query
  uint32_t body;           ///< index of the body
  uint32_t sub_shape;      ///< part of the body, as in Contact
  float separation;        ///< metres; <= 0: they overlap by that much
  Eigen::Vector3f normal;  ///< unit, world frame, from the query to the body
  Eigen::Vector3f
      point_query;             ///< witness point of the query, relative to its position, world axes
  Eigen::Vector3f point_body;  ///< witness point of the body, relative to its position, world axes
  Status status;               ///< that of collide()
};

/// Replaces `hits` by the nearest body of each query, if there is one with a separation of `within`
/// metres or less; sorted by query. The nearest body is the one with the least separation: among
/// bodies that overlap the query the deepest, among equally near ones that of the lowest index. If
/// `within` is infinite, a nearest body is found at any distance; if it is NaN, none is. Each query
/// visits the bodies roughly in the order of their distance and stops when no nearer one can come.
/// An infinite `within` therefore costs little more than a small one, unless many bodies are about
/// as near as the nearest.
///
/// A body or query that is not valid has no neighbours and is none, as for find_overlaps(). A
/// one-sided triangle is no neighbour of a body behind it. Errors, bits and threads are as for
/// find_overlaps().
CAROM_EXPORT Result<void> find_nearest(const Collidables& queries, float within,
                                       const Collidables& bodies, std::vector<NearestHit>& hits,
                                       const QueryOptions& options = {});

/// The form of version 0.2. A template, so that `{}` in the last place is QueryOptions.
template <std::same_as<Parallelism> Threads>
[[deprecated("pass QueryOptions")]] Result<void> find_overlaps(const Collidables& queries,
                                                               const Collidables& bodies,
                                                               std::vector<OverlapHit>& hits,
                                                               Threads parallelism) {
  return find_overlaps(queries, bodies, hits, QueryOptions{.parallelism = parallelism});
}

/// The form of version 0.2. A template, so that `{}` in the last place is QueryOptions.
template <std::same_as<Parallelism> Threads>
[[deprecated("pass QueryOptions")]] Result<void> find_nearest(const Collidables& queries,
                                                              float within,
                                                              const Collidables& bodies,
                                                              std::vector<NearestHit>& hits,
                                                              Threads parallelism) {
  return find_nearest(queries, within, bodies, hits, QueryOptions{.parallelism = parallelism});
}

}  // namespace carom

// The searches behind the queries of arrays and of worlds. The bodies come with their index and the
// filter, which the options repeat.
#pragma once

#include <vector>

#include "carom/queries/cast.h"
#include "carom/queries/queries.h"
#include "queries/body_index.h"

namespace carom {

Result<void> cast(const Collidables& queries, const SweepView& sweep, const SearchedBodies& bodies,
                  std::vector<CastHit>& hits, const CastOptions& options);

Result<void> find_overlaps(const Collidables& queries, const SearchedBodies& bodies,
                           std::vector<OverlapHit>& hits, Parallelism parallelism);

Result<void> find_nearest(const Collidables& queries, float within, const SearchedBodies& bodies,
                          std::vector<NearestHit>& hits, Parallelism parallelism);

}  // namespace carom

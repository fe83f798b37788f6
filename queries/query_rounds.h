// Searches of many queries side by side, in rounds: each query goes on until it has a few more
// candidates, the candidates of all are tested at once, and what was found limits the next round.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "carom/base/result.h"
#include "carom/results/pair.h"
#include "queries/body_index.h"
#include "queries/query_boxes.h"

namespace carom {

enum class SearchFor {
  met,   // what the moving box of the query meets; limits are times
  near,  // what is near the box of the query; limits are distances
};

struct RoundSizes {  // candidates of a query
  size_t first;
  size_t most;  // each round has twice as many as the last one, up to this
};

// Of one round, and tells each query's limit for the next.
using TestCandidates = FunctionRef<Result<void>(std::span<const Pair> candidates)>;

// So many queries make full batches for the kernels, and their searches fit the cache.
inline constexpr size_t kQueriesAtOnce = 4096;

// Queries [first, first + limit.size()), kQueriesAtOnce at most, with one limit each. Every body
// is a candidate of a query once, unless it is beyond its limit, and has no layer that is met.
// Half-spaces come in the first round. Candidates are in order of the query.
Result<void> search_in_rounds(const QueryBoxes& queries, const SearchedBodies& bodies,
                              SearchFor what, RoundSizes sizes, size_t first,
                              std::span<const float> limit, Parallelism parallelism,
                              TestCandidates test);

}  // namespace carom

// Searches many queries at once, in rounds. In each round every query collects a few more
// candidates, one call tests the candidates of all queries, and the results limit the next round.
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
  met,   // bodies that the moving box of the query meets; limits are times
  near,  // bodies near the box of the query; limits are distances
};

struct RoundSizes {  // candidates per query
  size_t first;
  size_t most;  // each round has twice as many as the last one, up to this
};

// Tests the candidates of one round, and updates the limits of the queries for the next.
using TestCandidates = FunctionRef<Result<void>(std::span<const Pair> candidates)>;

// This many queries make full batches for the kernels, and their searches fit the cache.
inline constexpr size_t kQueriesAtOnce = 4096;

// A query that is still searched.
struct QuerySearch {
  uint32_t query;
  MovingBox box;
  TreeWalk walk;
};

// Memory that searches of one caller use again.
using SearchMemory = std::vector<QuerySearch>;

// Searches queries [first, first + limit.size()), at most kQueriesAtOnce, with one limit each.
// Every body within a query's limit that the filter keeps becomes a candidate of it once.
// Half-spaces come in the first round. The candidates of a round are in order of the query.
Result<void> search_in_rounds(QueryBoxes& queries, const SearchedBodies& bodies, SearchFor what,
                              RoundSizes sizes, size_t first, std::span<const float> limit,
                              Parallelism parallelism, SearchMemory& memory, TestCandidates test);

}  // namespace carom

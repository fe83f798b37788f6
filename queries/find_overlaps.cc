#include <algorithm>
#include <limits>
#include <tuple>

#include "base/float_environment.h"
#include "carom/narrowphase/collide.h"
#include "carom/queries/queries.h"
#include "queries/query_rounds.h"
#include "queries/searches.h"

namespace carom {
namespace {

constexpr RoundSizes kOverlapRounds = {.first = 64, .most = 64};

bool is_before(const OverlapHit& a, const OverlapHit& b) {
  return std::tie(a.query, a.body) < std::tie(b.query, b.body);
}

}  // namespace

Result<void> find_overlaps(const Collidables& queries, const SearchedBodies& bodies,
                           std::vector<OverlapHit>& hits, Parallelism parallelism) {
  const FloatEnvironment environment;
  hits.clear();
  const SweepView still;
  QueryBoxes boxes(queries, still);
  std::vector<uint8_t> overlap;
  SearchMemory memory;
  const auto test = [&](std::span<const Pair> candidates) {
    overlap.resize(candidates.size());
    Result<void> tested = collide(queries, bodies.bodies, candidates, Detail::overlap,
                                  {.overlap = overlap.data()}, {.parallelism = parallelism});
    for (size_t i = 0; tested && i < candidates.size(); ++i) {
      if (overlap[i]) hits.push_back({candidates[i].a, candidates[i].b});
    }
    return tested;
  };
  for (size_t first = 0; first < queries.count; first += kQueriesAtOnce) {
    const std::vector<float> limit(std::min(kQueriesAtOnce, queries.count - first), 1.0f);
    const auto before = static_cast<ptrdiff_t>(hits.size());
    Result<void> found = search_in_rounds(boxes, bodies, SearchFor::met, kOverlapRounds, first,
                                          limit, parallelism, memory, test);
    if (!found) {
      hits.clear();
      return found;
    }
    std::sort(hits.begin() + before, hits.end(), is_before);
  }
  return {};
}

Result<void> find_overlaps(const Collidables& queries, const Collidables& bodies,
                           std::vector<OverlapHit>& hits, const QueryOptions& options) {
  const FloatEnvironment environment;
  const BodyIndex index = index_bodies(bodies, options.parallelism);
  return find_overlaps(queries, SearchedBodies{bodies, index, options.filter}, hits,
                       options.parallelism);
}

}  // namespace carom

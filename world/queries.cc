#include "base/float_environment.h"
#include "queries/searches.h"
#include "world/world_state.h"

namespace carom {
namespace {

// Calls search(bodies) with the bodies of the last step.
template <class State, class Search>
void search_world(State& state, QueryFilter filter, const Search& search) {
  const FloatEnvironment environment;
  const Collidables bodies = state.bodies.view();
  filter.bodies = state.bodies.filter();
  // Cannot fail: every pair of kinds has a kernel, except two half-spaces, which are no candidates.
  (void)search(SearchedBodies{bodies, state.index_for_queries(Parallelism::none), filter});
}

}  // namespace

const BodyIndex& World::State::index_for_queries(Parallelism parallelism) {
  return query_index.of_step(report.step, bodies.view(), bounds_view(), bodies.filter().motion,
                             halfspaces.all(), parallelism);
}

void World::prepare_queries() {
  const FloatEnvironment environment;
  state_->index_for_queries(state_->settings.parallelism);
}

void World::cast(const Collidables& queries, const SweepView& sweep, std::vector<CastHit>& hits,
                 const CastOptions& options) const {
  search_world(*state_, options.filter, [&](const SearchedBodies& bodies) {
    return carom::cast(queries, sweep, bodies, hits, options);
  });
}

void World::find_overlaps(const Collidables& queries, std::vector<OverlapHit>& hits,
                          const QueryOptions& options) const {
  search_world(*state_, options.filter, [&](const SearchedBodies& bodies) {
    return carom::find_overlaps(queries, bodies, hits, options.parallelism);
  });
}

void World::find_nearest(const Collidables& queries, float within, std::vector<NearestHit>& hits,
                         const QueryOptions& options) const {
  search_world(*state_, options.filter, [&](const SearchedBodies& bodies) {
    return carom::find_nearest(queries, within, bodies, hits, options.parallelism);
  });
}

}  // namespace carom

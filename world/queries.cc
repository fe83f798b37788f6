#include "base/float_environment.h"
#include "queries/searches.h"
#include "world/world_state.h"

namespace carom {
namespace {

// Calls search(bodies) with the bodies of the last step.
template <class State, class Search>
void search_world(State& state, uint32_t mask, const Search& search) {
  const FloatEnvironment environment;
  const Collidables bodies = state.bodies.view();
  const BodyIndex& index =
      state.query_index.of_step(state.report.step, bodies, state.bounds_view(),
                                state.halfspaces.all(), state.settings.parallelism);
  // Cannot fail: every pair of kinds has a kernel, except two half-spaces, which are no candidates.
  (void)search(SearchedBodies{bodies, index, state.bodies.filter().layer, mask});
}

}  // namespace

void World::cast(const Collidables& queries, const SweepView& sweep, CastHits which,
                 std::vector<CastHit>& hits, uint32_t mask) const {
  search_world(*state_, mask, [&](const SearchedBodies& bodies) {
    return carom::cast(queries, sweep, bodies, which, hits, state_->settings.parallelism);
  });
}

void World::find_overlaps(const Collidables& queries, std::vector<OverlapHit>& hits,
                          uint32_t mask) const {
  search_world(*state_, mask, [&](const SearchedBodies& bodies) {
    return carom::find_overlaps(queries, bodies, hits, state_->settings.parallelism);
  });
}

void World::find_nearest(const Collidables& queries, float within, std::vector<NearestHit>& hits,
                         uint32_t mask) const {
  search_world(*state_, mask, [&](const SearchedBodies& bodies) {
    return carom::find_nearest(queries, within, bodies, hits, state_->settings.parallelism);
  });
}

}  // namespace carom

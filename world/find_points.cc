#include "base/float_environment.h"
#include "broadphase/point_candidates.h"
#include "carom/narrowphase/collide.h"
#include "queries/query_filter.h"
#include "world/world_state.h"

namespace carom {

void World::find_points(const float* xyz, size_t count, size_t stride, std::vector<PointHit>& hits,
                        const QueryOptions& options) const {
  const FloatEnvironment environment;
  hits.clear();
  const Parallelism parallelism = options.parallelism;
  std::vector<Pair> candidates =
      find_point_candidates(xyz, count, stride, state_->bounds_view(), parallelism);
  state_->halfspaces.add_point_candidates(xyz, count, stride, candidates);
  QueryFilter filter = options.filter;
  filter.bodies = state_->bodies.filter();
  std::erase_if(candidates, [&](Pair candidate) { return !keeps(filter, candidate); });
  ask_predicate(filter, candidates);
  std::vector<uint8_t> overlap(candidates.size());
  std::vector<float> separation(candidates.size());
  // Cannot fail: points are spheres here, and every kind has a kernel against spheres.
  (void)collide(points(xyz, count, stride), state_->bodies.view(), candidates, Detail::contact,
                {.overlap = overlap.data(), .separation = separation.data()},
                {.frame = WitnessFrame::body, .parallelism = parallelism});
  for (size_t i = 0; i < candidates.size(); ++i) {
    if (overlap[i]) hits.push_back({candidates[i].a, candidates[i].b, separation[i]});
  }
}

}  // namespace carom

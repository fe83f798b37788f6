#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/float_environment.h"
#include "carom/narrowphase/collide.h"
#include "carom/queries/queries.h"
#include "carom/results/result_arrays.h"
#include "queries/query_rounds.h"
#include "queries/searches.h"

namespace carom {
namespace {

constexpr RoundSizes kNearestRounds = {.first = 2, .most = 4};
constexpr uint32_t kNone = 0xffffffffu;

NearestHit hit_of(const ResultColumns& found, size_t row, Pair pair) {
  const auto three = [row](const std::array<float*, 3>& columns) -> Eigen::Vector3f {
    return {columns[0][row], columns[1][row], columns[2][row]};
  };
  return {.query = pair.a,
          .body = pair.b,
          .sub_shape = found.sub_b[row],
          .separation = found.separation[row],
          .normal = three(found.normal),
          .point_query = three(found.point_a),
          .point_body = three(found.point_b),
          .status = static_cast<Status>(found.status[row])};
}

class NearestSearch {
 public:
  NearestSearch(const Collidables& queries, const SearchedBodies& bodies, Parallelism parallelism)
      : bodies_(bodies), boxes_(queries, still_), parallelism_(parallelism) {}

  Result<void> run(float within, std::vector<NearestHit>& hits) {
    for (size_t first = 0; first < boxes_.count(); first += kQueriesAtOnce) {
      first_ = first;
      const size_t count = std::min(kQueriesAtOnce, boxes_.count() - first);
      NearestHit none{};
      none.body = kNone;
      none.separation = within;
      best_.assign(count, none);
      limit_.assign(count, std::max(within, 0.0f));
      const auto test = [this](std::span<const Pair> candidates) { return measure(candidates); };
      Result<void> found = search_in_rounds(boxes_, bodies_, SearchFor::near, kNearestRounds, first,
                                            limit_, parallelism_, memory_, test);
      if (!found) {
        hits.clear();
        return found;
      }
      for (const NearestHit& best : best_) {
        if (best.body != kNone) hits.push_back(best);
      }
    }
    return {};
  }

 private:
  Result<void> measure(std::span<const Pair> candidates) {
    found_.resize(candidates.size(), Detail::contact, {ColumnRole::sub_shape});
    Result<void> measured =
        collide(boxes_.queries(), bodies_.bodies, candidates, Detail::contact, found_.columns(),
                {.frame = WitnessFrame::body, .parallelism = parallelism_});
    for (size_t i = 0; measured && i < candidates.size(); ++i) {
      const Pair pair = candidates[i];
      NearestHit& best = best_[pair.a - first_];
      const float separation = found_.columns().separation[i];
      const bool is_nearer =
          separation < best.separation || (separation == best.separation && pair.b < best.body);
      if (!is_nearer || separation == kInfinity) continue;
      best = hit_of(found_.columns(), i, pair);
      limit_[pair.a - first_] = std::max(separation, 0.0f);
    }
    return measured;
  }

  static constexpr float kInfinity = std::numeric_limits<float>::infinity();
  static constexpr SweepView still_{};

  const SearchedBodies& bodies_;
  QueryBoxes boxes_;
  const Parallelism parallelism_;
  size_t first_ = 0;
  std::vector<NearestHit> best_;
  std::vector<float> limit_;
  ResultArrays found_;
  SearchMemory memory_;
};

}  // namespace

Result<void> find_nearest(const Collidables& queries, float within, const SearchedBodies& bodies,
                          std::vector<NearestHit>& hits, Parallelism parallelism) {
  const FloatEnvironment environment;
  hits.clear();
  if (std::isnan(within)) return {};
  return NearestSearch(queries, bodies, parallelism).run(within, hits);
}

Result<void> find_nearest(const Collidables& queries, float within, const Collidables& bodies,
                          std::vector<NearestHit>& hits, const QueryOptions& options) {
  const FloatEnvironment environment;
  const BodyIndex index = index_bodies(bodies, options.parallelism);
  return find_nearest(queries, within, SearchedBodies{bodies, index, options.filter}, hits,
                      options.parallelism);
}

}  // namespace carom

#include "bench/peers/narrowphase/comparison.h"

#include <algorithm>

#include "bench/peers/narrowphase/compare.h"

namespace carom::bench {
namespace {

constexpr double kMostDifferent = 1e-3;  // share of Bullet's decisions

}  // namespace

const RunnerResult* StreamResult::timed(const std::string& runner) const {
  const auto found = std::find_if(runners.begin(), runners.end(),
                                  [&](const RunnerResult& r) { return r.runner == runner; });
  return found == runners.end() ? nullptr : &*found;
}

bool StreamResult::agrees() const {
  const auto compared = static_cast<double>(bullet.pairs - bullet.excluded);
  return wrong.empty() &&
         (is_cast || static_cast<double>(bullet.different) <= kMostDifferent * compared);
}

StreamResult compare(const PeerStreamSpec& spec, size_t pairs, double budget) {
  if (spec.moving != Moving::no) return compare_motions(spec, pairs, budget);
  if (spec.a == ShapeKind::mesh) return compare_meshes(spec, pairs, budget);
  if (spec.b == ShapeKind::mesh) return compare_on_terrain(spec, pairs, budget);
  return compare_pairs(spec, pairs, budget);
}

}  // namespace carom::bench

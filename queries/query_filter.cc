#include "queries/query_filter.h"

#include <algorithm>
#include <cstdint>

namespace carom {
namespace {

bool layers_agree(const QueryFilter& filter, uint32_t body) {
  const PairFilter& of = filter.bodies;
  const bool is_in_mask = ((of.layer ? of.layer[body] : ~0u) & filter.mask) != 0;
  if (filter.layer == 0) return is_in_mask;
  const bool has_in_mask = ((of.mask ? of.mask[body] : ~0u) & filter.layer) != 0;
  return filter.rule == FilterRule::both ? is_in_mask && has_in_mask : is_in_mask || has_in_mask;
}

bool properties_agree(const QueryFilter& filter, uint32_t body) {
  const PairFilter& of = filter.bodies;
  if (filter.owner != 0 && of.owner && of.owner[body] == filter.owner) return false;
  if (filter.space && (of.space ? of.space[body] : 0) != *filter.space) return false;
  if (filter.group != 0 && of.group && of.group[body] == filter.group) return filter.group > 0;
  return layers_agree(filter, body);
}

}  // namespace

bool keeps(const QueryFilter& filter, Pair candidate) {
  return properties_agree(filter, candidate.b) &&
         (filter.excluded.empty() || !std::ranges::binary_search(filter.excluded, candidate));
}

void ask_predicate(const QueryFilter& filter, std::vector<Pair>& candidates) {
  if (!filter.predicate || candidates.empty()) return;
  std::vector<uint8_t> keep(candidates.size(), 1);
  filter.predicate(candidates, keep);
  size_t kept = 0;
  for (size_t i = 0; i < candidates.size(); ++i) {
    candidates[kept] = candidates[i];
    kept += keep[i] != 0;
  }
  candidates.resize(kept);
}

}  // namespace carom

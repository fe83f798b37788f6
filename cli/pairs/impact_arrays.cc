#include "cli/pairs/impact_arrays.h"

#include <cmath>

namespace carom::cli {

bool meets(float toi) { return std::isfinite(toi); }

ImpactArrays::ImpactArrays(const PairSet& pairs)
    : toi(pairs.size()), contacts(results_of(pairs, Detail::contact)) {}

ImpactColumns ImpactArrays::columns() {
  const ResultColumns& contact = contacts.columns();
  return {.toi = toi.data(),
          .status = contact.status,
          .separation = contact.separation,
          .normal = contact.normal,
          .point_a = contact.point_a,
          .point_b = contact.point_b,
          .sub_a = contact.sub_a,
          .sub_b = contact.sub_b};
}

void ImpactArrays::mark_meetings() {
  for (size_t i = 0; i < toi.size(); ++i) contacts.columns().overlap[i] = meets(toi[i]);
}

}  // namespace carom::cli

#include "cli/pairs/impact_arrays.h"

#include <cmath>

namespace carom::cli {

bool meets(float toi) { return std::isfinite(toi); }

ImpactArrays::ImpactArrays(const PairSet& pairs)
    : toi_(pairs.size()), contact_(pairs, Detail::contact) {}

ImpactColumns ImpactArrays::columns() {
  const ResultColumns contact = contact_.columns();
  return {.toi = toi_.data(),
          .status = contact.status,
          .separation = contact.separation,
          .normal = contact.normal,
          .point_a = contact.point_a,
          .point_b = contact.point_b,
          .sub_a = contact.sub_a,
          .sub_b = contact.sub_b};
}

ImpactArrays::Row ImpactArrays::row(size_t index) const {
  Row row{toi_[index], contact_.row(index)};
  row.contact.overlap = meets(row.toi);
  return row;
}

io::PairResults ImpactArrays::results() const {
  io::PairResults results = contact_.results();
  results.toi = toi_;
  for (size_t i = 0; i < toi_.size(); ++i) results.overlap[i] = meets(toi_[i]);
  return results;
}

}  // namespace carom::cli

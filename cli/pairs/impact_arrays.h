// Memory for times of impact and for the contacts at those times.
#pragma once

#include <vector>

#include "carom/impacts/time_of_impact.h"
#include "cli/pairs/pair_set.h"

namespace carom::cli {

class ImpactArrays {
 public:
  explicit ImpactArrays(const PairSet& pairs);

  // Columns to write to; sub-shapes only if a body can have them.
  ImpactColumns columns();

  struct Row {
    float toi;
    PairColumns::Row contact;  // `overlap`: whether they meet
  };
  Row row(size_t index) const;

  io::PairResults results() const;

 private:
  std::vector<float> toi_;
  PairColumns contact_;
};

// Whether a time of impact means that the bodies meet.
bool meets(float toi);

}  // namespace carom::cli

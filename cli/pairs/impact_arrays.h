// Memory for times of impact and for the contacts at those times.
#pragma once

#include <vector>

#include "carom/impacts/time_of_impact.h"
#include "cli/pairs/pair_set.h"

namespace carom::cli {

struct ImpactArrays {
  std::vector<float> toi;
  ResultArrays contacts;  // with sub-shapes only if a body can have them

  explicit ImpactArrays(const PairSet& pairs);

  // Columns to write to.
  ImpactColumns columns();
  // Sets the overlaps of the contacts to whether the bodies meet.
  void mark_meetings();
};

// Whether a time of impact means that the bodies meet.
bool meets(float toi);

}  // namespace carom::cli

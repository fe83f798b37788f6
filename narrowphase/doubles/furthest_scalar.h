// The support point of a core: the scalar form.
#pragma once

#include <cmath>

#include "narrowphase/doubles/core.h"

namespace carom::scalar {

inline size_t furthest_point(const Core& core, const CoreVector& way) {
  size_t furthest = 0;
  double most = -HUGE_VAL;
  for (size_t i = 0; i < core.size(); ++i) {
    const double height = dot(way, core.point(i));
    if (!(height > most)) continue;
    most = height;
    furthest = i;
  }
  return furthest;
}

}  // namespace carom::scalar

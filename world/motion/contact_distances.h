// From which separation the pairs of bodies have contacts.
#pragma once

#include <algorithm>
#include <cstdint>

#include "base/grown.h"
#include "carom/results/pair.h"

namespace carom {

// The distance of a pair is the larger one of its bodies' distances; no body has less than the
// world.
struct ContactDistances {
  float of_world = 0;
  const float* of_body = nullptr;  // one a body; nullptr: 0 for all

  bool any() const { return of_world > 0 || of_body; }
  float of(uint32_t body) const { return of_body ? std::max(of_world, of_body[body]) : of_world; }
  float of(Pair pair) const { return std::max(of(pair.a), of(pair.b)); }

  // By how much the bounds of a body grow.
  float growth(uint32_t body) const {
    const float own = of(body);
    return own > 0 ? contact_growth(of_world, own) : 0;
  }
};

}  // namespace carom

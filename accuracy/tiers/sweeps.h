// Measures how answers depend on the gap, the distance from the origin and the angle between
// shapes.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "accuracy/tiers/effort.h"
#include "accuracy/tiers/failures.h"

namespace carom::accuracy {

// Adds one row for each setting: shares of wrong and undecided answers at gaps that are multiples
// of the float32 rounding of L.
void measure_gaps(const NamedKinds& kinds, const Effort& effort, uint64_t seed,
                  nlohmann::ordered_json& rows, Failures& failures);

// Adds one row for each position type: the error of separations at distances from the origin in L,
// measured on the user's intended float64 positions.
void measure_distances(const NamedKinds& kinds, const Effort& effort, uint64_t seed,
                       nlohmann::ordered_json& rows);

// Adds one row for each setting, if the angle has a meaning for these kinds: errors at small
// angles.
void measure_angles(const NamedKinds& kinds, const Effort& effort, uint64_t seed,
                    nlohmann::ordered_json& rows, Failures& failures);

}  // namespace carom::accuracy

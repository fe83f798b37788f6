// What answers depend on: how close to touching, how far from the origin, how nearly parallel.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "accuracy/tiers/effort.h"
#include "accuracy/tiers/failures.h"

namespace carom::accuracy {

// One row a setting: shares of wrong and undecided answers at gaps of so many steps of one float32
// of L.
void measure_gaps(const NamedKinds& kinds, const Effort& effort, uint64_t seed,
                  nlohmann::ordered_json& rows, Failures& failures);

// One row a type of positions: the error of separations of shapes where the user meant them, which
// is in float64, at distances from the origin in L.
void measure_distances(const NamedKinds& kinds, const Effort& effort, uint64_t seed,
                       nlohmann::ordered_json& rows);

// One row a setting, for kinds that can be turned against each other: errors at small angles.
void measure_angles(const NamedKinds& kinds, const Effort& effort, uint64_t seed,
                    nlohmann::ordered_json& rows, Failures& failures);

}  // namespace carom::accuracy

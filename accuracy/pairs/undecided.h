// Measures how many pairs of a scene the certified tier leaves undecided, and what proofs cost.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace carom::accuracy {

// Adds one row for each scene: random shapes, stacks at rest, near-parallel boxes.
void measure_undecided(size_t pairs, int rounds, uint64_t seed, nlohmann::ordered_json& rows);

}  // namespace carom::accuracy

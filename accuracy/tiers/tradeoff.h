// Measures one pair of kinds with every setting: the speed on random pairs, and the accuracy on
// these and on all families of hard pairs.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "accuracy/tiers/effort.h"
#include "accuracy/tiers/failures.h"

namespace carom::accuracy {

struct TradeoffRows {
  nlohmann::ordered_json& tradeoff;
  nlohmann::ordered_json& matrix;
  nlohmann::ordered_json& atlas;
};

// Adds rows to the arrays in `rows`.
void measure_tradeoff(const NamedKinds& kinds, const Effort& effort, uint64_t seed,
                      const TradeoffRows& rows, Failures& failures);

// The same of a pair of kinds with a round shape: random pairs alone, and the settings that promise
// right answers up to rounding. The atlas stays as it is.
void measure_round(const NamedKinds& kinds, const Effort& effort, uint64_t seed,
                   const TradeoffRows& rows, Failures& failures);

}  // namespace carom::accuracy

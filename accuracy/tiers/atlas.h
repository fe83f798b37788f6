// Judges the contenders on the families of hard pairs.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

#include "accuracy/tiers/contenders.h"
#include "accuracy/tiers/effort.h"
#include "accuracy/tiers/failures.h"

namespace carom::accuracy {

// Adds a row for the standard setting at every detail, for each family and position type. Also
// checks the promises of the certified and exact tiers. Returns the tally of each contender over
// all these pairs at detail contact.
std::vector<Tally> judge_families(const NamedKinds& kinds, const Effort& effort, uint64_t seed,
                                  std::span<const std::unique_ptr<Contender>> contenders,
                                  nlohmann::ordered_json& rows, Failures& failures);

}  // namespace carom::accuracy

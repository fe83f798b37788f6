// The entries "fidelity" and "reuse" of accuracy.json.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "accuracy/scenes/fidelity.h"

namespace carom::accuracy {

// An object of the two lists. What is infinite is null.
nlohmann::ordered_json to_json(const FidelityReport& report);

}  // namespace carom::accuracy

// The entries "fidelity" and "reuse" of accuracy.json.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "accuracy/scenes/fidelity.h"

namespace carom::accuracy {

// An object with the two lists. Infinite numbers become null.
nlohmann::ordered_json to_json(const FidelityReport& report);

}  // namespace carom::accuracy

// Writes the results of streams as a table and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "bench/peers/narrowphase/comparison.h"

namespace carom::bench {

void print(const StreamResult& result);

nlohmann::ordered_json streams_json(const std::vector<StreamResult>& results);

}  // namespace carom::bench

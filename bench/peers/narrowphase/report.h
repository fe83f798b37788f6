// Writes the results of streams as a table and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "bench/peers/narrowphase/comparison.h"
#include "bench/peers/narrowphase/exact.h"

namespace carom::bench {

void print(const StreamResult& result);
void print(const ExactResult& result);

nlohmann::ordered_json streams_json(const std::vector<StreamResult>& results);
nlohmann::ordered_json exact_json(const std::vector<ExactResult>& results);

}  // namespace carom::bench

// Writes the results of scenes as a table and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "bench/peers/broadphase/comparison.h"

namespace carom::bench {

void print(const SceneResult& result);

nlohmann::ordered_json scenes_json(const std::vector<SceneResult>& results);

}  // namespace carom::bench

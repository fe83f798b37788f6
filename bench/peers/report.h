// The comparison as tables and as JSON.
#pragma once

#include <string>
#include <vector>

#include "bench/peers/comparison.h"
#include "carom/kernel/result.h"

namespace carom::bench {

void print(const SceneResult& result);

Result<void> write_json(const std::string& path, const std::vector<SceneResult>& results,
                        const TimeLimits& limits);

}  // namespace carom::bench

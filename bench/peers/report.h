// Writes all comparisons into one JSON file.
#pragma once

#include <string>
#include <vector>

#include "bench/peers/broadphase/comparison.h"
#include "bench/peers/narrowphase/comparison.h"
#include "bench/peers/narrowphase/exact.h"
#include "carom/base/result.h"

namespace carom::bench {

struct Comparisons {
  TimeLimits limits;
  std::vector<SceneResult> scenes;
  std::vector<StreamResult> streams;
  std::vector<ExactResult> exact;
};

Result<void> write_json(const std::string& path, const Comparisons& comparisons);

}  // namespace carom::bench

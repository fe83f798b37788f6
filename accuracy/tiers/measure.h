// All measurements of `carom accuracy`, as one document.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "accuracy/pairs/oracle_pairs.h"

namespace carom::accuracy {

struct MeasureOptions {
  std::vector<NamedKinds> kinds;
  bool is_long = false;
  uint64_t seed = 1;
};

// Reports that `done` of `all` steps are done.
using MeasureProgress = std::function<void(size_t done, size_t all)>;

// The document of the page (accuracy/page.html); `failures` lists broken promises. "undecided" is
// empty unless all kinds are measured. "reuse" and "fidelity" are always empty, because they need
// scenes (fidelity_json.h).
nlohmann::ordered_json measure(const MeasureOptions& options, const MeasureProgress& progress);

}  // namespace carom::accuracy

// Exact decisions: Carom's exact tier beside CGAL's exact kernel, on the same pairs.
#pragma once

#include <string>
#include <vector>

#include "bench/peers/narrowphase/comparison.h"

namespace carom::bench {

struct ExactResult {
  std::string pair;
  bool touching = false;  // to within rounding, or random
  size_t pairs = 0;
  double hit_percent = 0;
  size_t different = 0;               // pairs that CGAL decides otherwise
  std::vector<RunnerResult> runners;  // Carom's tiers "standard" and "exact"; "cgal"
};

// Pairs whose names begin with `names`, each random and touching. `pairs`: of Carom's passes, at
// most; CGAL tries the first of them. `budget`: seconds of passes for each runner.
std::vector<ExactResult> compare_exact(const std::string& names, size_t pairs, double budget);

}  // namespace carom::bench

// Counts and errors of the answers to many pairs.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace carom::accuracy {

// Lengths are shares of L (exact_pair.h).
struct Tally {
  size_t pairs = 0;
  size_t unjudged = 0;        // pairs that the oracle cannot decide
  size_t false_overlaps = 0;  // of decisions
  size_t missed = 0;
  size_t undecided = 0;
  size_t not_finite = 0;
  double worst_wrong_gap = 0;
  std::vector<float> errors;  // of separations; of manifolds: excess depth
  double error_worst = 0;
  double regret_worst = 0;
  size_t broken = 0;                  // answers that break the promise
  std::vector<std::string> examples;  // the first few of the broken ones

  size_t wrong() const { return false_overlaps + missed; }
  // The error that this share of all answers does not exceed.
  double error_quantile(double share) const;

  void add_error(double share);
  void add_example(const std::string& text);
  void add(const Tally& other);
};

}  // namespace carom::accuracy

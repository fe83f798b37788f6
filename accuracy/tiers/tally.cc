#include "accuracy/tiers/tally.h"

#include <algorithm>

namespace carom::accuracy {
namespace {

constexpr size_t kMostExamples = 2;

}  // namespace

double Tally::error_quantile(double share) const {
  if (errors.empty()) return 0;
  std::vector<float> sorted = errors;
  const auto rank = static_cast<size_t>(share * static_cast<double>(sorted.size() - 1));
  const auto place = sorted.begin() + static_cast<ptrdiff_t>(rank);
  std::nth_element(sorted.begin(), place, sorted.end());
  return *place;
}

void Tally::add_error(double share) {
  errors.push_back(static_cast<float>(share));
  error_worst = std::max(error_worst, share);
}

void Tally::add_example(const std::string& text) {
  if (examples.size() < kMostExamples) examples.push_back(text);
}

void Tally::add(const Tally& other) {
  pairs += other.pairs;
  unjudged += other.unjudged;
  false_overlaps += other.false_overlaps;
  missed += other.missed;
  undecided += other.undecided;
  not_finite += other.not_finite;
  worst_wrong_gap = std::max(worst_wrong_gap, other.worst_wrong_gap);
  errors.insert(errors.end(), other.errors.begin(), other.errors.end());
  error_worst = std::max(error_worst, other.error_worst);
  regret_worst = std::max(regret_worst, other.regret_worst);
  broken += other.broken;
  for (const std::string& example : other.examples) add_example(example);
}

}  // namespace carom::accuracy

#include "cli/support/statistics.h"

#include <algorithm>
#include <numeric>

namespace carom::cli {
namespace {

double median_of_sorted(const std::vector<double>& values) {
  size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return median_of_sorted(values);
}

Summary summarize(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  size_t rank = (values.size() * 99 + 99) / 100;
  double sum = std::accumulate(values.begin(), values.end(), 0.0);
  return {median_of_sorted(values), values.front(), values[rank - 1],
          sum / static_cast<double>(values.size())};
}

}  // namespace carom::cli

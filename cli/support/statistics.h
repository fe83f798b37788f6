// Summaries of measured times.
#pragma once

#include <vector>

namespace carom::cli {

// The middle value; for an even number the mean of the two in the middle; 0 if empty.
double median(std::vector<double> values);

struct Summary {
  double median = 0;
  double min = 0;
  double p99 = 0;  // the least value that at least 99 % of the values do not exceed
  double mean = 0;
};
Summary summarize(std::vector<double> values);

}  // namespace carom::cli

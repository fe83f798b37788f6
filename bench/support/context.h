// Machine, compiler, flags and commit, for the head of the report.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace carom::bench {

std::vector<std::pair<std::string, std::string>> context();

// Gives it to Google Benchmark.
void add_context();

}  // namespace carom::bench

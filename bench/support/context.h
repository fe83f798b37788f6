// Machine, compiler, flags and commit, for the head of the report.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace carom::bench {

std::vector<std::pair<std::string, std::string>> context();

// Adds these to Google Benchmark's context.
void add_context();

}  // namespace carom::bench

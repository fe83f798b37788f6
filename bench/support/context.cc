#include "bench/support/context.h"

#include <benchmark/benchmark.h>

#include <fstream>

#include "carom/simd/isa.h"
#include "carom_build_info.h"

namespace carom::bench {
namespace {

// As Linux calls it; "unknown" elsewhere.
std::string cpu_name() {
  std::ifstream file("/proc/cpuinfo");
  std::string line;
  while (std::getline(file, line)) {
    const size_t value = line.find(": ");
    if (line.starts_with("model name") && value != std::string::npos) return line.substr(value + 2);
  }
  return "unknown";
}

std::string isa_names() {
  std::string names;
  for (const Isa isa : usable_isas()) names += (names.empty() ? "" : " ") + std::string(name(isa));
  return names;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> context() {
  return {{"carom_version", build_info::kVersion},
          {"commit", build_info::kCommit},
          {"compiler", build_info::kCompiler},
          {"flags", build_info::kFlags},
          {"build_type", build_info::kBuildType},
          {"highway", build_info::kHighwayVersion},
          {"onetbb", build_info::kTbbVersion},
          {"cpu", cpu_name()},
          {"isas", isa_names()}};
}

void add_context() {
  for (const auto& [key, value] : context()) benchmark::AddCustomContext(key, value);
}

}  // namespace carom::bench

#include "bench/support/context.h"

#include <benchmark/benchmark.h>

#include <fstream>
#include <string>

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

void add_context() {
  benchmark::AddCustomContext("carom_version", build_info::kVersion);
  benchmark::AddCustomContext("commit", build_info::kCommit);
  benchmark::AddCustomContext("compiler", build_info::kCompiler);
  benchmark::AddCustomContext("flags", build_info::kFlags);
  benchmark::AddCustomContext("build_type", build_info::kBuildType);
  benchmark::AddCustomContext("highway", build_info::kHighwayVersion);
  benchmark::AddCustomContext("onetbb", build_info::kTbbVersion);
  benchmark::AddCustomContext("cpu", cpu_name());
  benchmark::AddCustomContext("isas", isa_names());
}

}  // namespace carom::bench

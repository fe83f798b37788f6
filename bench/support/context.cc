#include "bench/support/context.h"

#include <benchmark/benchmark.h>

#include "carom/simd/isa.h"
#include "carom_build_info.h"
#include "io/cpu_name.h"

namespace carom::bench {
namespace {

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
          {"cpu", io::cpu_name()},
          {"isas", isa_names()}};
}

void add_context() {
  for (const auto& [key, value] : context()) benchmark::AddCustomContext(key, value);
}

}  // namespace carom::bench

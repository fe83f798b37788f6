// The report of `carom run` as JSON and as text.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/run/replay.h"
#include "cli/support/json_output.h"

namespace carom::cli {

struct RunReport {
  std::string scene;
  uint64_t bodies = 0;
  uint64_t frames = 0;
  int threads = 1;
  std::string isa;
  std::string tier;
  Accuracy accuracy;
  std::string detail;
  std::string detection;
  std::vector<std::string> pair_kinds;  // possible with the scene's bodies
  float margin = 0;                     // metres
  int dop_bounds = 0;                   // directions; 0: none
  WorldMemory memory;                   // at the end
  uint64_t peak_rss_bytes = 0;
  RunRecord record;
};

// The peak memory of this process.
uint64_t peak_rss_bytes();

// As JSON if that is wanted, as text otherwise.
Result<void> write_report(const RunReport& report, JsonOutput& json, const Console& console);

}  // namespace carom::cli

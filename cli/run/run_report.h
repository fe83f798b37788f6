// The report of `carom run` as JSON and as text.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "carom/ladders/build_ladder.h"
#include "cli/run/replay.h"
#include "cli/run/world_options.h"
#include "cli/support/json_output.h"

namespace carom::cli {

struct RunReport {
  std::string scene;
  uint64_t bodies = 0;
  uint64_t frames = 0;
  int threads = 1;
  std::string isa;
  RunSettings settings;
  std::vector<std::string> pair_kinds;  // possible with the scene's bodies
  std::vector<LadderReport> ladders;    // of its shapes, with a tolerance
  WorldMemory memory;                   // at the end
  uint64_t peak_rss_bytes = 0;
  RunRecord record;
};

// As JSON if that is wanted, as text otherwise.
Result<void> write_report(const RunReport& report, const WorldOptions& options, JsonOutput& json,
                          const Console& console);

}  // namespace carom::cli

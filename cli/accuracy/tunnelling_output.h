// The measurements of `carom tunnelling` as JSON and as text.
#pragma once

#include <string>

#include "accuracy/tunnelling/tunnelling.h"
#include "cli/support/json_output.h"

namespace carom::cli {

struct TunnellingRun {
  std::string scene;
  double dt = 0;
  int threads = 1;
  std::string isa;
  accuracy::TunnellingOptions options;
  accuracy::TunnellingReport report;
};

// As JSON if that is wanted, as text otherwise.
Result<void> write_run(const TunnellingRun& run, JsonOutput& json, const Console& console);

}  // namespace carom::cli

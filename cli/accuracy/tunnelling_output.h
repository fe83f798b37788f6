// The measurements of `carom tunnelling` as JSON and as text.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <ostream>
#include <string>

#include "accuracy/tunnelling/tunnelling.h"

namespace carom::cli {

struct TunnellingRun {
  std::string scene;
  double dt = 0;
  int threads = 1;
  std::string isa;
  accuracy::TunnellingOptions options;
  accuracy::TunnellingReport report;
};

nlohmann::ordered_json to_json(const TunnellingRun& run);
void print(const TunnellingRun& run, std::ostream& out);

}  // namespace carom::cli

// The verify command, with the system to be verified as a parameter.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/support/console.h"
#include "cli/verify/verify_system.h"

namespace carom::cli {

struct VerifyOptions {
  std::vector<std::string> sources;  // scenes, generators, files of pairs; empty: the built-in set
  uint64_t frames = 0;               // of every scene; 0: all
  std::optional<int> threads;        // absent: as many as the machine runs at once, 2 to 8
};

// Exit code: 0 only if everything could be verified and agreed.
Result<int> verify(const VerifyOptions& options, System& system, const Console& console);

}  // namespace carom::cli

// The verify command; the verified system is a parameter.
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
  uint64_t frames = 0;               // of each scene; 0: all
  std::optional<int> threads;  // absent: the machine's hardware threads, at least 2, at most 8
};

// Exit code: 0 only if everything could be verified and agreed.
Result<int> verify(const VerifyOptions& options, System& system, const Console& console);

}  // namespace carom::cli

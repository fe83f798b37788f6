// The program as a process: its arguments, its streams and its signals.
#pragma once

#include <span>

#include "cli/commands.h"

namespace carom::cli {

// What main() does: returns the exit code. Temporary files are removed where a signal ends the
// process.
int run_process(std::span<const AddCommand> commands, int argc, char** argv);

}  // namespace carom::cli

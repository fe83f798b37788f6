// The program as a function, which tests can call.
#pragma once

#include <iosfwd>
#include <span>
#include <string>

#include "cli/commands.h"

namespace carom::cli {

// Runs one command line (without the program's name), which may name any of `commands`, and returns
// the exit code.
int run_cli(std::span<const AddCommand> commands, std::span<const std::string> arguments,
            std::ostream& out, std::ostream& err);

}  // namespace carom::cli

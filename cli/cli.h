// The program as a function, which tests can call.
#pragma once

#include <iosfwd>
#include <span>
#include <string>

namespace carom::cli {

// Runs one command line (without the program's name) and returns the exit code.
int run_cli(std::span<const std::string> arguments, std::ostream& out, std::ostream& err);

}  // namespace carom::cli

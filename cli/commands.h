// The commands. Each adds itself and its options to the program, and sets `action` when the command
// line names it.
#pragma once

#include <functional>

#include "carom/base/result.h"
#include "cli/support/console.h"

namespace CLI {
class App;
}

namespace carom::cli {

// Does the work and returns the exit code.
using Action = std::function<Result<int>(const Console&)>;

void add_run_command(CLI::App& program, Action& action);
void add_pairs_command(CLI::App& program, Action& action);
void add_verify_command(CLI::App& program, Action& action);
void add_advise_command(CLI::App& program, Action& action);
void add_accuracy_command(CLI::App& program, Action& action);
void add_tunnelling_command(CLI::App& program, Action& action);
void add_check_command(CLI::App& program, Action& action);
void add_generate_command(CLI::App& program, Action& action);
void add_info_command(CLI::App& program, Action& action);

}  // namespace carom::cli

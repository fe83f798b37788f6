// The commands. Each adds itself, its options and its action to the program.
#pragma once

#include <span>

namespace carom::cli {

class CommandLine;

using AddCommand = void (*)(CommandLine& program);

void add_run_command(CommandLine& program);
void add_pairs_command(CommandLine& program);
void add_verify_command(CommandLine& program);
void add_advise_command(CommandLine& program);
void add_accuracy_command(CommandLine& program);
void add_tunnelling_command(CommandLine& program);
void add_check_command(CommandLine& program);
void add_generate_command(CommandLine& program);
void add_info_command(CommandLine& program);

// In the order in which `carom --help` lists them.
std::span<const AddCommand> all_commands();

}  // namespace carom::cli

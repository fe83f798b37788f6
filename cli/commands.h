// The commands. Each adds itself, its options and its action to the program.
#pragma once

namespace carom::cli {

class CommandLine;

void add_run_command(CommandLine& program);
void add_pairs_command(CommandLine& program);
void add_verify_command(CommandLine& program);
void add_advise_command(CommandLine& program);
void add_accuracy_command(CommandLine& program);
void add_tunnelling_command(CommandLine& program);
void add_check_command(CommandLine& program);
void add_generate_command(CommandLine& program);
void add_info_command(CommandLine& program);

}  // namespace carom::cli

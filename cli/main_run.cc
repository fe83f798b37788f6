// The program with the commands that `make run` runs, and no others: it is built in less time.
#include "cli/process.h"

int main(int argc, char** argv) {
  constexpr carom::cli::AddCommand kCommands[] = {
      carom::cli::add_run_command, carom::cli::add_verify_command, carom::cli::add_info_command};
  return carom::cli::run_process(kCommands, argc, argv);
}

#include "cli/process.h"

#include <csignal>
#include <iostream>
#include <string>
#include <vector>

#include "cli/cli.h"
#include "io/files/atomic_file.h"

namespace carom::cli {
namespace {

// raise() blocks until the handler returns; then the default action ends the program.
extern "C" void end_on_signal(int signal) {
  io::remove_temporary_files();
  std::raise(signal);
}

// Makes an interrupted process remove its temporary files.
void install_handlers() {
  for (int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    if (sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = end_on_signal;
    action.sa_flags = SA_RESETHAND;
    sigaction(signal, &action, nullptr);
  }
}

}  // namespace

int run_process(std::span<const AddCommand> commands, int argc, char** argv) {
  install_handlers();
  const std::vector<std::string> arguments(argv + (argc > 0), argv + argc);
  return run_cli(commands, arguments, std::cout, std::cerr);
}

}  // namespace carom::cli

#include "cli/cli.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <new>
#include <vector>

#include "carom_build_info.h"
#include "cli/commands.h"
#include "cli/support/options.h"

namespace carom::cli {
namespace {

std::string command_names(CLI::App& program) {
  std::string names;
  for (const CLI::App* command : program.get_subcommands({})) {
    names += (names.empty() ? "" : ", ") + command->get_name();
  }
  return names;
}

// Reports missing and unknown commands more clearly than CLI11.
Result<void> check_command(CLI::App& program, std::span<const std::string> arguments) {
  if (arguments.empty()) {
    return Error{"no command given (commands: " + command_names(program) + "; see carom --help)"};
  }
  const std::string& word = arguments.front();
  if (word == "--help" || word == "-h" || word == "--version") return {};
  for (const CLI::App* command : program.get_subcommands({})) {
    if (command->get_name() == word) return {};
  }
  return Error{"unknown command '" + word + "' (commands: " + command_names(program) + ")"};
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

int run_program(std::span<const std::string> arguments, const Console& console) {
  CLI::App program("Collision detection for many bodies", "carom");
  program.set_version_flag("--version", std::string("carom ") + build_info::kVersion);
  program.require_subcommand(1);
  Action action;
  add_run_command(program, action);
  add_pairs_command(program, action);
  add_verify_command(program, action);
  add_advise_command(program, action);
  add_accuracy_command(program, action);
  add_tunnelling_command(program, action);
  add_check_command(program, action);
  add_generate_command(program, action);
  add_info_command(program, action);

  if (Result<void> known = check_command(program, arguments); !known) {
    console.error(known.error());
    return 2;
  }
  try {
    program.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return program.exit(error, console.out, console.err);
    console.error({first_line(error.what())});
    return 2;
  }
  Result<void> isa = check_isa_variable();
  Result<int> code = isa ? action(console) : isa.error();
  if (code) return *code;
  console.error(code.error());
  return 1;
}

}  // namespace

int run_cli(std::span<const std::string> arguments, std::ostream& out, std::ostream& err) {
  Console console{out, err, &err == &std::cerr && isatty(STDERR_FILENO) == 1};
  try {
    int code = run_program(arguments, console);
    out.flush();
    if (out || code != 0) return code;
    console.error({"standard output could not be written"});
  } catch (const std::bad_alloc&) {
    console.error({"out of memory"});
  } catch (const std::exception& error) {
    console.error({first_line(error.what())});
  }
  return 1;
}

}  // namespace carom::cli

#include "cli/cli.h"

#include <unistd.h>

#include <algorithm>
#include <exception>
#include <iostream>
#include <new>
#include <vector>

#include "carom_build_info.h"
#include "cli/support/command_line.h"
#include "cli/support/options.h"
#include "io/printable.h"

namespace carom::cli {
namespace {

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// What CLI11 would report less clearly.
Result<void> check_command(const std::vector<std::string>& commands,
                           std::span<const std::string> arguments) {
  if (arguments.empty()) {
    return Error{"no command given (commands: " + joined(commands) + "; see carom --help)"};
  }
  const std::string& word = arguments.front();
  if (word == "--help" || word == "-h" || word == "--version") return {};
  if (std::find(commands.begin(), commands.end(), word) != commands.end()) return {};
  return Error{"unknown command " + io::quoted_name(word) + " (commands: " + joined(commands) +
               ")"};
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

int run_program(std::span<const AddCommand> commands, std::span<const std::string> arguments,
                const Console& console) {
  CommandLine program("carom", "Collision detection for many bodies",
                      std::string("carom ") + build_info::kVersion);
  for (const AddCommand add : commands) add(program);

  if (Result<void> known = check_command(program.command_names(), arguments); !known) {
    console.error(known.error());
    return 2;
  }
  const Result<Action> action = program.parse(arguments, console);
  if (!action) {
    console.error({first_line(action.error().message)});
    return 2;
  }
  if (!*action) return 0;
  Result<void> isa = check_isa_variable();
  Result<int> code = isa ? (*action)(console) : isa.error();
  if (code) return *code;
  console.error(code.error());
  return 1;
}

}  // namespace

int run_cli(std::span<const AddCommand> commands, std::span<const std::string> arguments,
            std::ostream& out, std::ostream& err) {
  Console console{out, err, &err == &std::cerr && isatty(STDERR_FILENO) == 1};
  try {
    int code = run_program(commands, arguments, console);
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

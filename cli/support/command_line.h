// The command line: commands with their options. The library behind it, CLI11, takes seconds to
// compile; command_line.cc alone includes it.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "carom/base/result.h"
#include "cli/support/console.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace carom::cli {

// Does the work and returns the exit code.
using Action = std::function<Result<int>(const Console&)>;

// An option or an argument of a command.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  Option required();
  // In the help text: the value that the variable has now.
  Option show_default();

  // Both bounds are allowed. Their type is part of the help text.
  Option between(int low, int high);
  Option between(uint64_t low, uint64_t high);
  Option between(double low, double high);
  Option one_of(std::initializer_list<const char*> words);
  // Refuses an empty name (a script's unset variable).
  Option file_name();
  // Refuses the command line if it has `other`, too, which the command must have already.
  Option excludes(const std::string& other);

  // A vector: one text holds several values.
  Option separated_by(char separator);
  // A vector: the option may be given several times.
  Option take_all();

 private:
  CLI::Option* option_;
};

// A command of the program. CommandLine::parse() sets the variables of its options, so they must
// live until then; an action that owns them keeps them alive.
class Command {
 public:
  Command(CLI::App& app, Action& chosen) : app_(&app), chosen_(&chosen) {}

  Option add_option(const std::string& name, std::string& value, const std::string& help);
  Option add_option(const std::string& name, int& value, const std::string& help);
  Option add_option(const std::string& name, uint64_t& value, const std::string& help);
  Option add_option(const std::string& name, double& value, const std::string& help);
  Option add_option(const std::string& name, std::optional<int>& value, const std::string& help);
  Option add_option(const std::string& name, std::vector<int>& value, const std::string& help);
  Option add_option(const std::string& name, std::vector<std::string>& value,
                    const std::string& help);
  // True if the command line has the flag.
  void add_flag(const std::string& name, bool& value, const std::string& help);

  // The end of the help text.
  void footer(const std::string& text);
  // What to do if the command line names this command.
  void run(Action action);

 private:
  CLI::App* app_;
  Action* chosen_;
};

class CommandLine {
 public:
  // `version` is what --version prints.
  CommandLine(const std::string& name, const std::string& help, const std::string& version);
  ~CommandLine();

  Command add_command(const std::string& name, const std::string& help);
  // In the order in which they were added.
  std::vector<std::string> command_names() const;

  // The action of the command that the arguments name. Null after --help and --version: parse() has
  // printed the text, and nothing is left to do.
  Result<Action> parse(std::span<const std::string> arguments, const Console& console);

 private:
  std::unique_ptr<CLI::App> app_;
  Action chosen_;
};

const char* cli11_version();

}  // namespace carom::cli

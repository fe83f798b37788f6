// The settings of a world that `carom run` offers.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "carom/base/result.h"
#include "carom/world/world.h"

namespace carom::cli {

class Command;
class Table;
class WorldOption;  // one setting: see world_options.cc
struct RunReport;

struct RunSettings {
  WorldSettings world;
  Detection detection = Detection::discrete;  // of dynamic bodies
};

// All of them, in the order of --help, of the JSON and of the table.
class WorldOptions {
 public:
  WorldOptions();
  ~WorldOptions();

  // The command line sets variables of this object, so it must live until it has been parsed.
  void add_to(Command& command);
  // The settings of the command line; those that no option sets have their defaults.
  Result<RunSettings> read() const;

  // Adds the settings that a run used, as the world understood them.
  void add_json(const RunReport& report, nlohmann::ordered_json& json) const;
  void add_rows(const RunReport& report, Table& table) const;

  // The options that choose these settings: " --margin 0.1 --no-cache". Empty for the defaults.
  std::string text_of(const RunSettings& settings) const;

 private:
  std::vector<std::unique_ptr<WorldOption>> list_;
};

// "pairs", "overlap", "contact", "manifold".
const char* name_of(Detail detail);

}  // namespace carom::cli

// carom info: describes this build and what it supports on this machine.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <thread>

#include "carom_build_info.h"
#include "cli/commands.h"
#include "cli/support/options.h"
#include "cli/support/pair_kinds.h"
#include "cli/support/table.h"

namespace carom::cli {
namespace {

// "sphere-sphere, sphere-aabb, ...": all pairs of kinds that have a kernel.
std::string supported_pairs() {
  BodiesOfKind two_of_each;
  two_of_each.fill(2);
  std::string text;
  for (const std::string& pair : pair_kinds(two_of_each)) {
    text += (text.empty() ? "" : ", ") + pair;
  }
  return text;
}

std::string json_version() {
  return std::to_string(NLOHMANN_JSON_VERSION_MAJOR) + "." +
         std::to_string(NLOHMANN_JSON_VERSION_MINOR) + "." +
         std::to_string(NLOHMANN_JSON_VERSION_PATCH);
}

Result<int> info(const Console& console) {
  Table table({"carom", build_info::kVersion});
  table.add({"commit", build_info::kCommit});
  table.add({"build type", build_info::kBuildType});
  table.add({"compiler", build_info::kCompiler});
  table.add({"flags", build_info::kFlags});
  table.add({"ISAs compiled in", join_names(compiled_isas())});
  table.add({"ISAs usable here", join_names(usable_isas())});
  table.add({"ISA in use", name(active_isa())});
  table.add({"threads", std::to_string(std::thread::hardware_concurrency())});
  table.add({"pair kinds", supported_pairs()});
  table.add({"Highway", build_info::kHighwayVersion});
  table.add({"oneTBB", build_info::kTbbVersion});
  table.add({"Eigen", build_info::kEigenVersion});
  table.add({"libzip", build_info::kLibzipVersion});
  table.add({"Qhull", build_info::kQhullVersion});
  table.add({"assimp", build_info::kAssimpVersion});
  table.add({"CLI11", CLI11_VERSION});
  table.add({"nlohmann-json", json_version()});
  table.print(console.out);
  return 0;
}

}  // namespace

void add_info_command(CLI::App& program, Action& action) {
  CLI::App& command =
      *program.add_subcommand("info", "Version, build flags, instruction sets, libraries");
  command.callback([&action] { action = info; });
}

}  // namespace carom::cli

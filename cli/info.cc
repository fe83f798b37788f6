// carom info: what this build is and what it can do here.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <thread>

#include "carom/narrowphase/collide.h"
#include "carom_build_info.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/table.h"

namespace carom::cli {
namespace {

// "sphere-sphere, sphere-aabb, ...": all pairs of kinds that have a kernel.
std::string supported_pairs() {
  std::string text;
  for (int a = 0; a < kShapeKindCount; ++a) {
    for (int b = a; b < kShapeKindCount; ++b) {
      auto kind_a = static_cast<ShapeKind>(a);
      auto kind_b = static_cast<ShapeKind>(b);
      if (!supports(kind_a, kind_b)) continue;
      text += (text.empty() ? "" : ", ") + std::string(name(kind_a)) + "-" + name(kind_b);
    }
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

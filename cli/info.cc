// carom info: what this build is and what it can do here.
#include <thread>

#include "carom_build_info.h"
#include "cli/commands.h"
#include "cli/support/command_line.h"
#include "cli/support/json_output.h"
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
  table.add({"tinyxml2", build_info::kTinyxml2Version});
  table.add({"CLI11", cli11_version()});
  table.add({"nlohmann-json", json_library_version()});
  table.print(console.out);
  return 0;
}

}  // namespace

void add_info_command(CommandLine& program) {
  Command command =
      program.add_command("info", "Version, build flags, instruction sets, libraries");
  command.run(info);
}

}  // namespace carom::cli

#include "cli/accuracy/tunnelling_output.h"

#include <nlohmann/json.hpp>

#include "carom_build_info.h"
#include "cli/support/number_text.h"
#include "cli/support/options.h"
#include "cli/support/table.h"
#include "io/cpu_name.h"
#include "io/printable.h"

namespace carom::cli {
namespace {

using Json = nlohmann::ordered_json;
using accuracy::NotedPair;
using accuracy::TunnellingRow;

Json to_json(const TunnellingRow& row, uint64_t meetings) {
  Json json = {{"detection", name_of(row.detection)},
               {"substeps", row.substeps},
               {"seen", row.seen},
               {"missed", row.missed},
               {"missed_share", share(row.missed, meetings)},
               {"unfounded", row.unfounded},
               {"grazing_seen", row.grazes},
               {"frame_ms", row.frame_ms}};
  if (!row.times) return json;
  json["late"] = row.times->late;
  json["latest"] = row.times->latest;
  json["earliest"] = row.times->earliest;
  json["earliest_metres"] = row.times->early_way;
  return json;
}

Json to_json(const std::vector<NotedPair>& pairs) {
  Json list = Json::array();
  for (const NotedPair& noted : pairs) {
    Json json = {{"frame", noted.frame},
                 {"a", noted.pair.a},
                 {"b", noted.pair.b},
                 {"least_separation", noted.least}};
    if (!noted.what.empty()) json["what"] = noted.what;
    list.push_back(json);
  }
  return list;
}

std::string ways(const TunnellingRow& row) {
  if (row.detection != Detection::discrete) return name_of(row.detection);
  return "discrete, " + std::to_string(row.substeps) +
         (row.substeps == 1 ? " step a frame" : " steps a frame");
}

void print_failures(const std::vector<NotedPair>& failures, std::ostream& out) {
  constexpr size_t kShown = 10;
  for (size_t i = 0; i < failures.size() && i < kShown; ++i) {
    const NotedPair& failure = failures[i];
    out << "continuous: frame " << failure.frame << ", bodies " << failure.pair.a << " and "
        << failure.pair.b << ": the impact " << failure.what << " (they overlap by "
        << number("%.3g m", -failure.least) << " or more)\n";
  }
  if (failures.size() > kShown) out << "... " << failures.size() << " failures in all\n";
}

Json to_json(const TunnellingRun& run) {
  const accuracy::TunnellingReport& report = run.report;
  Json json = {{"scene", run.scene},
               {"bodies", report.bodies},
               {"dynamic", report.dynamic},
               {"frames", report.frames},
               {"dt", run.dt},
               {"threads", run.threads},
               {"isa", run.isa},
               {"meetings", report.meetings},
               {"overlaps_at_start", report.at_start},
               {"reference_substeps", run.options.reference_substeps},
               {"reference_poses", report.poses},
               {"reference_seconds", report.reference_seconds}};
  json["rows"] = Json::array();
  for (const TunnellingRow& row : report.rows) {
    json["rows"].push_back(to_json(row, report.meetings));
  }
  json["grazing"] = to_json(report.grazing);
  json["failures"] = to_json(report.failures);
  json["cpu"] = io::cpu_name();
  json["version"] = build_info::kVersion;
  json["commit"] = build_info::kCommit;
  json["compiler"] = build_info::kCompiler;
  json["flags"] = build_info::kFlags;
  return json;
}

void print(const TunnellingRun& run, std::ostream& out) {
  const accuracy::TunnellingReport& report = run.report;
  out << io::printable(run.scene) << ": " << report.dynamic << " of " << report.bodies
      << " bodies move, " << report.frames << " frames of " << number("%.3g ms", 1e3 * run.dt)
      << "\n"
      << report.meetings << " meetings, " << report.at_start
      << " of them overlaps at the start of the frame; " << report.grazing.size()
      << " pairs graze and count in no row\n"
      << "reference: " << run.options.reference_substeps << " substeps, " << report.poses
      << " poses looked at, " << number("%.1f s", report.reference_seconds) << "\n\n";
  Table table({"detection", "missed", "", "unfounded", "late", "earliest", "ms a frame"});
  for (const TunnellingRow& row : report.rows) {
    table.add({ways(row), std::to_string(row.missed),
               number("%.2f %%", 100 * share(row.missed, report.meetings)),
               std::to_string(row.unfounded), row.times ? std::to_string(row.times->late) : "-",
               row.times ? number("%.1e m", row.times->early_way) : "-",
               number("%.3f", row.frame_ms)});
  }
  table.print(out);
  print_failures(report.failures, out);
}

}  // namespace

Result<void> write_run(const TunnellingRun& run, JsonOutput& json, const Console& console) {
  if (json.wanted()) return json.write(to_json(run), console);
  print(run, console.out);
  return {};
}

}  // namespace carom::cli

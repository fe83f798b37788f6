#include "cli/run/run_report.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <numeric>

#include "carom_build_info.h"
#include "cli/support/number_text.h"
#include "cli/support/options.h"
#include "cli/support/statistics.h"
#include "cli/support/table.h"
#include "io/printable.h"

namespace carom::cli {
namespace {

using Json = nlohmann::ordered_json;

// Drops frame 0, which builds everything for the first time, unless it is the only one.
std::vector<double> steady(const std::vector<double>& frames) {
  return {frames.begin() + (frames.size() > 1), frames.end()};
}

std::vector<Stage> stages_run(const RunRecord& record) {
  std::vector<Stage> stages;
  for (int i = 0; i < kStageCount; ++i) {
    if (record.stages_run >> i & 1) stages.push_back(static_cast<Stage>(i));
  }
  return stages;
}

using StageTimes = std::array<std::vector<double>, kStageCount>;

double stage_median(const StageTimes& times, Stage stage) {
  return median(steady(times[static_cast<size_t>(stage)]));
}

Json stages_json(const RunRecord& record, const StageTimes& times) {
  Json json = Json::object();
  for (Stage stage : stages_run(record)) json[name(stage)] = stage_median(times, stage);
  return json;
}

double bytes_per_body(const RunReport& report) {
  return share(report.memory.total(), report.bodies);
}

// Memory per pair of the last frame.
double bytes_per_pair(const RunReport& report) {
  const std::vector<uint64_t>& pairs = report.record.pairs;
  return share(report.memory.pairs_and_results, pairs.empty() ? 0 : pairs.back());
}

// Which share of the pairs was not tested, after the first frame.
double share_not_tested(const RunRecord& record) {
  const auto sum = [](const std::vector<uint64_t>& list) {
    return std::accumulate(list.begin() + (list.size() > 1), list.end(), uint64_t{0});
  };
  return share(sum(record.kept) + sum(record.dropped), sum(record.pairs));
}

Json events_json(const RunRecord& record) {
  Json events;
  events["begin"] = record.events[static_cast<size_t>(EventKind::begin)];
  events["persist"] = record.events[static_cast<size_t>(EventKind::persist)];
  events["end"] = record.events[static_cast<size_t>(EventKind::end)];
  return events;
}

bool is_certified(const RunReport& report) {
  return report.settings.world.accuracy.tier == Tier::certified;
}

bool looks_ahead(const RunReport& report) { return !report.record.swept.empty(); }

// First, least, greatest and last of a list.
std::string extent(const std::vector<uint64_t>& list) {
  if (list.empty()) return "-";
  auto [least, greatest] = std::minmax_element(list.begin(), list.end());
  return std::to_string(list.front()) + " in the first frame, " + std::to_string(list.back()) +
         " in the last; " + std::to_string(*least) + " to " + std::to_string(*greatest);
}

// Sums over all ladders: how many shapes have a model, the worst error, and the pieces with and
// without.
struct LadderSums {
  size_t models = 0, capsules = 0, boxes = 0, pieces = 0, simpler = 0;
  double error = 0, seconds = 0;

  explicit LadderSums(const std::vector<LadderReport>& ladders) {
    for (const LadderReport& ladder : ladders) {
      size_t used = ladder.pieces;
      for (const LadderReport::Entry& entry : ladder.entries) {
        if (entry.error == 0) continue;
        ++models;
        capsules += entry.is_capsule;
        boxes += entry.is_box;
        used = entry.pieces;
        error = std::max(error, entry.error);
      }
      pieces += ladder.pieces;
      simpler += used;
      seconds += ladder.seconds;
    }
  }
};

Json ladders_json(const std::vector<LadderReport>& ladders) {
  Json json = Json::array();
  for (const LadderReport& ladder : ladders) {
    Json rungs = Json::array();
    for (const LadderReport::Entry& entry : ladder.entries) {
      if (entry.error > 0) {
        rungs.push_back({{"error", entry.error},
                         {"pieces", entry.pieces},
                         {"is_capsule", entry.is_capsule},
                         {"is_box", entry.is_box}});
      } else {
        rungs.push_back({{"wanted", entry.wanted}, {"refused", entry.refused}});
      }
    }
    json.push_back({{"pieces", ladder.pieces}, {"rungs", rungs}, {"seconds", ladder.seconds}});
  }
  return json;
}

Json to_json(const RunReport& report, const WorldOptions& options) {
  const RunRecord& record = report.record;
  Summary frame = summarize(steady(record.frame_ms));
  Json json;
  json["scene"] = report.scene;
  json["bodies"] = report.bodies;
  json["frames"] = report.frames;
  json["threads"] = report.threads;
  json["isa"] = report.isa;
  options.add_json(report, json);
  json["pipeline"] = Json::array();
  for (Stage stage : stages_run(record)) json["pipeline"].push_back(name(stage));
  json["pair_kinds"] = report.pair_kinds;
  if (!report.ladders.empty()) json["ladders"] = ladders_json(report.ladders);
  json["frame_ms"] = {
      {"median", frame.median}, {"min", frame.min}, {"p99", frame.p99}, {"mean", frame.mean}};
  json["first_frame_ms"] = record.frame_ms.empty() ? 0 : record.frame_ms.front();
  json["stage_ms"] = stages_json(record, record.stage_ms);
  json["serial_ms"] = stages_json(record, record.serial_ms);
  json["page_faults_per_frame"] = record.page_faults;
  json["pairs_per_frame"] = record.pairs;
  json["contacts_per_frame"] = record.contacts;
  if (is_certified(report)) json["undecided_per_frame"] = record.undecided;
  json["tested_pairs_per_frame"] = record.tested;
  json["kept_pairs_per_frame"] = record.kept;
  json["dropped_pairs_per_frame"] = record.dropped;
  if (!report.ladders.empty()) {
    json["tested_by_models_per_frame"] = record.by_models;
    json["tested_by_rung_per_frame"] = record.by_rung;
    json["tested_by_shells_per_frame"] = record.by_shells;
  }
  if (report.settings.world.accuracy.tolerance > 0) {
    json["share_not_tested"] = share_not_tested(record);
  }
  if (looks_ahead(report)) {
    json["swept_per_frame"] = record.swept;
    json["impacts_per_frame"] = record.impacts;
    json["speculative_per_frame"] = record.speculative;
  }
  json["searched_bodies_per_frame"] = record.searched;
  json["events_per_frame"] = events_json(record);
  json["quarantined_per_frame"] = record.quarantined;
  json["state_hash"] = record.hash.text();
  json["bytes_per_body"] = bytes_per_body(report);
  json["broadphase_bytes_per_body"] = share(report.memory.broadphase, report.bodies);
  json["bytes_per_pair"] = bytes_per_pair(report);
  json["memory"] = {{"bodies", report.memory.bodies},
                    {"bounds", report.memory.bounds},
                    {"broadphase", report.memory.broadphase},
                    {"pairs_and_results", report.memory.pairs_and_results}};
  json["peak_rss_bytes"] = report.peak_rss_bytes;
  json["version"] = build_info::kVersion;
  json["commit"] = build_info::kCommit;
  json["compiler"] = build_info::kCompiler;
  json["flags"] = build_info::kFlags;
  return json;
}

void print(const RunReport& report, const WorldOptions& options, std::ostream& out) {
  const RunRecord& record = report.record;
  const WorldSettings& settings = report.settings.world;
  Summary frame = summarize(steady(record.frame_ms));
  Table table({"scene", io::printable(report.scene)});
  table.add({"bodies", std::to_string(report.bodies)});
  table.add({"frames", std::to_string(report.frames)});
  table.add({"threads, ISA", std::to_string(report.threads) + ", " + report.isa});
  options.add_rows(report, table);
  if (!report.ladders.empty()) {
    const LadderSums sums(report.ladders);
    table.add(
        {"ladders", std::to_string(sums.models) + " of " + std::to_string(report.ladders.size()) +
                        " shapes have a model, " + std::to_string(sums.capsules) +
                        " a capsule or ball, " + std::to_string(sums.boxes) +
                        " a box: " + std::to_string(sums.pieces) + " pieces -> " +
                        std::to_string(sums.simpler) + number(", at most %.3g m off", sums.error) +
                        number(", built in %.3g s", sums.seconds)});
  }
  table.add({"frame", number("%.3f ms median", frame.median) + number(", %.3f min", frame.min) +
                          number(", %.3f p99", frame.p99) + number(", %.3f mean", frame.mean)});
  for (Stage stage : stages_run(record)) {
    table.add(
        {std::string("  ") + name(stage), number("%.3f ms", stage_median(record.stage_ms, stage))});
  }
  table.add({"pairs", extent(record.pairs)});
  table.add(
      {settings.detail == Detail::overlap ? "overlaps" : "contacts", extent(record.contacts)});
  if (is_certified(report)) table.add({"undecided", extent(record.undecided)});
  if (looks_ahead(report)) {
    table.add({"bodies looked after",
               std::string(name_of(report.settings.detection)) + ", " + extent(record.swept)});
    table.add({"impacts", extent(record.impacts)});
    table.add({"speculative contacts", extent(record.speculative)});
  }
  if (!report.ladders.empty()) {
    table.add({"pairs tested by models", extent(record.by_models)});
    for (size_t k = 0; k < kCountedRungs; ++k) {
      if (std::ranges::count(record.by_rung[k], 0u) == std::ssize(record.by_rung[k])) continue;
      table.add(
          {"  by rung " + std::to_string(k + 1) + (k + 1 < kCountedRungs ? "" : " and further"),
           extent(record.by_rung[k])});
    }
    table.add({"depths by shells", extent(record.by_shells)});
  }
  table.add({"kept pairs", extent(record.kept)});
  if (settings.accuracy.tolerance > 0) {
    table.add({"not tested", number("%.1f %% of the pairs after the first frame",
                                    100 * share_not_tested(record))});
  }
  if (settings.dop_bounds) table.add({"dropped pairs", extent(record.dropped)});
  table.add({"state hash", record.hash.text()});
  table.add({"memory", number("%.1f bytes a body, ", bytes_per_body(report)) +
                           number("%.1f bytes a pair, ", bytes_per_pair(report)) +
                           number("%.1f MB at the peak", 1e-6 * report.peak_rss_bytes)});
  table.print(out);
}

}  // namespace

Result<void> write_report(const RunReport& report, const WorldOptions& options, JsonOutput& json,
                          const Console& console) {
  if (json.wanted()) return json.write(to_json(report, options), console);
  print(report, options, console.out);
  return {};
}

}  // namespace carom::cli

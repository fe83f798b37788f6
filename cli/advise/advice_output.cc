#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "carom_build_info.h"
#include "cli/advise/advice.h"
#include "cli/support/number_text.h"
#include "cli/support/table.h"
#include "io/printable.h"

namespace carom::cli {
namespace {

using accuracy::Deviation;
using Json = nlohmann::ordered_json;

Json to_json(const Spread& spread) {
  return {
      {"min", spread.least}, {"median", spread.median}, {"p99", spread.p99}, {"max", spread.most}};
}

Json kinds_json(const BodiesOfKind& kinds) {
  Json json = Json::object();
  for (size_t kind = 0; kind < kinds.size(); ++kind) {
    if (kinds[kind] > 0) json[name(static_cast<ShapeKind>(kind))] = kinds[kind];
  }
  return json;
}

Json to_json(const PairSurvey& pairs) {
  Json kinds = Json::array();
  for (const PairSurvey::Kinds& kind : pairs.kinds) {
    kinds.push_back({{"pair", kind.name}, {"pairs", kind.pairs}, {"overlaps", kind.overlaps}});
  }
  return {{"frames", pairs.frames},
          {"pairs_per_frame", share(pairs.pairs, pairs.frames)},
          {"overlapping_share", share(pairs.overlaps, pairs.pairs)},
          {"near_share", share(pairs.near, pairs.pairs)},
          {"standard_error_bound", pairs.error_bound},
          {"kinds", std::move(kinds)}};
}

Json to_json(const SceneSurvey& survey) {
  return {{"bodies", survey.bodies},
          {"frames", survey.frames},
          {"frames_of_scene", survey.frames_of_scene},
          {"kinds", kinds_json(survey.kinds)},
          {"static", survey.fixed},
          {"sensors", survey.sensors},
          {"positions", survey.float64 ? "float64" : "float32"},
          {"positions_fit_float32", survey.fits_float32},
          {"farthest", survey.farthest},
          {"float32_step", survey.float32_step},
          {"radius", to_json(survey.radius)},
          {"aspect", to_json(survey.aspect)},
          {"moving_share", survey.moving_share},
          {"displacement", to_json(survey.displacement)},
          {"pairs", to_json(survey.pairs)}};
}

Json to_json(const Deviation& deviation) {
  return {{"lost", deviation.lost},
          {"gained", deviation.gained},
          {"undecided", deviation.undecided},
          {"lost_worst", deviation.lost_worst},
          {"gained_worst", deviation.gained_worst},
          {"contact_error_worst", deviation.contact_error_worst},
          {"contact_error_p99", deviation.contact_error_p99},
          {"events_moved", deviation.events_moved},
          {"error_worst", deviation.worst()}};
}

Json to_json(const TriedSettings& tried) {
  Json json = {{"settings", tried.name}};
  json["tried"] = tried.result.has_value();
  if (!tried.result) return json;
  json["frame_ms"] = tried.result->frame_ms;
  if (tried.frame_ms_beside > 0) json["ratio"] = tried.ratio();
  json["meets"] = tried.meets;
  json.update(to_json(tried.result->deviation));
  return json;
}

Json to_json(const std::vector<AdviceRow>& rows) {
  Json list = Json::array();
  for (const AdviceRow& row : rows) {
    Json json = {{"what", row.what}};
    if (!row.value.empty()) json["value"] = row.value;
    json["reason"] = row.reason;
    list.push_back(std::move(json));
  }
  return list;
}

Json to_json(const std::vector<FrontPoint>& front) {
  Json list = Json::array();
  for (const FrontPoint& point : front) {
    list.push_back({{"tolerance", point.tolerance},
                    {"frame_ms", point.frame_ms},
                    {"guaranteed_error", point.guaranteed_error},
                    {"measured_error", point.measured_error},
                    {"settings", point.settings}});
  }
  return list;
}

std::string four(const Spread& spread) {
  return number("%.3g min", spread.least) + number(", %.3g median", spread.median) +
         number(", %.3g p99", spread.p99) + number(", %.3g max", spread.most);
}

std::string kinds_text(const BodiesOfKind& kinds) {
  std::string list;
  for (size_t kind = 0; kind < kinds.size(); ++kind) {
    if (kinds[kind] == 0) continue;
    list += (list.empty() ? "" : ", ") + std::to_string(kinds[kind]) + ' ' +
            name(static_cast<ShapeKind>(kind));
  }
  return list.empty() ? "none" : list;
}

// Names the most frequent pairs of kinds.
std::string pair_kinds_text(const PairSurvey& pairs) {
  constexpr size_t kNamed = 5;
  std::vector<PairSurvey::Kinds> kinds = pairs.kinds;
  std::stable_sort(kinds.begin(), kinds.end(),
                   [](const auto& a, const auto& b) { return a.pairs > b.pairs; });
  std::string list;
  for (size_t i = 0; i < std::min(kNamed, kinds.size()); ++i) {
    list += (list.empty() ? "" : ", ") + kinds[i].name + ' ' +
            percent(share(kinds[i].pairs, pairs.pairs));
  }
  if (kinds.size() > kNamed) list += ", " + std::to_string(kinds.size() - kNamed) + " others";
  return list.empty() ? "none" : list;
}

void print_survey(const Advice& advice, std::ostream& out) {
  const SceneSurvey& survey = advice.survey;
  const PairSurvey& pairs = survey.pairs;
  Table table({"scene", io::printable(advice.scene)});
  table.add({"frames", std::to_string(survey.frames) + " of " +
                           std::to_string(survey.frames_of_scene) + " looked at"});
  table.add({"bodies", kinds_text(survey.kinds) +
                           (survey.fixed ? ", " + std::to_string(survey.fixed) + " static" : "")});
  if (advice.choice.standard.quarantined > 0) {
    table.add({"left out", std::to_string(advice.choice.standard.quarantined) +
                               " in all frames together (NaN, infinite or negative size)"});
  }
  table.add({"radius", four(survey.radius) + " m"});
  table.add({"aspect", four(survey.aspect)});
  table.add({"positions", std::string(survey.float64 ? "float64" : "float32") +
                              number(", up to %.4g m from the origin", survey.farthest)});
  table.add({"motion", percent(survey.moving_share) + " of the bodies in a frame, by " +
                           four(survey.displacement) + " m"});
  table.add({"pairs",
             number("%.6g a frame; ", share(pairs.pairs, pairs.frames)) + pair_kinds_text(pairs)});
  table.add({"  overlapping", percent(share(pairs.overlaps, pairs.pairs))});
  table.add(
      {"  near touching", percent(share(pairs.near, pairs.pairs)) + " within 2^-17 of their size"});
  if (pairs.error_bound > 0) {
    table.add({"  standard error", number("%.3g m at most", pairs.error_bound)});
  }
  table.print(out);
}

std::vector<std::string> tried_row(const TriedSettings& tried) {
  if (!tried.result) return {tried.name, "-", "-", "-", "-", "-", "no time left"};
  const Deviation& deviation = tried.result->deviation;
  std::string verdict = tried.meets ? "yes" : "no";
  if (deviation.undecided > 0) verdict += ", " + std::to_string(deviation.undecided) + " undecided";
  return {tried.name,
          number("%.3f", tried.result->frame_ms),
          tried.frame_ms_beside > 0 ? number("%.2f", tried.ratio()) : "",
          std::to_string(deviation.lost),
          std::to_string(deviation.gained),
          number("%.2g", deviation.worst()),
          verdict};
}

void print_trials(const SettingsChoice& choice, std::ostream& out) {
  Table table({"tried", "ms", "ratio", "lost", "gained", "error, m", "meets"});
  for (const TriedSettings& tried : choice.tried) table.add(tried_row(tried));
  table.print(out);
}

void print_rows(const char* heading, const std::vector<AdviceRow>& rows, std::ostream& out) {
  out << '\n' << heading << '\n';
  for (const AdviceRow& row : rows) {
    out << "  " << row.what << (row.value.empty() ? "" : " " + row.value) << ": " << row.reason
        << '\n';
  }
}

Json to_json(const Advice& advice) {
  const SettingsChoice& choice = advice.choice;
  Json json;
  json["scene"] = advice.scene;
  json["tolerance"] = advice.tolerance;
  json["isa"] = advice.isa;
  json["survey"] = to_json(advice.survey);
  json["survey"]["quarantined"] = choice.standard.quarantined;
  json["trials"] = Json::array();
  for (const TriedSettings& tried : choice.tried) json["trials"].push_back(to_json(tried));
  json["settings"] = to_json(advice.settings);
  json["not_needed"] = to_json(advice.not_needed);
  json["choice"] = to_json(choice.deviation);
  json["choice"]["frame_ms"] = choice.frame_ms;
  json["choice"]["frame_ms_standard"] = choice.frame_ms_standard;
  json["meets"] = advice.meets;
  json["command"] = advice.command;
  json["gain"] = choice.frame_ms_standard > 0 ? choice.frame_ms / choice.frame_ms_standard : 1;
  json["guaranteed_error"] = advice.guaranteed_error;
  json["measured_error"] = choice.deviation.worst();
  if (!advice.front.empty()) json["front"] = to_json(advice.front);
  json["version"] = build_info::kVersion;
  json["commit"] = build_info::kCommit;
  json["compiler"] = build_info::kCompiler;
  json["flags"] = build_info::kFlags;
  return json;
}

// Two digits, and no less than the number.
double rounded_up(double metres) {
  if (!(metres > 0)) return metres;
  const double unit = std::pow(10, std::floor(std::log10(metres)) - 1);
  return std::ceil(metres / unit * (1 - 1e-12)) * unit;
}

void print(const Advice& advice, std::ostream& out) {
  const SettingsChoice& choice = advice.choice;
  if (!advice.meets) {
    out << "No settings keep errors below the tolerance: the standard tier itself may be off by "
        << number("%.2g m.\n", advice.survey.pairs.error_bound);
  }
  out << io::printable(advice.command) << ": "
      << number("%.2f of the time at tolerance 0", choice.frame_ms / choice.frame_ms_standard)
      << number(" (%.3f", choice.frame_ms)
      << number(" for %.3f ms a frame)", choice.frame_ms_standard)
      << number("; errors of %.2g m at most", rounded_up(advice.guaranteed_error))
      << number(", %.2g m seen\n\n", choice.deviation.worst());
  if (!advice.front.empty()) out << front_text(advice.front) << '\n';
  print_survey(advice, out);
  out << '\n';
  print_trials(choice, out);
  print_rows(("Settings for errors below " + number("%g", advice.tolerance) + " m").c_str(),
             advice.settings, out);
  print_rows("Not needed here", advice.not_needed, out);
}

}  // namespace

Result<void> write_advice(const Advice& advice, JsonOutput& json, const Console& console) {
  if (json.wanted()) return json.write(to_json(advice), console);
  print(advice, console.out);
  return {};
}

}  // namespace carom::cli

// carom accuracy: what the tiers cost and what they give, measured against exact answers.
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <system_error>

#include "accuracy/page.h"
#include "accuracy/pairs/decisions.h"
#include "accuracy/pairs/round_pair.h"
#include "accuracy/scenes/fidelity_json.h"
#include "accuracy/tiers/measure.h"
#include "cli/accuracy/scene_fidelity.h"
#include "cli/commands.h"
#include "cli/support/command_line.h"
#include "cli/support/json_output.h"
#include "cli/support/options.h"
#include "cli/support/progress.h"
#include "cli/support/table.h"
#include "io/files/atomic_file.h"
#include "io/printable.h"

namespace carom::cli {
namespace {

using Json = nlohmann::ordered_json;

struct AccuracyOptions {
  std::string out;
  std::string mode = "short";
  std::vector<std::string> pairs;
  uint64_t seed = 1;
  std::vector<std::string> scenes;
  uint64_t decisions = 0;
  std::string json;
};

// `with_round`: also pairs with cylinders, cones and ellipsoids.
Result<std::vector<accuracy::NamedKinds>> chosen_kinds(const std::vector<std::string>& names,
                                                       bool with_round) {
  std::vector<accuracy::NamedKinds> chosen;
  const auto choose = [&](const accuracy::NamedKinds& kinds) {
    if (names.empty() || std::count(names.begin(), names.end(), kinds.name) > 0) {
      chosen.push_back(kinds);
    }
  };
  std::for_each(std::begin(accuracy::kAllKinds), std::end(accuracy::kAllKinds), choose);
  if (with_round) {
    std::for_each(accuracy::round_kinds().begin(), accuracy::round_kinds().end(), choose);
  }
  for (const std::string& name : names) {
    const bool is_known = std::any_of(chosen.begin(), chosen.end(),
                                      [&](const auto& kinds) { return kinds.name == name; });
    if (!is_known)
      return Error{"--pairs " + io::printable_name(name) +
                   ": no pair of kinds, as sphere_box is one"};
  }
  return chosen;
}

// Progress over a number of steps that the work reports.
class ProgressLine {
 public:
  ProgressLine(const Console& console, const char* what) : console_(console), what_(what) {}

  void operator()(size_t done, size_t all) {
    if (!line_) line_ = std::make_shared<Progress>(console_, what_, all);
    line_->update(done);
  }

 private:
  const Console& console_;
  const char* what_;
  std::shared_ptr<Progress> line_;  // shared by all copies, because std::function copies
};

// Adds the effect of the fast tier and of a tolerance on whole scenes.
Result<void> add_scenes(const AccuracyOptions& options, const Console& console, Json& json) {
  const Result<accuracy::FidelityReport> report = measure_scene_fidelity(
      options.scenes, options.mode == "short", ProgressLine(console, "scenes"));
  if (!report) return report.error();
  json.update(accuracy::to_json(*report));
  return {};
}

Result<void> make_folder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) return io::file_error(path, "no folder can be made: " + error.message());
  return {};
}

Result<void> write_files(const Json& json, const std::string& folder) {
  const std::filesystem::path path(folder);
  Result<void> written =
      io::write_text_file((path / "accuracy.json").string(), json.dump(1, ' ') + '\n');
  if (!written) return written;
  return io::write_text_file((path / "index.html").string(), accuracy::page_with(json));
}

std::string number(const char* format, const Json& value) {
  char text[32];
  std::snprintf(text, sizeof text, format, value.get<double>());
  return text;
}

void print(const Json& json, std::ostream& out) {
  Table table({"pair", "setting", "ns a pair", "worst error", "false overlaps", "missed",
               "worst wrong gap", "undecided", "judged"});
  for (const Json& row : json["tradeoff"]) {
    table.add({row["pair"], row["setting"], number("%.1f", row["ns_per_pair"]),
               number("%.2g L", row["error_worst"]), number("%.0f", row["false_overlaps"]),
               number("%.0f", row["missed"]), number("%.2g L", row["worst_wrong_gap"]),
               number("%.0f", row["undecided"]), number("%.0f", row["judged"])});
  }
  table.print(out);
  for (const Json& failure : json["failures"]) out << failure.get<std::string>() << '\n';
  out << '\n'
      << (json["failures"].empty() ? "No" : number("%.0f", json["failures"].size()))
      << " failures, " << number("%.0f", json["seconds"]) << " s. L is the mean of the bounding "
      << "radii of a pair, or the gap if that is larger.\n";
}

std::string share_text(size_t part, size_t whole) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %%",
                100 * static_cast<double>(part) / static_cast<double>(whole));
  return text;
}

// Checks millions of certified and exact decisions and nothing else.
Result<int> count_decisions(const AccuracyOptions& options,
                            const std::vector<accuracy::NamedKinds>& kinds,
                            const Console& console) {
  Result<JsonOutput> output = JsonOutput::open(options.json);
  if (!output) return output.error();
  Table table({"pair", "pairs", "overlapping", "undecided", "wrong certified", "wrong exact"});
  Json rows = Json::array();
  std::string failures;
  for (const accuracy::NamedKinds& each : kinds) {
    Progress progress(console, each.name, options.decisions);
    const accuracy::DecisionCount count = accuracy::count_decisions(
        each.kinds, options.decisions, options.seed, [&](size_t done) { progress.update(done); });
    table.add({each.name, std::to_string(count.pairs), share_text(count.overlapping, count.pairs),
               share_text(count.undecided, count.pairs), std::to_string(count.wrong_certified),
               std::to_string(count.wrong_exact)});
    rows.push_back({{"pair", each.name},
                    {"pairs", count.pairs},
                    {"overlapping", count.overlapping},
                    {"undecided", count.undecided},
                    {"wrong_certified", count.wrong_certified},
                    {"wrong_exact", count.wrong_exact},
                    {"failure", count.failure}});
    if (!count.is_sound()) failures += std::string(each.name) + ": " + count.failure + '\n';
  }
  if (output->wanted()) {
    if (Result<void> written = output->write(rows, console); !written) return written.error();
  }
  if (options.json != "-") table.print(console.out);
  if (options.json != "-") console.out << failures;
  return failures.empty() ? 0 : 1;
}

Result<int> measure_accuracy(const AccuracyOptions& options, const Console& console) {
  const auto kinds = chosen_kinds(options.pairs, options.decisions == 0);
  if (!kinds) return kinds.error();
  if (options.decisions > 0) return count_decisions(options, *kinds, console);
  Result<JsonOutput> output = JsonOutput::open(options.json);
  if (!output) return output.error();
  if (!options.out.empty()) {
    if (Result<void> made = make_folder(options.out); !made) return made.error();
  }
  Json json =
      accuracy::measure({.kinds = *kinds, .is_long = options.mode == "long", .seed = options.seed},
                        ProgressLine(console, "pairs of kinds"));
  if (options.pairs.empty()) {
    if (Result<void> added = add_scenes(options, console, json); !added) return added.error();
  }
  if (!options.out.empty()) {
    if (Result<void> written = write_files(json, options.out); !written) return written.error();
  }
  if (output->wanted()) {
    if (Result<void> written = output->write(json, console); !written) return written.error();
  }
  if (options.json != "-") print(json, console.out);
  return json["failures"].empty() ? 0 : 1;
}

}  // namespace

void add_accuracy_command(CommandLine& program) {
  auto options = std::make_shared<AccuracyOptions>();
  Command command = program.add_command("accuracy", "Measure speed and accuracy of every tier");
  command
      .add_option("--out", options->out,
                  "Write accuracy.json and the page index.html to this folder")
      .file_name();
  command.add_option("--mode", options->mode, "short (minutes) or long (half an hour)")
      .one_of({"short", "long"})
      .show_default();
  command.add_option("--pairs", options->pairs, "These pairs of kinds alone, as sphere_box,box_box")
      .separated_by(',');
  command
      .add_option("--scene", options->scenes,
                  "Measure what the fast tier and tolerances change in this scene, too (a file or "
                  "a generator)")
      .take_all();
  command
      .add_option("--decisions", options->decisions,
                  "Only count wrong and undecided decisions of the certified and exact tiers, of "
                  "so many pairs of each two kinds")
      .between(1.0, 1e12)
      .excludes("--out")
      .excludes("--scene");
  command.add_option("--seed", options->seed, "Of the random pairs").show_default();
  add_json_option(command, options->json);
  command.run([options](const Console& console) { return measure_accuracy(*options, console); });
}

}  // namespace carom::cli

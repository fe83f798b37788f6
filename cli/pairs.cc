// carom pairs: tests a file of pairs.
#include <CLI/CLI.hpp>
#include <array>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "carom/kernel/thread_arena.h"
#include "carom/narrowphase/collide.h"
#include "carom_build_info.h"
#include "cli/commands.h"
#include "cli/json_output.h"
#include "cli/options.h"
#include "cli/pair_set.h"
#include "cli/progress.h"
#include "cli/statistics.h"
#include "cli/table.h"

namespace carom::cli {
namespace {

// `distance` asks for nothing beyond what the contact kernels of these shapes give.
constexpr NamedDetail kDetails[] = {{"overlap", Detail::overlap},
                                    {"contact", Detail::contact},
                                    {"manifold", Detail::manifold},
                                    {"distance", Detail::contact}};

struct PairsOptions {
  std::string input;
  std::string output;
  EngineOptions engine;
  int repeat = 1;
  std::string json;
};

// Tests all pairs `repeat` times; returns the nanoseconds a pair that each run took.
Result<std::vector<double>> test_pairs(const PairSet& pairs, const PairsOptions& options,
                                       Detail detail, const Accuracy& accuracy,
                                       PairColumns& results, const Console& console) {
  using Clock = std::chrono::steady_clock;
  ThreadArena arena(options.engine.threads);
  Collidables a = pairs.a.view();
  Collidables b = pairs.b.view();
  ResultColumns columns = results.columns();
  std::vector<double> ns_per_pair;
  Progress progress(console, "run", static_cast<uint64_t>(options.repeat));
  for (int run = 0; run < options.repeat; ++run) {
    progress.update(static_cast<uint64_t>(run));
    Result<void> tested;
    Clock::time_point begin, end;
    arena.run([&] {
      begin = Clock::now();
      tested = collide_rows(a, b, detail, columns, WitnessFrame::world, arena.parallelism(),
                            Measured::all, accuracy);
      end = Clock::now();
    });
    if (!tested) return io::file_error(options.input, tested.error().message);
    double ns = std::chrono::duration<double, std::nano>(end - begin).count();
    ns_per_pair.push_back(pairs.size() ? ns / static_cast<double>(pairs.size()) : 0);
  }
  return ns_per_pair;
}

struct PairsReport {
  uint64_t pairs;
  Accuracy accuracy;
  uint64_t overlaps;
  uint64_t undecided;
  uint64_t invalid;
  double ns_per_pair;
};

PairsReport summarize(const io::PairResults& results, const Accuracy& accuracy,
                      std::vector<double> ns_per_pair) {
  PairsReport report{results.pairs, accuracy, 0, 0, 0, median(std::move(ns_per_pair))};
  for (uint8_t overlap : results.overlap) {
    report.overlaps += overlap == 1;
    report.undecided += overlap == kUndecided;
  }
  for (uint8_t status : results.status) {
    report.invalid += status == static_cast<uint8_t>(Status::invalid);
  }
  return report;
}

nlohmann::ordered_json to_json(const PairsReport& report, const PairsOptions& options) {
  nlohmann::ordered_json json;
  json["pairs"] = report.pairs;
  json["ns_per_pair"] = report.ns_per_pair;
  json["isa"] = name(active_isa());
  json["tier"] = options.engine.tier;
  const std::vector<std::string> knobs = names_of(report.accuracy.knobs);
  if (!knobs.empty()) json["knobs"] = knobs;
  json["detail"] = options.engine.detail;
  json["threads"] = options.engine.threads;
  json["repeat"] = options.repeat;
  json["overlaps"] = report.overlaps;
  json["undecided"] = report.undecided;
  json["invalid"] = report.invalid;
  json["version"] = build_info::kVersion;
  json["commit"] = build_info::kCommit;
  json["compiler"] = build_info::kCompiler;
  json["flags"] = build_info::kFlags;
  return json;
}

void print(const PairsReport& report, const PairsOptions& options, std::ostream& out) {
  char time[64];
  std::snprintf(time, sizeof time, "%.2f ns a pair, median of %d", report.ns_per_pair,
                options.repeat);
  Table table({"pairs", std::to_string(report.pairs)});
  table.add({"overlapping", std::to_string(report.overlaps)});
  if (report.accuracy.tier == Tier::certified) {
    table.add({"undecided", std::to_string(report.undecided)});
  }
  table.add({"invalid", std::to_string(report.invalid)});
  table.add({"threads, ISA", std::to_string(options.engine.threads) + ", " + name(active_isa())});
  if (report.accuracy.tier != Tier::standard) table.add({"tier", describe(report.accuracy)});
  table.add({"detail", options.engine.detail});
  table.add({"time", time});
  table.print(out);
}

Result<int> pairs(const PairsOptions& options, const Console& console) {
  if (Result<void> threads = check_threads(options.engine.threads); !threads) {
    return threads.error();
  }
  Result<Accuracy> accuracy = parse_accuracy(options.engine, KnobsOf::pairs);
  if (!accuracy) return accuracy.error();
  Result<Detail> detail = parse_detail(options.engine.detail, kDetails);
  if (!detail) return detail.error();
  Result<ForcedIsa> isa = ForcedIsa::create(options.engine.isa);
  if (!isa) return isa.error();
  Result<void> apart =
      check_apart(std::array<OutputFile, 2>{{{"--json", options.json}, {"-o", options.output}}});
  if (!apart) return apart.error();
  Result<JsonOutput> json = JsonOutput::open(options.json);
  if (!json) return json.error();

  Result<PairSet> set = read_pair_set(options.input);
  if (!set) return set.error();
  PairColumns columns(*set, *detail);
  Result<std::vector<double>> times =
      test_pairs(*set, options, *detail, *accuracy, columns, console);
  if (!times) return times.error();
  io::PairResults results = columns.results();
  Result<void> written = io::write_pair_results(options.output, results);
  if (!written) return written.error();

  PairsReport report = summarize(results, *accuracy, std::move(*times));
  if (!json->wanted()) {
    print(report, options, console.out);
    return 0;
  }
  written = json->write(to_json(report, options), console);
  return written ? Result<int>(0) : written.error();
}

}  // namespace

void add_pairs_command(CLI::App& program, Action& action) {
  auto options = std::make_shared<PairsOptions>();
  CLI::App& command = *program.add_subcommand("pairs", "Test a file of pairs");
  command.add_option("IN", options->input, "Pairs (.npz)")->required();
  command.add_option("-o,--output", options->output, "Results (.npz)")
      ->required()
      ->check(file_name());
  add_engine_options(command, options->engine);
  command.add_option("--detail", options->engine.detail, "overlap, contact, manifold or distance")
      ->capture_default_str();
  command.add_option("--repeat", options->repeat, "Runs to take the median time of")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  add_json_option(command, options->json);
  command.callback([options, &action] {
    action = [options](const Console& console) { return pairs(*options, console); };
  });
}

}  // namespace carom::cli

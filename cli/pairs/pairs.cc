// carom pairs: tests a file of pairs.
#include <array>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

#include "carom/base/thread_arena.h"
#include "carom/impacts/time_of_impact.h"
#include "carom/narrowphase/collide.h"
#include "carom_build_info.h"
#include "cli/commands.h"
#include "cli/pairs/impact_arrays.h"
#include "cli/pairs/pair_set.h"
#include "cli/pairs/region_rows.h"
#include "cli/support/command_line.h"
#include "cli/support/json_output.h"
#include "cli/support/options.h"
#include "cli/support/progress.h"
#include "cli/support/statistics.h"
#include "cli/support/table.h"

namespace carom::cli {
namespace {

// `distance` is the same as contact, because the contact kernels of these shapes also measure
// separate pairs. `toi` gives the contacts at the time of impact.
constexpr NamedDetail kDetails[] = {{"overlap", Detail::overlap},   {"contact", Detail::contact},
                                    {"manifold", Detail::manifold}, {"regions", Detail::regions},
                                    {"distance", Detail::contact},  {"toi", Detail::contact}};

struct PairsOptions {
  std::string input;
  std::string output;
  EngineOptions engine;
  TierOptions tier;
  std::string detail = "contact";
  double contact_distance = 0;
  int repeat = 1;
  std::string json;
};

bool finds_impacts(const PairsOptions& options) { return options.detail == "toi"; }

// Times of impact are found in double precision, so that the fast tier has no effect.
Result<void> check_tier_of_impacts(const Accuracy& accuracy, const std::string& tier) {
  if (has_proofs(accuracy.tier)) {
    return Error{"--detail toi has the tier standard alone (--tier " + tier + " was given)"};
  }
  return {};
}

Result<void> check_motions(const PairSet& pairs, const std::string& path) {
  if (pairs.size() == 0 || pairs.has_motions()) return {};
  return io::member_error(
      path, "displacement_a",
      "is missing, and displacement_b as well (--detail toi needs one of them)");
}

// Results of the last run, and the nanoseconds per pair of each run.
struct Tested {
  ResultArrays results;
  std::vector<float> toi;  // at detail toi only
  ContactRegions regions;  // at detail regions only
  std::vector<double> ns_per_pair;
};

// Calls `test(parallelism)` `repeat` times and measures each call.
template <class Test>
Result<std::vector<double>> time_runs(size_t pairs, const PairsOptions& options,
                                      const Console& console, const Test& test) {
  using Clock = std::chrono::steady_clock;
  ThreadArena arena(options.engine.threads);
  std::vector<double> ns_per_pair;
  Progress progress(console, "run", static_cast<uint64_t>(options.repeat));
  for (int run = 0; run < options.repeat; ++run) {
    progress.update(static_cast<uint64_t>(run));
    Result<void> tested;
    Clock::time_point begin, end;
    arena.run([&] {
      begin = Clock::now();
      tested = test(arena.parallelism());
      end = Clock::now();
    });
    if (!tested) return io::file_error(options.input, tested.error().message);
    double ns = std::chrono::duration<double, std::nano>(end - begin).count();
    ns_per_pair.push_back(pairs ? ns / static_cast<double>(pairs) : 0);
  }
  return ns_per_pair;
}

Result<Tested> test_pairs(const PairSet& pairs, const PairsOptions& options, Detail detail,
                          const Accuracy& accuracy, const Console& console) {
  ResultArrays results = results_of(pairs, detail);
  const ResultColumns& columns = results.columns();
  const Collidables a = pairs.a.view();
  const Collidables b = pairs.b.view();
  ContactRegions regions;
  auto times = time_runs(pairs.size(), options, console, [&](Parallelism parallelism) {
    return collide_rows(a, b, detail, columns,
                        {.parallelism = parallelism,
                         .accuracy = accuracy,
                         .contact_distance = static_cast<float>(options.contact_distance),
                         .regions = &regions});
  });
  if (!times) return times.error();
  return Tested{std::move(results), {}, std::move(regions), std::move(*times)};
}

Result<Tested> find_impacts(const PairSet& pairs, const PairsOptions& options,
                            const Console& console) {
  Result<void> motions = check_motions(pairs, options.input);
  if (!motions) return motions.error();
  ImpactArrays results(pairs);
  const ImpactColumns columns = results.columns();
  const Collidables a = pairs.a.view();
  const Collidables b = pairs.b.view();
  const SweepView sweep_a = pairs.motions_a.view();
  const SweepView sweep_b = pairs.motions_b.view();
  const std::vector<Pair> rows = rows_in_order(pairs.size());
  auto times = time_runs(pairs.size(), options, console, [&](Parallelism parallelism) {
    return time_of_impact(a, sweep_a, b, sweep_b, rows, columns, {.parallelism = parallelism});
  });
  if (!times) return times.error();
  results.mark_meetings();
  return Tested{std::move(results.contacts), std::move(results.toi), {}, std::move(*times)};
}

struct ImpactCounts {
  uint64_t impacts = 0;
  uint64_t at_start = 0;
  uint64_t budget = 0;
};

struct PairsReport {
  uint64_t pairs;
  Accuracy accuracy;
  uint64_t overlaps;
  uint64_t undecided;
  uint64_t invalid;
  double ns_per_pair;
  std::optional<ImpactCounts> impacts;  // at detail toi
};

bool has_status(uint8_t status, Status of) { return status == static_cast<uint8_t>(of); }

std::span<const uint8_t> statuses(const Tested& tested) {
  return {tested.results.columns().status, tested.results.count()};
}

ImpactCounts count_impacts(const Tested& tested) {
  ImpactCounts counts;
  for (float toi : tested.toi) {
    counts.impacts += meets(toi);
    counts.at_start += toi == 0;
  }
  for (uint8_t status : statuses(tested)) counts.budget += has_status(status, Status::budget);
  return counts;
}

PairsReport summarize(const Tested& tested, const Accuracy& accuracy, const PairsOptions& options) {
  const ResultArrays& results = tested.results;
  PairsReport report{results.count(), accuracy, 0, 0, 0, median(tested.ns_per_pair), {}};
  for (uint8_t overlap : std::span(results.columns().overlap, results.count())) {
    report.overlaps += overlap == 1;
    report.undecided += overlap == kUndecided;
  }
  for (uint8_t status : statuses(tested)) report.invalid += has_status(status, Status::invalid);
  if (finds_impacts(options)) report.impacts = count_impacts(tested);
  return report;
}

nlohmann::ordered_json to_json(const PairsReport& report, const PairsOptions& options) {
  nlohmann::ordered_json json;
  json["pairs"] = report.pairs;
  json["ns_per_pair"] = report.ns_per_pair;
  json["isa"] = name(active_isa());
  json["tier"] = options.tier.tier;
  if (report.accuracy.tolerance > 0) json["tolerance"] = report.accuracy.tolerance;
  json["detail"] = options.detail;
  json["contact_distance"] = options.contact_distance;
  json["threads"] = options.engine.threads;
  json["repeat"] = options.repeat;
  json["overlaps"] = report.overlaps;
  json["undecided"] = report.undecided;
  if (report.impacts) {
    json["impacts"] = report.impacts->impacts;
    json["at_start"] = report.impacts->at_start;
    json["budget"] = report.impacts->budget;
  }
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
  if (report.impacts) {
    table.add({"impacts", std::to_string(report.impacts->impacts)});
    table.add({"at the start", std::to_string(report.impacts->at_start)});
    table.add({"ended early", std::to_string(report.impacts->budget)});
  } else {
    table.add({"overlapping", std::to_string(report.overlaps)});
  }
  if (report.accuracy.tier == Tier::certified) {
    table.add({"undecided", std::to_string(report.undecided)});
  }
  table.add({"invalid", std::to_string(report.invalid)});
  table.add({"threads, ISA", std::to_string(options.engine.threads) + ", " + name(active_isa())});
  const std::string tier = describe(report.accuracy);
  if (tier != name_of(Tier::standard)) table.add({"tier", tier});
  table.add({"detail", options.detail});
  table.add({"time", time});
  table.print(out);
}

Result<int> pairs(const PairsOptions& options, const Console& console) {
  if (Result<void> threads = check_threads(options.engine.threads); !threads) {
    return threads.error();
  }
  Result<Accuracy> accuracy = parse_accuracy(options.tier);
  if (!accuracy) return accuracy.error();
  Result<Detail> detail = parse_detail(options.detail, kDetails);
  if (!detail) return detail.error();
  Result<void> metres = check_metres("--contact-distance", options.contact_distance);
  if (!metres) return metres.error();
  if (finds_impacts(options)) {
    Result<void> served = check_tier_of_impacts(*accuracy, options.tier.tier);
    if (!served) return served.error();
  }
  Result<ForcedIsa> isa = ForcedIsa::create(options.engine.isa);
  if (!isa) return isa.error();
  Result<void> apart = check_apart(std::array<NamedFile, 3>{
      {{"the file of pairs", options.input}, {"--json", options.json}, {"-o", options.output}}});
  if (!apart) return apart.error();
  Result<JsonOutput> json = JsonOutput::open(options.json);
  if (!json) return json.error();

  Result<PairSet> set =
      read_pair_set(options.input, finds_impacts(options) ? 0 : accuracy->tolerance);
  if (!set) return set.error();
  Result<Tested> tested = finds_impacts(options)
                              ? find_impacts(*set, options, console)
                              : test_pairs(*set, options, *detail, *accuracy, console);
  if (!tested) return tested.error();
  const float* toi = finds_impacts(options) ? tested->toi.data() : nullptr;
  const io::RegionArrays regions = region_arrays(tested->regions, *set);
  Result<void> written =
      io::write_pair_results(options.output, set->size(), tested->results.columns(), toi,
                             *detail == Detail::regions ? &regions : nullptr);
  if (!written) return written.error();

  PairsReport report = summarize(*tested, *accuracy, options);
  if (!json->wanted()) {
    print(report, options, console.out);
    return 0;
  }
  written = json->write(to_json(report, options), console);
  return written ? Result<int>(0) : written.error();
}

}  // namespace

void add_pairs_command(CommandLine& program) {
  auto options = std::make_shared<PairsOptions>();
  Command command = program.add_command("pairs", "Test a file of pairs");
  command.add_option("IN", options->input, "Pairs (.npz)").required();
  command.add_option("-o,--output", options->output, "Results (.npz)").required().file_name();
  add_engine_options(command, options->engine);
  add_tier_options(command, options->tier);
  command
      .add_option("--detail", options->detail,
                  "overlap, contact, manifold, regions, distance or toi")
      .show_default();
  command
      .add_option("--contact-distance", options->contact_distance,
                  "Metres from which pairs have contacts before they touch")
      .show_default();
  command.add_option("--repeat", options->repeat, "Runs to take the median time of")
      .between(1, 1'000'000)
      .show_default();
  add_json_option(command, options->json);
  command.run([options](const Console& console) { return pairs(*options, console); });
}

}  // namespace carom::cli

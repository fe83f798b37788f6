#include "bench/peers/narrowphase/report.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace carom::bench {
namespace {

using nlohmann::ordered_json;

// Speed relative to Bullet.
double times_bullet(const StreamResult& result, const RunnerResult& runner) {
  return result.timed("bullet")->seconds_per_pair() / runner.seconds_per_pair();
}

ordered_json agreement_json(const Agreement& agreement) {
  ordered_json json = {{"pairs", agreement.pairs},
                       {"excluded", agreement.excluded},
                       {"different", agreement.different},
                       {"measured", agreement.measured}};
  if (agreement.measured > 0) {
    json["median_error"] = agreement.median_error;
    json["worst_error"] = agreement.worst_error;
  }
  return json;
}

ordered_json runner_json(const StreamResult& result, const RunnerResult& runner) {
  ordered_json json = {{"runner", runner.runner},
                       {"ns", 1e9 * runner.seconds_per_pair()},
                       {"ns_min", 1e9 * runner.least_seconds / static_cast<double>(runner.pairs)},
                       {"times_bullet", times_bullet(result, runner)},
                       {"passes", runner.passes}};
  if (runner.agreement) json["agreement"] = agreement_json(*runner.agreement);
  return json;
}

ordered_json stream_json(const StreamResult& result) {
  ordered_json json = {{"pair", result.pair},   {"detail", result.output},
                       {"pairs", result.pairs}, {"hit_percent", result.hit_percent},
                       {"wrong", result.wrong}, {"bullet", agreement_json(result.bullet)}};
  json["runners"] = ordered_json::array();
  for (const RunnerResult& runner : result.runners) {
    json["runners"].push_back(runner_json(result, runner));
  }
  return json;
}

void print(const StreamResult& result, const RunnerResult& runner) {
  std::printf("  %-24s %10.2f %9.2f %8zu", runner.runner.c_str(), 1e9 * runner.seconds_per_pair(),
              times_bullet(result, runner), runner.passes);
  if (runner.agreement) std::printf(" %10zu", runner.agreement->different);
  if (runner.agreement && runner.agreement->measured > 0) {
    std::printf(" %9.1e %9.1e", runner.agreement->median_error, runner.agreement->worst_error);
  }
  std::printf("\n");
}

}  // namespace

void print(const StreamResult& result) {
  std::printf(
      "\n%s, %s: %zu pairs, %.1f %% overlap; Bullet: %zu decide otherwise, %zu not compared\n",
      result.pair.c_str(), result.output.c_str(), result.pairs, result.hit_percent,
      result.bullet.different, result.bullet.excluded);
  if (!result.wrong.empty()) {
    std::printf("  Carom differs from its reference: %s\n", result.wrong.c_str());
  }
  if (result.runners.empty()) return;
  std::printf("  %-24s %10s %9s %8s %10s %9s %9s\n", "runner", "ns/pair", "x Bullet", "passes",
              "otherwise", "error", "worst");
  for (const RunnerResult& runner : result.runners) print(result, runner);
  std::fflush(stdout);
}

void print(const ExactResult& result) {
  std::printf(
      "\n%s, exact decisions of %s pairs: %zu pairs, %.1f %% overlap; CGAL: %zu otherwise\n",
      result.pair.c_str(), result.touching ? "touching" : "random", result.pairs,
      result.hit_percent, result.different);
  for (const RunnerResult& runner : result.runners) {
    std::printf("  %-24s %10.2f %18zu\n", runner.runner.c_str(), 1e9 * runner.seconds_per_pair(),
                runner.passes);
  }
  std::fflush(stdout);
}

ordered_json streams_json(const std::vector<StreamResult>& results) {
  ordered_json json = ordered_json::array();
  for (const StreamResult& result : results) json.push_back(stream_json(result));
  return json;
}

ordered_json exact_json(const std::vector<ExactResult>& results) {
  ordered_json json = ordered_json::array();
  for (const ExactResult& result : results) {
    ordered_json entry = {{"pair", result.pair},
                          {"touching", result.touching},
                          {"pairs", result.pairs},
                          {"hit_percent", result.hit_percent},
                          {"different", result.different}};
    for (const RunnerResult& runner : result.runners) {
      entry["ns"][runner.runner] = 1e9 * runner.seconds_per_pair();
    }
    json.push_back(entry);
  }
  return json;
}

}  // namespace carom::bench

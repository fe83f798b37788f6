#include "bench/peers/narrowphase/report.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace carom::bench {
namespace {

using nlohmann::ordered_json;

double ns_per_pair(const StreamResult& result, double seconds) {
  return 1e9 * seconds / static_cast<double>(result.pairs);
}

// Speed relative to Bullet.
double times_bullet(const StreamResult& result, const RunnerResult& runner) {
  return result.timed("bullet")->median_seconds / runner.median_seconds;
}

ordered_json runner_json(const StreamResult& result, const RunnerResult& runner) {
  return {{"runner", runner.runner},
          {"ns", ns_per_pair(result, runner.median_seconds)},
          {"ns_min", ns_per_pair(result, runner.least_seconds)},
          {"times_bullet", times_bullet(result, runner)},
          {"passes", runner.passes},
          {"different", runner.different}};
}

ordered_json stream_json(const StreamResult& result) {
  ordered_json json = {{"pair", result.pair},           {"detail", result.output},
                       {"pairs", result.pairs},         {"hit_percent", result.hit_percent},
                       {"wrong", result.wrong},         {"excluded", result.excluded},
                       {"different", result.different}, {"bullet_points", result.bullet_points}};
  json["runners"] = ordered_json::array();
  for (const RunnerResult& runner : result.runners) {
    json["runners"].push_back(runner_json(result, runner));
  }
  return json;
}

}  // namespace

void print(const StreamResult& result) {
  std::printf(
      "\n%s, %s: %zu pairs, %.1f %% overlap; Bullet: %zu decide otherwise, %zu not compared\n",
      result.pair.c_str(), result.output.c_str(), result.pairs, result.hit_percent,
      result.different, result.excluded);
  if (!result.wrong.empty()) {
    std::printf("  Carom differs from its reference: %s\n", result.wrong.c_str());
  }
  if (result.runners.empty()) return;
  std::printf("  %-24s %10s %9s %8s %10s\n", "runner", "ns/pair", "x Bullet", "passes",
              "otherwise");
  for (const RunnerResult& runner : result.runners) {
    std::printf("  %-24s %10.2f %9.2f %8zu %10zu\n", runner.runner.c_str(),
                ns_per_pair(result, runner.median_seconds), times_bullet(result, runner),
                runner.passes, runner.different);
  }
  std::fflush(stdout);
}

ordered_json streams_json(const std::vector<StreamResult>& results) {
  ordered_json json = ordered_json::array();
  for (const StreamResult& result : results) json.push_back(stream_json(result));
  return json;
}

}  // namespace carom::bench

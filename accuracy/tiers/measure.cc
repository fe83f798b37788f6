#include "accuracy/tiers/measure.h"

#include <chrono>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "accuracy/pairs/round_pair.h"
#include "accuracy/pairs/undecided.h"
#include "accuracy/tiers/effort.h"
#include "accuracy/tiers/failures.h"
#include "accuracy/tiers/sweeps.h"
#include "accuracy/tiers/tradeoff.h"
#include "carom/simd/isa.h"
#include "carom_build_info.h"
#include "io/cpu_name.h"

namespace carom::accuracy {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

Json document(const MeasureOptions& options) {
  Json json = {{"carom_accuracy", 1},           {"version", build_info::kVersion},
               {"commit", build_info::kCommit}, {"compiler", build_info::kCompiler},
               {"flags", build_info::kFlags},   {"isa", name(active_isa())},
               {"cpu", io::cpu_name()},         {"mode", options.is_long ? "long" : "short"},
               {"seed", options.seed},          {"seconds", 0.0}};
  for (const char* section : {"tradeoff", "by_gap", "by_distance", "by_angle", "undecided", "reuse",
                              "fidelity", "matrix", "atlas", "failures"}) {
    json[section] = Json::array();
  }
  return json;
}

void measure_kinds(const NamedKinds& kinds, const MeasureOptions& options, Json& json,
                   Failures& failures) {
  const Effort effort = effort_for(kinds.kinds, options.is_long);
  if (has_round(kinds.kinds)) {
    measure_round(kinds, effort, options.seed, {json["tradeoff"], json["matrix"], json["atlas"]},
                  failures);
    return;
  }
  measure_tradeoff(kinds, effort, options.seed, {json["tradeoff"], json["matrix"], json["atlas"]},
                   failures);
  measure_gaps(kinds, effort, options.seed, json["by_gap"], failures);
  measure_distances(kinds, effort, options.seed, json["by_distance"]);
  measure_angles(kinds, effort, options.seed, json["by_angle"], failures);
}

}  // namespace

Json measure(const MeasureOptions& options, const MeasureProgress& progress) {
  const auto begin = Clock::now();
  Json json = document(options);
  Failures failures;
  const bool is_all = options.kinds.size() == std::size(kAllKinds) + round_kinds().size();
  const size_t steps = options.kinds.size() + (is_all ? 1 : 0);
  for (size_t i = 0; i < options.kinds.size(); ++i) {
    progress(i, steps);
    measure_kinds(options.kinds[i], options, json, failures);
  }
  if (is_all) {
    progress(steps - 1, steps);
    const Effort scenes = effort_for({ShapeKind::box, ShapeKind::box}, options.is_long);
    measure_undecided(scenes.scene, scenes.rounds, options.seed, json["undecided"]);
  }
  for (const std::string& failure : failures.texts()) json["failures"].push_back(failure);
  json["seconds"] = std::chrono::duration<double>(Clock::now() - begin).count();
  return json;
}

}  // namespace carom::accuracy

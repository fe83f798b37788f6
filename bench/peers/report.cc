#include "bench/peers/report.h"

#include <CGAL/version.h>

#include <chrono>
#include <ctime>
#include <nlohmann/json.hpp>
#include <thread>

#include "bench/peers/broadphase/report.h"
#include "bench/peers/narrowphase/report.h"
#include "bench/support/context.h"
#include "carom/simd/isa.h"
#include "io/files/atomic_file.h"

namespace carom::bench {
namespace {

using nlohmann::ordered_json;

std::string now() {
  const std::time_t time = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&time));
  return text;
}

ordered_json context_json(const TimeLimits& limits) {
  ordered_json json;
  json["date"] = now();
  for (const auto& [key, value] : context()) json[key] = value;
  json["isa"] = carom::name(active_isa());
  json["processors"] = std::thread::hardware_concurrency();
  json["peer_flags"] = CAROM_PEER_FLAGS;
  json["libraries"] = {{"cgal", CGAL_VERSION_STR},
                       {"bullet", CAROM_BULLET_VERSION},
                       {"fcl", CAROM_FCL_VERSION},
                       {"ode", CAROM_ODE_VERSION},
                       {"ccd", CAROM_CCD_VERSION},
                       {"mujoco", CAROM_MUJOCO_VERSION}};  // "" where it is not installed
  json["budget_s"] = limits.budget;
  json["frame_limit_s"] = limits.frame_limit;
  return json;
}

}  // namespace

Result<void> write_json(const std::string& path, const Comparisons& comparisons) {
  const ordered_json json = {{"context", context_json(comparisons.limits)},
                             {"scenes", scenes_json(comparisons.scenes)},
                             {"streams", streams_json(comparisons.streams)},
                             {"exact", exact_json(comparisons.exact)}};
  return io::write_text_file(path, json.dump(2) + "\n");
}

}  // namespace carom::bench

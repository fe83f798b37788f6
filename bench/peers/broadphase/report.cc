#include "bench/peers/broadphase/report.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace carom::bench {
namespace {

using nlohmann::ordered_json;

// Speed relative to the yardstick; 0 if unknown.
double times_yardstick(const SceneResult& result, const PeerResult& peer) {
  const PeerResult* yardstick = result.timed(kYardstick);
  return yardstick ? yardstick->median_seconds / peer.median_seconds : 0;
}

double ns_per_body(const SceneResult& result, const PeerResult& peer) {
  return 1e9 * peer.median_seconds / static_cast<double>(result.bodies);
}

const char* name(Outcome outcome) {
  switch (outcome) {
    case Outcome::timed:
      return "timed";
    case Outcome::too_slow:
      return "too slow";
    case Outcome::different:
      return "different pairs";
  }
  return "";
}

ordered_json peer_json(const SceneResult& result, const PeerResult& peer) {
  ordered_json json = {
      {"peer", peer.peer}, {"threads", peer.threads}, {"outcome", name(peer.outcome)}};
  if (peer.outcome != Outcome::timed) {
    json["detail"] = peer.detail;
    return json;
  }
  json["ms"] = 1e3 * peer.median_seconds;
  json["ms_min"] = 1e3 * peer.least_seconds;
  json["ns_per_body"] = ns_per_body(result, peer);
  json["times_cgal"] = times_yardstick(result, peer);
  json["frames"] = peer.frames;
  return json;
}

ordered_json scene_json(const SceneResult& result) {
  ordered_json json = {{"scene", result.scene},
                       {"bodies", result.bodies},
                       {"pairs", result.pairs},
                       {"held_to_brute_force", result.held_to_brute_force},
                       {"brute_force_difference", result.brute_force}};
  json["peers"] = ordered_json::array();
  for (const PeerResult& peer : result.peers) json["peers"].push_back(peer_json(result, peer));
  return json;
}

}  // namespace

void print(const SceneResult& result) {
  std::printf("\n%s: %zu bodies, %zu pairs\n", result.scene.c_str(), result.bodies, result.pairs);
  if (!result.brute_force.empty()) {
    std::printf("  Carom differs from brute force: %s\n", result.brute_force.c_str());
    return;
  }
  std::printf("  %-24s %7s %10s %10s %9s %8s\n", "peer", "threads", "ms/frame", "ns/body", "x CGAL",
              "frames");
  for (const PeerResult& peer : result.peers) {
    std::printf("  %-24s %7d ", peer.peer.c_str(), peer.threads);
    if (peer.outcome == Outcome::timed) {
      std::printf("%10.4f %10.1f %9.2f %8zu\n", 1e3 * peer.median_seconds,
                  ns_per_body(result, peer), times_yardstick(result, peer), peer.frames);
    } else {
      std::printf("%s: %s\n", name(peer.outcome), peer.detail.c_str());
    }
  }
  std::fflush(stdout);
}

ordered_json scenes_json(const std::vector<SceneResult>& results) {
  ordered_json json = ordered_json::array();
  for (const SceneResult& result : results) json.push_back(scene_json(result));
  return json;
}

}  // namespace carom::bench

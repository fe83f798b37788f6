// Compares all peers on one scene: first their pairs, then their times in turns.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/peers/broadphase/peer.h"
#include "bench/peers/broadphase/scenes.h"

namespace carom::bench {

struct TimeLimits {
  double budget = 1;       // seconds of frames for each peer
  double frame_limit = 5;  // a slower peer is left out
};

enum class Outcome {
  timed,
  too_slow,   // or expected to be
  different,  // its pairs differ from Carom's
};

struct PeerResult {
  std::string peer;
  int threads = 1;
  Outcome outcome = Outcome::timed;
  std::string detail;  // why it was not timed
  size_t frames = 0;   // timed
  double median_seconds = 0;
  double least_seconds = 0;
};

struct SceneResult {
  std::string scene;
  size_t bodies = 0;
  size_t pairs = 0;         // of the second frame
  std::string brute_force;  // Carom's difference from brute force; empty if none
  bool held_to_brute_force = false;
  std::vector<PeerResult> peers;  // empty if Carom is wrong

  // The result of the peer on one thread, if it was timed.
  const PeerResult* timed(const std::string& peer) const;
  bool all_equal() const;
};

// Median seconds per frame of each peer, by name, on a scene with a tenth of the bodies.
using SmallerScene = std::map<std::string, double>;

SceneResult compare(const PeerScene& scene, const std::vector<PeerKind>& kinds,
                    const TimeLimits& limits, const SmallerScene& smaller);

}  // namespace carom::bench

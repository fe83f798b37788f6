// All peers on one scene: first their pairs are compared, then they are timed in turns.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/peers/broadphase/peer.h"
#include "bench/peers/broadphase/scenes.h"

namespace carom::bench {

struct TimeLimits {
  double budget = 1;       // seconds of frames a peer
  double frame_limit = 5;  // a peer that needs longer for a frame is left out
};

enum class Outcome {
  timed,
  too_slow,   // or expected to be
  different,  // not Carom's pairs
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
  std::string brute_force;  // how Carom differs from it; empty: not at all
  bool held_to_brute_force = false;
  std::vector<PeerResult> peers;  // none where Carom is wrong

  // The result of the peer on one thread, if it was timed.
  const PeerResult* timed(const std::string& peer) const;
  bool all_equal() const;
};

// The median seconds a frame of peers on a scene with a tenth of the bodies, by their names.
using SmallerScene = std::map<std::string, double>;

SceneResult compare(const PeerScene& scene, const std::vector<PeerKind>& kinds,
                    const TimeLimits& limits, const SmallerScene& smaller);

}  // namespace carom::bench

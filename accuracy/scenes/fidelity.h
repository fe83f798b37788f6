// Measures what the fast tier and a tolerance change in whole scenes and how much time they save.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "accuracy/scenes/playback.h"
#include "carom/base/result.h"

namespace carom::accuracy {

// One scene at the fast tier, compared with the standard one; sums over all frames. Times are as in
// TrialResult and come from alternating runs; lengths are metres.
struct FidelityEntry {
  std::string scene;
  std::string setting;  // "single precision"
  uint64_t pairs = 0;   // candidates of the standard run
  uint64_t lost = 0;    // overlaps of the standard run that are missing
  uint64_t gained = 0;  // overlaps that the standard run does not have
  double contact_error_worst = 0;
  double contact_error_p99 = 0;
  uint64_t events_moved = 0;  // begin and end events that happen in another frame
  double frame_ms = 0;
  double frame_ms_standard = 0;
};

// The same for Accuracy::tolerance.
struct ReuseEntry {
  std::string scene;
  double tolerance = 0;
  double frame_ms = 0;
  double frame_ms_standard = 0;
  double error_bound = 0;  // the promise: the tolerance
  double error_worst = 0;  // of separations, including lost and gained overlaps
  uint64_t lost = 0;
  uint64_t gained = 0;
  uint64_t pairs = 0;
};

struct FidelityReport {
  std::vector<FidelityEntry> fidelity;
  std::vector<ReuseEntry> reuse;
};

// Generated scenes (as on the command line) that show the effect: creeping boxes,
// moving boxes and spheres, and a level in which nine tenths of the bodies rest. `is_short`: small
// scenes that take some seconds in all.
std::vector<std::string> fidelity_scenes(bool is_short);

// Adds the entries of a scene to the report. Runs the scene 1 + `rounds` times with each setting.
Result<void> measure_fidelity(const Playback& scene, int rounds, FidelityReport& report);

}  // namespace carom::accuracy

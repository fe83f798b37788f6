// What the knobs of Tier::fast change in whole scenes, and what they save.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "accuracy/scenes/playback.h"
#include "carom/base/result.h"

namespace carom::accuracy {

// One scene with one knob against the standard tier, sums over all frames. Times are those of
// TrialResult, measured in turns; lengths are metres.
struct FidelityEntry {
  std::string scene;
  std::string setting;  // "single precision", "faces only", "proxy spheres"
  uint64_t pairs = 0;   // candidates of the standard run
  uint64_t lost = 0;    // overlaps that are missing
  uint64_t gained = 0;  // overlaps that are none
  double contact_error_worst = 0;
  double contact_error_p99 = 0;
  uint64_t events_moved = 0;  // begins and ends that do not happen in the same frame
  double frame_ms = 0;
  double frame_ms_standard = 0;
};

// The same for FastKnobs::motion_tolerance.
struct ReuseEntry {
  std::string scene;
  double tolerance = 0;
  double frame_ms = 0;
  double frame_ms_standard = 0;
  double error_bound = 0;  // what the knob promises: twice the tolerance
  double error_worst = 0;  // of separations, lost and gained overlaps included
  uint64_t lost = 0;
  uint64_t gained = 0;
  uint64_t pairs = 0;
};

struct FidelityReport {
  std::vector<FidelityEntry> fidelity;
  std::vector<ReuseEntry> reuse;
};

// Generators (as on the command line) that show what knobs do: boxes that creep, boxes and spheres
// that move, a level of which nine tenths rest. `is_short`: small ones, for some seconds in all.
std::vector<std::string> fidelity_scenes(bool is_short);

// Adds the entries of a scene to the report. It is run 1 + `rounds` times with each setting.
Result<void> measure_fidelity(const Playback& scene, int rounds, FidelityReport& report);

}  // namespace carom::accuracy

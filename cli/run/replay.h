// Plays the frames of a scene into a world and records the results.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "carom/world/world.h"
#include "cli/page/motion_track.h"
#include "cli/run/pairs_out.h"
#include "cli/run/state_hash.h"
#include "cli/scenes/player.h"
#include "cli/support/progress.h"
#include "io/scene.h"

namespace carom::cli {

// Every list has one entry for each frame.
struct RunRecord {
  std::vector<double> frame_ms;       // World::step() alone, without reading and copying poses
  std::vector<uint64_t> page_faults;  // of the process, during the steps
  std::array<std::vector<double>, kStageCount> stage_ms;
  std::array<std::vector<double>, kStageCount> serial_ms;  // of these, on one thread alone
  std::vector<uint64_t> pairs;
  std::vector<uint64_t> contacts;  // at detail overlap: overlapping pairs; at pairs: empty
  std::vector<uint64_t> undecided;
  std::vector<uint64_t> tested;
  std::vector<uint64_t> by_models;
  std::array<std::vector<uint64_t>, kCountedRungs> by_rung;
  std::vector<uint64_t> by_shells;
  std::vector<uint64_t> kept;
  std::vector<uint64_t> dropped;
  std::vector<uint64_t> quarantined;
  // Only if bodies look ahead; otherwise empty.
  std::vector<uint64_t> swept;
  std::vector<uint64_t> impacts;
  std::vector<uint64_t> speculative;
  std::array<std::vector<uint64_t>, kEventKindCount> events;  // by EventKind
  std::vector<uint32_t> quarantined_bodies;                   // in any frame, ascending
  std::vector<uint64_t> searched;                             // bodies whose pairs were searched
  PairSearch search;                                          // of the last frame
  uint32_t stages_run = 0;                                    // in any frame
  StateHash hash;
};

// Replays `frames` frames into an empty world; its dynamic bodies get this detection. `pairs_out`
// and `track` may be absent.
Result<RunRecord> replay(io::SceneReader& scene, const Player& player, World& world,
                         uint64_t frames, std::optional<PairsOutput>& pairs_out, Progress& progress,
                         Detection detection = Detection::discrete, MotionTrack* track = nullptr);

}  // namespace carom::cli

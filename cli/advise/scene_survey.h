// Surveys a scene: kinds, positions and motion of its bodies, and its candidate pairs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/scenes/loaded_scene.h"
#include "cli/support/pair_kinds.h"

namespace carom::cli {

// Statistics of a list of numbers; all zero if it is empty.
struct Spread {
  double least = 0;
  double median = 0;
  double p99 = 0;
  double most = 0;
};
Spread spread_of(std::vector<double> values);

// The candidate pairs of a few frames.
struct PairSurvey {
  struct Kinds {
    std::string name;  // "sphere-box"
    uint64_t pairs = 0;
    uint64_t overlaps = 0;
  };
  uint64_t frames = 0;  // that were looked at
  uint64_t pairs = 0;   // sums over these frames
  uint64_t overlaps = 0;
  uint64_t near = 0;         // |separation| <= 2^-17 of the pair's mean bounding radius
  double error_bound = 0;    // error bound of standard separations, metres
  std::vector<Kinds> kinds;  // in the order of the codes
};

// Lengths are metres.
struct SceneSurvey {
  uint64_t bodies = 0;
  uint64_t frames = 0;  // that were looked at
  uint64_t frames_of_scene = 0;
  BodiesOfKind kinds{};
  uint64_t fixed = 0;  // static bodies
  uint64_t sensors = 0;
  bool has_filters = false;  // layers, masks, owners, spaces or excluded pairs
  bool has_velocities = false;
  bool has_orientation = false;     // the scene gives orientations that some body's kind reads
  bool all_decided_exactly = true;  // no shape that the exact tier refuses
  bool all_unturned = false;        // no body whose kind reads orientations is ever turned

  double farthest = 0;       // greatest coordinate of a position
  bool float64 = false;      // positions
  bool fits_float32 = true;  // every position is a float
  double float32_step = 0;   // between floats at `farthest`

  Spread radius;        // of the ball about a body's position that contains it; without half-spaces
  Spread aspect;        // longest by shortest edge
  Spread displacement;  // bound of the movement of points in a frame, of moving bodies
  double moving_share = 0;  // share of bodies that move in a frame

  PairSurvey pairs;
};

// Surveys the loaded frames of `scene`.
Result<SceneSurvey> survey(const LoadedScene& scene);

}  // namespace carom::cli

// What a scene is: what its bodies are, where, how they move, and what their pairs are like.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/scenes/loaded_scene.h"
#include "cli/support/pair_kinds.h"

namespace carom::cli {

// Of a list of numbers; all zero if it is empty.
struct Spread {
  double least = 0;
  double median = 0;
  double p99 = 0;
  double most = 0;
};
Spread spread_of(std::vector<double> values);

// Candidates of a few frames.
struct PairSurvey {
  struct Kinds {
    std::string name;  // "sphere-box"
    uint64_t pairs = 0;
    uint64_t overlaps = 0;
  };
  uint64_t frames = 0;  // that were looked at
  uint64_t pairs = 0;   // sums over these
  uint64_t overlaps = 0;
  uint64_t near = 0;         // |separation| <= 2^-17 of the pair's mean bounding radius
  double error_bound = 0;    // by which standard separations may be off, metres
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
  bool has_filters = false;  // layers, masks or owners
  bool has_velocities = false;
  bool has_orientation = false;  // that some body's kind reads
  bool all_unturned = false;     // but it is the identity for all of these

  double farthest = 0;       // greatest coordinate of a position
  bool float64 = false;      // positions
  bool fits_float32 = true;  // every position is a float
  double float32_step = 0;   // between floats at `farthest`

  Spread radius;        // of the ball about a body's position that holds it; half-spaces left out
  Spread aspect;        // longest by shortest edge
  Spread displacement;  // the most that a point of a body moves in a frame, of bodies that move
  double moving_share = 0;  // of the bodies, in a frame

  PairSurvey pairs;
};

// Of the frames that `scene` holds.
Result<SceneSurvey> survey(const LoadedScene& scene);

}  // namespace carom::cli

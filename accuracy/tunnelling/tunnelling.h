// What ways of looking after fast bodies miss, and what they cost: substeps, speculative contacts
// and times of impact, held against a reference that knows none of them (meeting.h).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/tunnelling/moving_scene.h"
#include "carom/base/parallelism.h"
#include "carom/base/result.h"
#include "carom/results/pair.h"

namespace carom::accuracy {

struct TunnellingOptions {
  std::vector<int> substeps = {1, 2, 4, 8, 16, 32};  // of the discrete runs
  int reference_substeps = 10000;
  int rounds = 5;  // of timing
  Parallelism parallelism = Parallelism::none;
};

// Times of impact beside the brackets of the reference, of all meetings that are certain.
struct ImpactTimes {
  uint64_t late = 0;     // after the bodies overlap
  double latest = 0;     // by this share of the interval at most
  double earliest = 0;   // before the bodies touch, by this share at most,
  double early_way = 0;  // and by this way, metres
};

// Sums over all frames.
struct TunnellingRow {
  Detection detection = Detection::discrete;
  int substeps = 1;        // a frame
  uint64_t seen = 0;       // of the certain meetings
  uint64_t missed = 0;     // the others
  uint64_t grazes = 0;     // seen that graze
  uint64_t unfounded = 0;  // seen that do not even graze
  double frame_ms = 0;     // all steps of a frame: the median of the least times of the frames
  std::optional<ImpactTimes> times;
};

// A pair that grazes, or a failure.
struct NotedPair {
  size_t frame;
  Pair pair;
  double least;      // separation, metres
  std::string what;  // of a failure
};

struct TunnellingReport {
  uint64_t bodies = 0;
  uint64_t dynamic = 0;
  size_t frames = 0;
  uint64_t meetings = 0;  // that are certain
  uint64_t at_start = 0;  // of these the bodies overlap at the start of the interval
  uint64_t poses = 0;     // of pairs of parts that the reference looked at
  double reference_seconds = 0;
  std::vector<TunnellingRow> rows;
  std::vector<NotedPair> grazing;
  std::vector<NotedPair> failures;  // continuous: certain meetings that it misses, or is late for
};

// How many steps of all are done.
using TunnellingProgress = std::function<void(size_t done, size_t all)>;

// Sensors count as bodies. Fails if a frame has more pairs than a world may have.
Result<TunnellingReport> measure_tunnelling(const MovingScene& scene,
                                            const TunnellingOptions& options,
                                            const TunnellingProgress& progress);

}  // namespace carom::accuracy

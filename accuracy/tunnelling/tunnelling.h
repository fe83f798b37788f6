// Measures what substeps, speculative contacts and times of impact miss of fast bodies and what
// they cost, compared with a reference that uses none of them (meeting.h).
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

// Times of impact compared with the reference's brackets, over all certain meetings.
struct ImpactTimes {
  uint64_t late = 0;     // times after the bodies overlap
  double latest = 0;     // the latest, as a share of the interval
  double earliest = 0;   // the earliest before the touch, as a share of the interval,
  double early_way = 0;  // and as the movement in that time, metres
};

// Sums over all frames.
struct TunnellingRow {
  Detection detection = Detection::discrete;
  int substeps = 1;        // a frame
  uint64_t seen = 0;       // certain meetings that were reported
  uint64_t missed = 0;     // certain meetings that were not
  uint64_t grazes = 0;     // reported pairs that graze
  uint64_t unfounded = 0;  // reported pairs that do not even graze
  double frame_ms = 0;     // all steps of a frame; mean over frames of the least time
  std::optional<ImpactTimes> times;
};

// A grazing pair or a failure.
struct NotedPair {
  size_t frame;
  Pair pair;
  double least;      // least separation, metres
  std::string what;  // description of a failure
};

struct TunnellingReport {
  uint64_t bodies = 0;
  uint64_t dynamic = 0;
  size_t frames = 0;
  uint64_t meetings = 0;  // certain ones
  uint64_t at_start = 0;  // those that overlap at the start of the interval
  uint64_t poses = 0;     // poses of pairs of parts that the reference examined
  double reference_seconds = 0;
  std::vector<TunnellingRow> rows;
  std::vector<NotedPair> grazing;
  std::vector<NotedPair> failures;  // certain meetings that continuous misses or finds late
};

// Reports that `done` of `all` steps are done.
using TunnellingProgress = std::function<void(size_t done, size_t all)>;

// Treats sensors like other bodies. Fails if a frame has more pairs than a world may have.
Result<TunnellingReport> measure_tunnelling(const MovingScene& scene,
                                            const TunnellingOptions& options,
                                            const TunnellingProgress& progress);

}  // namespace carom::accuracy

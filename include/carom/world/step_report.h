// What one step ran and how long it took.
#pragma once

#include <cstddef>
#include <cstdint>

#include "carom/broadphase/find_pairs.h"

namespace carom {

// The stages of a step in their order; a scene runs only those it needs.
enum class Stage : uint8_t {
  changes,      // which bodies changed since the last step
  bounds,       // world bounds of every body
  sweeps,       // bounds over the interval ahead, where a body is looked after
  margins,      // bounds fattened, of bodies that left those they had
  broadphase,   // pairs of overlapping bounds
  pairs,        // merge with the last step's pairs: what is carried, what is to be tested
  dops,         // k-DOPs of bodies, and which pairs of theirs are apart
  narrowphase,  // tests, batch by batch
  results,      // overlaps and contacts in order, carried ones included
  impacts,      // what bodies that are looked after will meet
  velocities,   // relative velocity along the normals
  events,       // begin, persist, end
};

inline constexpr int kStageCount = 12;

// "changes", "bounds", ...
CAROM_EXPORT const char* name(Stage stage);

struct StepReport {
  uint64_t step = 0;  // 1 for the first
  size_t bodies = 0;  // living, quarantined ones included
  size_t quarantined = 0;
  size_t pairs = 0;     // candidates
  size_t tested = 0;    // pairs the narrow phase ran
  size_t kept = 0;      // pairs whose last result was carried over
  size_t dropped = 0;   // pairs that were not tested because their k-DOPs are apart
  size_t overlaps = 0;  // overlapping pairs, sensors included
  size_t contacts = 0;
  size_t undecided = 0;  // pairs that Tier::certified could not decide
  size_t swept = 0;      // bodies that are looked after in this step, swept or continuous
  size_t unswept = 0;    // bodies whose motion is not finite, in steps that may look ahead
  size_t impacts = 0;
  size_t speculative = 0;  // speculative contacts
  PairSearch search;  // of the last broadphase that ran; incomplete: too many pairs, none given
  uint32_t stages_run = 0;              // bit s: Stage(s) ran
  uint64_t stage_ns[kStageCount] = {};  // 0 where it did not

  bool ran(Stage stage) const { return stages_run >> static_cast<int>(stage) & 1; }
};

}  // namespace carom

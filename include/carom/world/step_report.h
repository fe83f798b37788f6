/// @file
/// The report of one step: which stages ran, how long they took, and how much they found.
#pragma once

#include <cstddef>
#include <cstdint>

#include "carom/broadphase/find_pairs.h"
#include "carom/shapes/rungs.h"

namespace carom {

/// The stages of a step in their order; a scene runs only those that it needs.
enum class Stage : uint8_t {
  changes,     ///< which bodies changed since the last step
  bounds,      ///< world bounds of every body
  sweeps,      ///< bounds over the interval ahead, if a body looks ahead (Detection)
  margins,     ///< bounds grown by contact distances; new fat bounds for bodies that left theirs
  broadphase,  ///< pairs of overlapping bounds
  pairs,       ///< merge with the last step's pairs: which results are kept, which pairs are tested
  dops,        ///< k-DOPs of bodies, or hulls of meshes and compounds, and which pairs are separate
  narrowphase,  ///< tests, batch by batch
  results,      ///< overlaps and contacts in order, kept ones included
  impacts,      ///< impacts and speculative contacts of bodies that look ahead
  velocities,   ///< relative velocity along the normals
  events,       ///< begin, persist, end
};

/// How many stages there are.
inline constexpr int kStageCount = 12;

/// "changes", "bounds", ...
CAROM_EXPORT const char* name(Stage stage);

/// The numbers of one step.
struct StepReport {
  uint64_t step = 0;       ///< 1 for the first
  size_t bodies = 0;       ///< living bodies, quarantined ones included
  size_t quarantined = 0;  ///< bodies left out: World::quarantined()
  size_t pairs = 0;        ///< candidate pairs
  size_t tested = 0;       ///< pairs that the narrow phase tested
  /// Of these, those of a body that a model stands for (carom/shapes/rungs.h).
  size_t by_models = 0;
  /// How many of these models are rung 1, the finest, 2, 3, or any further one of their ladder. The
  /// further one counts where both bodies have a model.
  size_t by_rung[kCountedRungs] = {};
  /// Of the tested ones, those whose depth the shell of the last step proved within the tolerance
  /// (hulls).
  size_t by_shells = 0;
  size_t kept = 0;         ///< pairs that kept the result of the last step
  size_t dropped = 0;      ///< pairs not tested because their k-DOPs or hulls are separate
  size_t overlaps = 0;     ///< overlapping pairs, sensors included
  size_t contacts = 0;     ///< World::contacts()
  size_t left_out = 0;     ///< contacts beyond RegionLimits::most, at Detail::regions
  size_t undecided = 0;    ///< pairs that Tier::certified could not decide
  size_t swept = 0;        ///< bodies that look ahead in this step, swept or continuous
  size_t unswept = 0;      ///< bodies whose motion is not finite, in steps that may look ahead
  size_t impacts = 0;      ///< World::impacts()
  size_t speculative = 0;  ///< World::speculative_contacts()
  /// The last broadphase that ran; incomplete: it found too many pairs and gave none.
  PairSearch search;
  uint32_t stages_run = 0;              ///< bit s: Stage(s) ran
  uint64_t stage_ns[kStageCount] = {};  ///< nanoseconds of each stage, 0 where it did not run
  /// Of these, how long one thread worked alone: all of them in a world without threads. What n
  /// threads can gain is bound by their sum (Amdahl's law). Contacts get their velocities as they
  /// are written; that time is divided in proportion to what either took on all threads.
  uint64_t serial_ns[kStageCount] = {};

  /// Whether this stage ran.
  bool ran(Stage stage) const { return stages_run >> static_cast<int>(stage) & 1; }
};

}  // namespace carom

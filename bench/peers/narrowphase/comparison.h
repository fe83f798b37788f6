// Compares Carom, its scalar reference, Bullet and other libraries on streams of pairs: first the
// answers, then the times in turns.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/peers/narrowphase/answers.h"
#include "bench/peers/narrowphase/streams.h"

namespace carom::bench {

struct RunnerResult {
  // "reference", the name of an instruction set or of a library: "bullet", "bullet_gjk" (its other
  // cast), "fcl", "fcl_first" (one contact of two meshes), "ode", "ccd_gjk", "ccd_mpr", "mujoco"
  std::string runner;
  size_t pairs = 0;  // of a pass
  size_t passes = 0;
  double median_seconds = 0;  // processor time of a pass
  double least_seconds = 0;
  std::optional<Agreement> agreement = std::nullopt;  // of libraries

  double seconds_per_pair() const { return median_seconds / static_cast<double>(pairs); }
};

struct StreamResult {
  std::string pair;
  std::string output;  // PeerStreamSpec::output()
  size_t pairs = 0;
  double hit_percent = 0;
  std::string wrong;  // Carom's difference from its reference; empty if none
  // Casts of Bullet give up on some impacts and count some near misses, which is no fault.
  bool is_cast = false;
  Agreement bullet;
  std::vector<RunnerResult> runners;  // empty if a decision is wrong

  const RunnerResult* timed(const std::string& runner) const;
  bool agrees() const;
};

// `budget`: seconds of passes for each runner.
StreamResult compare(const PeerStreamSpec& spec, size_t pairs, double budget);

}  // namespace carom::bench

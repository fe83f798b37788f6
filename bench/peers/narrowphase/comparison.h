// Compares Carom, its scalar reference, Bullet and other libraries on streams of pairs: first the
// decisions, then the times in turns.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "carom/results/result_columns.h"
#include "carom/shapes/shape.h"

namespace carom::bench {

enum class Moving { no, times, contacts };

struct PeerStreamSpec {
  const char* pair;  // its name in narrowphase/pairs/pair_list.inc; "sphere_mesh"
  ShapeKind a;
  ShapeKind b;
  Detail detail;
  size_t vertices = 0;  // of hulls
  Measured measured = Measured::overlapping;
  // Tests the pairs of the last pass again, one step further (bench/support/pair_stream.h).
  bool again = false;
  // Times of impact, with or without contacts; one body of each pair moves in a straight line.
  Moving moving = Moving::no;

  // The stream's name: "hull_hull_16".
  std::string name() const;
  // The detail. "distance" if all pairs are measured, "clearance" if separate ones are, "again" if
  // those were measured in the step before.
  const char* output() const;
};

std::vector<PeerStreamSpec> peer_streams();

struct RunnerResult {
  std::string runner;  // "bullet", "fcl", "ode", "reference", or the name of an instruction set
  size_t passes = 0;
  double median_seconds = 0;  // processor time of a pass
  double least_seconds = 0;
  size_t different = 0;  // pairs that another library decides differently; Bullet's are below
};

struct StreamResult {
  std::string pair;
  std::string output;  // PeerStreamSpec::output()
  size_t pairs = 0;
  double hit_percent = 0;
  std::string wrong;     // Carom's difference from its reference; empty if none
  size_t excluded = 0;   // pairs too near touch for Bullet's decision to be compared
  size_t different = 0;  // of the other pairs, those that Bullet decides differently
  size_t bullet_points = 0;
  std::vector<RunnerResult> runners;  // empty if a decision is wrong

  const RunnerResult* timed(const std::string& runner) const;
  bool agrees() const;
};

// `budget`: seconds of passes for each runner.
StreamResult compare(const PeerStreamSpec& spec, size_t pairs, double budget);

}  // namespace carom::bench

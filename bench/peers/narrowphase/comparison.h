// Streams of pairs: Carom, its scalar reference and Bullet. First the decisions are compared, then
// all are timed in turns.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "carom/results/contact.h"
#include "carom/shapes/shape.h"

namespace carom::bench {

enum class Moving { no, times, contacts };

struct PeerStreamSpec {
  const char* pair;  // as narrowphase/pairs/pair_list.inc calls it; "sphere_mesh"
  ShapeKind a;
  ShapeKind b;
  Detail detail;
  size_t vertices = 0;  // of hulls
  Measured measured = Measured::overlapping;
  // The pairs of the last pass once more, a step further (bench/support/pair_stream.h).
  bool again = false;
  // Times of impact of pairs of which one moves in a straight line; with contacts, or alone.
  Moving moving = Moving::no;

  // As TARGETS are called: "hull_hull_16".
  std::string name() const;
  // The detail; "distance" where all pairs are measured, "clearance" where separate ones are, and
  // "again" where those were measured the step before.
  const char* output() const;
};

std::vector<PeerStreamSpec> peer_streams();

struct RunnerResult {
  std::string runner;  // "bullet", "reference", or the name of an instruction set
  size_t passes = 0;
  double median_seconds = 0;  // of processor time, of a pass
  double least_seconds = 0;
};

struct StreamResult {
  std::string pair;
  std::string output;  // as PeerStreamSpec calls it
  size_t pairs = 0;
  double hit_percent = 0;
  std::string wrong;     // how Carom differs from its reference; empty: not at all
  size_t excluded = 0;   // pairs too near touch for Bullet's decision to be compared
  size_t different = 0;  // of the others, those that Bullet decides otherwise
  size_t bullet_points = 0;
  std::vector<RunnerResult> runners;  // none where a decision is wrong

  const RunnerResult* timed(const std::string& runner) const;
  bool agrees() const;
};

// `budget`: seconds of passes a runner.
StreamResult compare(const PeerStreamSpec& spec, size_t pairs, double budget);

}  // namespace carom::bench

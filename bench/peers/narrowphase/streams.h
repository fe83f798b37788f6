// The streams of pairs that are compared.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "carom/results/result_columns.h"
#include "carom/shapes/shape.h"

namespace carom::bench {

// Times of impact of bodies that move in a straight line, the contacts as well, or the times of
// bodies that also turn.
enum class Moving { no, times, contacts, turning };

struct PeerStreamSpec {
  const char* pair;  // its name in narrowphase/pairs/pair_list.inc; "sphere_mesh"
  ShapeKind a;
  ShapeKind b;
  Detail detail;
  size_t vertices = 0;  // of hulls
  Measured measured = Measured::overlapping;
  // Tests the pairs of the last pass again, one step further (bench/support/pair_stream.h).
  bool again = false;
  Moving moving = Moving::no;

  // The stream's name: "hull_hull_16".
  std::string name() const;
  // The detail. "distance" if all pairs are measured, "clearance" if separate ones are, "again" if
  // those were measured in the step before. "toi", "impact" or "turning" if the bodies move.
  const char* output() const;
};

std::vector<PeerStreamSpec> peer_streams();

}  // namespace carom::bench

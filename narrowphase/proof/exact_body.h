// A body in exact numbers: the rotated corners of its core, and its radius.
#pragma once

#include <vector>

#include "base/surd.h"
#include "narrowphase/batch/stated_body.h"
#include "narrowphase/proof/overlap_search.h"

namespace carom {

using ExactVector = VectorOf<Dyadic>;

// Lengths are multiplied by `unit`, which is positive. The origin is the body's position.
struct ExactBody {
  std::vector<ExactVector> points;  // corners of the core; for a thick triangle those in front
  Dyadic unit{1.0};
  Dyadic radius;         // in metres
  ExactVector middle{};  // the sum of all points

  // Triangles: the normal of the front, of any length; zero without area.
  ExactVector front{};
  bool is_one_sided = false;
  // A thick triangle also has the corners p + depth sqrt(depth_radicand), for each corner p.
  double thickness = 0;  // in metres; zero without a front
  ExactVector depth{};
  Dyadic depth_radicand;

  // A half-space has no points. It holds all x with front . x <= offset, in these units.
  bool is_halfspace = false;
  Dyadic offset;
};

ExactBody exact_body(const StatedBody& body);

// Position of B minus position of A.
ExactVector exact_way(const StatedBody& a, const StatedBody& b);

}  // namespace carom

// A body in exact numbers: the corners of its core, turned, and its radius.
#pragma once

#include <vector>

#include "base/surd.h"
#include "narrowphase/batch/stated_body.h"
#include "narrowphase/proof/overlap_search.h"

namespace carom {

using ExactVector = VectorOf<Dyadic>;

// Lengths times `unit`, which is positive, about the body's position.
struct ExactBody {
  std::vector<ExactVector> points;  // the corners of the core; of a thick triangle those in front
  Dyadic unit{1.0};
  Dyadic radius;         // in metres
  ExactVector middle{};  // the sum of all points

  // Triangles: the front's normal, of any length, and zero without area.
  ExactVector front{};
  bool is_one_sided = false;
  // Thick ones reach from each corner p to p + depth sqrt(depth_radicand), too.
  double thickness = 0;  // in metres; zero where there is no front
  ExactVector depth{};
  Dyadic depth_radicand;

  // Half-spaces have no points: all x with front . x <= offset, in these units.
  bool is_halfspace = false;
  Dyadic offset;
};

ExactBody exact_body(const StatedBody& body);

// B - A of the positions.
ExactVector exact_way(const StatedBody& a, const StatedBody& b);

}  // namespace carom

// Boxes around queries and their motions.
#pragma once

#include <array>
#include <vector>

#include "broadphase/tree_walk.h"
#include "carom/results/sweep.h"
#include "carom/shapes/views.h"
#include "queries/bounds_of.h"

namespace carom {

class QueryBoxes {
 public:
  // With an empty sweep the queries stand still.
  QueryBoxes(const Collidables& queries, const SweepView& sweep)
      : queries_(queries), sweep_(sweep) {}

  const Collidables& queries() const { return queries_; }
  size_t count() const { return queries_.count; }

  // Finds where queries [first, first + count) start.
  void find(size_t first, size_t count, Parallelism parallelism);
  // Sets `box` to that of one of these, grown by more than tests may err. False, and nothing is
  // done, if the query or its sweep is invalid.
  bool set_box(size_t query, MovingBox& box) const;

 private:
  const Collidables& queries_;
  const SweepView& sweep_;
  size_t first_ = 0;
  BoundsOf bounds_;
  std::vector<TreeBox> at_start_;  // grown; kNothing for an invalid query
};

}  // namespace carom

// Boxes around queries and their motions.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "broadphase/tree_walk.h"
#include "carom/results/sweep.h"
#include "carom/shapes/views.h"
#include "queries/bounds_of.h"

namespace carom {

class QueryBoxes {
 public:
  // With an empty sweep the queries stand still.
  QueryBoxes(const Collidables& queries, const SweepView& sweep, Parallelism parallelism)
      : queries_(queries), sweep_(sweep), bounds_(queries, parallelism) {}

  const Collidables& queries() const { return queries_; }
  size_t count() const { return queries_.count; }

  // The box of a query, grown by more than tests may err. None if the query or its sweep is
  // invalid.
  std::optional<MovingBox> box(size_t query) const;

 private:
  const Collidables& queries_;
  const SweepView& sweep_;
  const BoundsOf bounds_;
};

}  // namespace carom

// Pairs to measure, laid out for the library; pair i is row i of both sides.
#pragma once

#include <vector>

#include "accuracy/pairs/bodies.h"
#include "accuracy/pairs/oracle_pairs.h"

namespace carom::accuracy {

class PairSet {
 public:
  PairSet(std::vector<ConvexPair> pairs, PositionType positions);

  size_t size() const { return pairs_.size(); }
  // The stored pair.
  const ConvexPair& operator[](size_t i) const { return pairs_[i]; }
  PositionType positions() const { return positions_; }
  const Collidables& a() const { return a_.view(); }
  const Collidables& b() const { return b_.view(); }

 private:
  std::vector<ConvexPair> pairs_;
  PositionType positions_;
  BodyArrays a_;
  BodyArrays b_;
};

}  // namespace carom::accuracy

// Between broadphase and narrow phase: meshes and compounds whose hulls are surely apart need no
// search of their parts. The hull of one is a 26-DOP in its own frame, which turns with it. Results
// are the same with and without.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "base/raw_vector.h"
#include "carom/base/parallelism.h"
#include "carom/results/pair.h"
#include "carom/results/result_arrays.h"
#include "carom/shapes/hull.h"
#include "world/pairs/pauses.h"
#include "world/store/body_store.h"
#include "world/store/columns.h"

namespace carom {

class OuterStage {
 public:
  // Whether it is worth it in this step: it pauses where few pairs are apart. Call it once a step.
  bool starts_step();

  // One byte a pair: 0 if both bodies are meshes or compounds of many parts, about as large as each
  // other, and their hulls are apart; 1 otherwise.
  const std::vector<uint8_t>& test(const BodyStore& bodies, std::span<const Pair> pairs,
                                   Parallelism parallelism);

  void give_back();
  size_t bytes() const;

 private:
  // The hull of a geometry, which may be gone.
  struct Outer {
    std::weak_ptr<const void> of;
    std::shared_ptr<const HullGeometry> hull;
  };

  void update(const BodyStore& bodies);
  void judge(size_t apart);
  const HullGeometry* hull_of(const BodyStore& bodies, uint32_t body);

  std::map<const void*, Outer> outer_;
  // The bodies with hulls in place of meshes and compounds.
  std::vector<ShapeKind> kind_;
  std::vector<uint32_t> first_row_;
  std::vector<float> size_;  // of the hull; 0: none stands for the body
  LargeVector<BodyStore::Row> rows_;
  bool is_known_ = false;
  Pauses pauses_{4, 64};

  std::vector<Pair> tested_;
  std::vector<uint32_t> place_;  // of each among the pairs
  std::vector<uint8_t> needs_test_;
  ResultArrays results_;
};

}  // namespace carom

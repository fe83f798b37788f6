// The pairs of continuous bodies -> their times of impact.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/block_lists.h"
#include "carom/impacts/time_of_impact.h"
#include "carom/results/impact.h"
#include "world/motion/look_ahead.h"
#include "world/store/columns.h"

namespace carom {

class ImpactStage {
 public:
  // Replaces the impacts by those of the step.
  void run(const LookAhead& ahead);

  // For a step without impacts.
  void clear();

  std::span<const Impact> impacts() const { return impacts_; }

  // The first impact that stops the body; nullptr if there is none.
  const Impact* first_of(uint32_t body) const;

  void give_back();
  size_t bytes() const;

 private:
  void find_candidates(const LookAhead& ahead);
  void sort_out(const LookAhead& ahead);
  void test(const LookAhead& ahead);
  void add_met(const LookAhead& ahead);
  void find_first(size_t bodies);
  void keep_earliest();
  ImpactColumns columns(bool contacts, bool sub_shapes);
  Impact impact(size_t row, Pair pair) const;
  Eigen::Vector3f vector(size_t column, size_t row) const;
  float first_time(uint32_t body) const;

  BlockLists<uint32_t> lists_;
  std::vector<uint32_t> candidates_;  // indices of pairs
  std::vector<Pair> pairs_;           // the pairs to test

  // Results of the tests, one row a pair.
  std::vector<float> toi_;
  std::vector<uint8_t> status_;
  std::vector<float> floats_;        // ten columns: separation, normal, arm_a, arm_b; or none
  std::vector<uint32_t> sub_shape_;  // two columns: of A, of B; empty without sub-shapes

  std::vector<Impact> impacts_, kept_;
  std::vector<uint32_t> first_;  // one a body: index of its first impact, or kNone
  static constexpr uint32_t kNone = 0xffffffffu;
};

}  // namespace carom

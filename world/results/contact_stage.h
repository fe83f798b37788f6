// Results of pair tests, new and carried -> the step's overlaps and contacts, sorted.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "carom/base/parallelism.h"
#include "carom/world/world.h"
#include "world/pairs/carry_plan.h"
#include "world/pairs/pair_history.h"
#include "world/results/list_moves.h"
#include "world/results/normal_velocities.h"
#include "world/results/result_buffer.h"
#include "world/store/body_store.h"
#include "world/store/columns.h"

namespace carom {

// Fills overlaps, contact indices, contacts and manifolds of a step.
class ContactStage {
 public:
  struct Input {
    const CarryPlan& plan;
    const PairHistory& last;
    const ResultBuffer& results;
    const BodyStore& bodies;
    const WorldSettings& settings;
  };

  // A step may use the contacts of the last one in three ways.
  enum class Last {
    unused,    // those of this step may take their memory
    copied,    // carried ones are copied
    in_place,  // carried ones stay in their list, which becomes that of this step
  };

  // Begins the lists of a step.
  void start(Last what, PairHistory& last, PairHistory& now);
  // Adds the results of a range of pairs, and room for their contacts. Ranges begin at multiples of
  // kPairsPerMergeBlock, and follow one another.
  void add_results(const PairRange& range, const Input& input, PairHistory& now);
  // Writes the contacts of the range whose results were added last, with their normal velocities
  // unless `velocities` is nullptr. Returns which part of its time was for these.
  double write_contacts(const PairRange& range, const Input& input,
                        const NormalVelocities* velocities, PairHistory& now);

  // After a step that begins or ends some overlaps of the last one alone.
  void add_overlaps(ptrdiff_t more) { overlaps_ += static_cast<size_t>(more); }

  size_t overlaps() const { return overlaps_; }
  size_t undecided() const { return undecided_; }
  size_t left_out() const { return left_out_; }  // contacts beyond RegionLimits::most
  size_t bytes() const {
    return block_first_.capacity() * sizeof(size_t) + moves_.capacity() * sizeof(ListMove);
  }
  void give_back() { give_back_scratch(moves_, block_first_); }

 private:
  void make_room(const PairRange& range, const Input& input, PairHistory& now);
  void move_carried(const PairRange& range, const Input& input, PairHistory& now);
  size_t write_block(const PairRange& range, const MergeRange& block, const Input& input,
                     size_t next, PairHistory& now) const;

  size_t overlaps_ = 0;
  size_t undecided_ = 0;
  size_t left_out_ = 0;
  bool in_place_ = false;
  std::vector<ListMove> moves_;
  // number of contacts of each block, later the place of its first one
  std::vector<size_t> block_first_;
};

}  // namespace carom

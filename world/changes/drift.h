// Accuracy::tolerance in time: how far bodies have travelled since their pairs were tested and
// since their bounds were made.
//
// Every body has an odometer, which counts in ticks, a small share of the tolerance. Its anchor is
// a pose that it had: the odometer shows what it had travelled by then, and how far from there it
// is now, so that a body which trembles about a place goes nowhere. Between two times no point of
// it has moved by more than the difference of the odometer and twice the distance from the anchor
// at the first of them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/block_lists.h"
#include "base/raw_vector.h"
#include "bounds/travel.h"
#include "carom/base/parallelism.h"
#include "world/changes/change_tracker.h"
#include "world/store/body_store.h"
#include "world/store/columns.h"

namespace carom {

struct BodyReader;

class Drift {
 public:
  // Begins in three steps, so that it is known in time whether that is worth it. First: remembers
  // where the bodies are.
  void prepare(const BodyStore& bodies, float tolerance);
  // In the next step: finds how fast they are, and returns which share of them is so slow that
  // bounds or results would hold for some steps. Then update(), or forget().
  float measure_paces(const BodyStore& bodies, Parallelism parallelism);
  bool is_prepared() const { return known_ == Known::poses; }
  void forget() { known_ = Known::nothing; }

  // Reads the odometers, and lists the bodies that need new bounds; all the first time. `shapes`
  // has compared boxes and rows. `tolerance`: of the world, metres.
  void update(const BodyStore& bodies, const ChangeTracker& shapes, float tolerance,
              Parallelism parallelism);

  // The bodies that may have left their bounds, ascending. If they are not few, all are listed.
  std::span<const uint32_t> outgrown() const { return outgrown_; }
  bool all_outgrown() const { return outgrown_.size() == travelled_.size(); }
  // By how many metres the new bounds of each of these must be larger than it is. They then hold it
  // for some steps, if it goes on as it has.
  std::span<const float> growth() const { return growth_; }

  // One byte a body: whether it is another one, or has another shape or other properties.
  std::span<const uint8_t> replaced() const { return replaced_; }

  // No odometer has gained more ticks in this step.
  uint32_t most_gained() const { return replaced_bodies_.empty() ? most_gained_ : kJump; }

  // One a body; and up to which sum of the two of a pair the result of a test of now holds.
  // `gap`, metres: the separation that they may lose before there is another result; a lower bound.
  std::span<const uint32_t> odometers() const { return travelled_; }
  uint32_t holds_until(Pair pair, float gap) const;
  // By how many metres two bodies come nearer in so many steps, if they go on as in this one.
  float reach(Pair pair, float steps) const;

  void give_back();
  size_t bytes() const;

 private:
  // When the bounds of a body were made.
  struct Made {
    uint32_t at;  // its odometer
    uint32_t in_step;
  };

  template <class T>
  TravelColumns<T> columns(const LargeVector<T>& positions, const BodyStore& bodies,
                           std::array<LargeVector<T>, 3>& anchors);
  void resize(const BodyStore& bodies);
  void move_elsewhere(const BodyStore& bodies, const BodyReader& reader, uint32_t index,
                      float tolerance);
  float unit_of(const BodyStore& bodies, float tolerance) const;
  void begin(const BodyStore& bodies, float tolerance);
  void move_all_elsewhere(const BodyStore& bodies, float tolerance);
  void read_odometers(const BodyStore& bodies, Parallelism parallelism);
  void find_moved_elsewhere(const BodyStore& bodies, const ChangeTracker& shapes, float tolerance);
  void find_outgrown(Parallelism parallelism);
  void list_past(const std::vector<uint32_t>& fence, Parallelism parallelism);
  float make_fence(uint32_t index);
  float pace_of(uint32_t body) const;
  float most_growth(uint32_t body) const;

  float ticks_per_metre_ = 0;
  uint32_t step_ = 0;
  enum class Known : uint8_t { nothing, poses, paces, all } known_ = Known::nothing;

  std::array<LargeVector<float>, 3> anchors32_;  // as the store has positions
  std::array<LargeVector<double>, 3> anchors64_;
  std::array<LargeVector<float>, 4> anchor_orientations_;
  std::vector<float> radii_, turn_radii_;  // the second: 0 for what does not turn
  std::vector<uint32_t> anchored_, travelled_, travelled_before_;  // the last: in the last step
  // Ticks of a pair's tolerance that are this body's; and a mark of one-sided triangles, since a
  // body behind them is not near.
  static constexpr uint32_t kHasFront = 1u << 31;
  std::vector<uint32_t> share_;
  uint32_t most_gained_ = 0;
  std::vector<uint8_t> replaced_;
  std::vector<uint32_t> replaced_bodies_;  // those with a byte
  // The bounds of a body hold it until its odometer passes the fence; the early one is half way.
  std::vector<uint32_t> fence_, early_fence_;
  std::vector<Made> made_;
  BlockLists<uint32_t> outgrown_of_block_;
  std::vector<uint32_t> outgrown_;
  std::vector<float> growth_;
};

}  // namespace carom

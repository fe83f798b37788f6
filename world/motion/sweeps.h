// How bodies move in the interval ahead of a step, and which of them look ahead.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "carom/base/parallelism.h"
#include "carom/results/sweep.h"
#include "world/store/body_store.h"
#include "world/store/columns.h"

namespace carom {

class Sweeps {
 public:
  // Covers all bodies, also those that do not look ahead: others may meet them.
  void update(const BodyStore& bodies, double dt, float fast_share, Parallelism parallelism);

  // Whether the last update differs from the one before in the interval, the motions in it, or the
  // bodies that look ahead.
  bool changed() const { return changed_; }

  // Whether some body is swept or continuous in this step.
  bool any() const { return swept_ > 0; }
  bool any_continuous() const { return continuous_ > 0; }
  bool any_merely_swept() const { return swept_ > continuous_; }

  // Whether the body is swept or continuous, and its motion finite.
  bool looks_ahead(uint32_t index) const { return mode_[index] >= Mode::swept; }
  bool is_continuous(uint32_t index) const { return mode_[index] == Mode::continuous; }
  bool is_finite(uint32_t index) const { return mode_[index] != Mode::unknown; }

  bool turns(uint32_t index) const { return !rotation_.empty() && !rotation_[index].isZero(0); }

  // Zero for bodies whose motion is not finite.
  Sweep sweep(uint32_t index) const;
  SweepView view() const;

  size_t swept() const { return swept_; }      // bodies that look ahead
  size_t unswept() const { return unswept_; }  // bodies whose motion is not finite

  void give_back() { carom::give_back(mode_, displacement_, rotation_); }
  size_t bytes() const;

 private:
  enum class Mode : uint8_t { unknown, discrete, swept, continuous };

  struct Row {
    Sweep sweep;
    Mode mode = Mode::discrete;
  };
  struct Counts {
    size_t swept = 0, continuous = 0, unswept = 0;
    bool changed = false;
  };

  static Mode mode_of(Detection detection);
  static Row row_of(const BodyStore& bodies, const Collidables& view, uint32_t index, double dt,
                    float fast_share);
  void store(uint32_t index, const Row& row, Counts& counts);

  std::vector<Mode> mode_;
  std::vector<Eigen::Vector3f> displacement_;
  std::vector<Eigen::Vector3f> rotation_;  // empty while no body turns
  double dt_ = 0;
  bool changed_ = false;
  size_t swept_ = 0, continuous_ = 0, unswept_ = 0;
};

}  // namespace carom

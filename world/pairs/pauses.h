// When a stage that has not paid for itself is left out, and for how long.
#pragma once

#include <algorithm>
#include <cstdint>

namespace carom {

// Each pause is twice as long as the last, up to a limit, until the stage pays again.
class Pauses {
 public:
  Pauses(uint32_t shortest, uint32_t longest)
      : shortest_(shortest), longest_(longest), next_(shortest) {}

  // Call it once a step. Whether the stage runs in it.
  bool starts_step() {
    if (left_ == 0) return true;
    --left_;
    return false;
  }

  // The stage did not pay: begins a pause.
  void begin() {
    left_ = next_;
    next_ = std::min(2 * next_, longest_);
  }

  // The stage paid: ends the pause, and the next is short again.
  void end() {
    left_ = 0;
    next_ = shortest_;
  }

 private:
  uint32_t shortest_, longest_;
  uint32_t left_ = 0;  // steps of this pause to come
  uint32_t next_;      // steps of the next pause
};

}  // namespace carom

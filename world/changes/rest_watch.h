// Decides when to compare all bodies with the last step, in worlds that only gain by it while at
// rest.
#pragma once

#include <algorithm>
#include <cstdint>

namespace carom {

class RestWatch {
 public:
  // Whether the next step compares the bodies.
  bool is_on() const { return state_ != State::off; }

  // Called after a step in which nothing had changed.
  void saw_rest() { patience_ = 1; }

  // Called after any other step; `quiet`: nothing seems to have moved. After enough quiet steps the
  // watch begins. Its first comparison only makes the copy. A comparison that finds a change ends
  // the watch, and each time the next one begins later.
  void saw_step(bool quiet) {
    switch (state_) {
      case State::off:
        quiet_steps_ = quiet ? quiet_steps_ + 1 : 0;
        if (quiet_steps_ >= patience_) state_ = State::copies;
        return;
      case State::copies:
        state_ = State::compares;
        return;
      case State::compares:
        state_ = State::off;
        quiet_steps_ = 0;
        patience_ = std::min(2 * patience_, kMostPatience);
    }
  }

 private:
  enum class State : uint8_t { off, copies, compares };

  static constexpr uint32_t kMostPatience = 64;

  State state_ = State::off;
  uint32_t quiet_steps_ = 0;
  uint32_t patience_ = 1;  // quiet steps before the bodies are compared
};

}  // namespace carom

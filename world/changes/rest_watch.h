// When to compare all bodies with the last step, where only a world at rest gains by it.
#pragma once

#include <algorithm>
#include <cstdint>

namespace carom {

class RestWatch {
 public:
  // Whether the next step compares the bodies.
  bool is_on() const { return state_ != State::off; }

  // After a step in which nothing had changed.
  void saw_rest() { patience_ = 1; }

  // After any other; `quiet`: nothing seems to have moved. The first comparison only makes the
  // copy; one that finds a change ends the watch, and the next one comes later each time.
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

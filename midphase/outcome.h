// What is known of a pair of bodies while its parts are tested.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>

#include "carom/results/contact.h"
#include "carom/results/tier.h"

namespace carom {

// A pair of parts that may be the one to report, and how it overlaps.
struct Finding {
  uint8_t overlap = 0;
  std::array<uint8_t, 2> edges_to_close{};  // inner edges of triangles over which the contact came
  float separation = std::numeric_limits<float>::infinity();
  std::array<uint64_t, 2> parts{};

  bool is_over_edge() const { return edges_to_close[0] != 0 || edges_to_close[1] != 0; }

  // Orders overlapping pairs before undecided ones before separate ones. Contacts that came over an
  // inner edge go last, since the neighbouring triangle has the correct normal.
  bool is_before(const Finding& other) const {
    const auto order = [](const Finding& f) {
      const int rank = f.overlap == 1 ? 0 : f.overlap == kUndecided ? 1 : 2;
      return std::tuple(rank, f.is_over_edge(), f.separation, f.parts);
    };
    return order(*this) < order(other);
  }
};

// The result of a pair of bodies so far: that of the deepest pair of parts.
struct Outcome : Finding {
  static constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

  uint8_t status = static_cast<uint8_t>(Status::ok);
  bool is_found = false;
  bool holds_nearest = false;  // the parts found hold the nearest ones
  std::array<float, 3> normal = {kNan, kNan, kNan};
  std::array<float, 3> arm_a = {kNan, kNan, kNan};
  std::array<float, 3> arm_b = {kNan, kNan, kNan};
  float bound = 0;
  double nearest = HUGE_VAL;  // a lower bound of the true separation

  bool is_invalid() const { return status == static_cast<uint8_t>(Status::invalid); }
};

inline Outcome no_answer() {
  Outcome outcome;
  outcome.status = static_cast<uint8_t>(Status::invalid);
  outcome.separation = outcome.bound = Outcome::kNan;
  return outcome;
}

}  // namespace carom

// Finds whether and when two moving bodies touch, by exact brute-force distances (oracle/) at one
// time after another. Uses nothing of time_of_impact().
#pragma once

#include <cstddef>
#include <limits>
#include <span>

#include "accuracy/tunnelling/moving_part.h"

namespace carom::accuracy {

inline constexpr double kNever = std::numeric_limits<double>::infinity();

enum class Meeting : uint8_t {
  none,     // the separation is never within a graze
  grazing,  // the least separation is within a graze, not deeper
  certain,  // they overlap by more than a graze
};

// A graze: a separation within this share of the pair's size, the bounding radius of its smaller
// part.
inline constexpr double kGrazeShare = 1e-6;

struct MeetingTime {
  Meeting meeting = Meeting::none;
  double until = kNever;  // the bodies are separate until then
  double by = kNever;     // and overlap by then by more than rounding
  double least = kNever;  // the least separation seen, metres
  double travel = 0;      // bound of the relative movement of points, metres
};

class MeetingSearch {
 public:
  // Looks at poses at `substeps` + 1 evenly spaced times. It skips times at which the bodies are
  // too far apart to meet before the next one. Between two times at which they may meet, it bisects
  // as finely as needed.
  explicit MeetingSearch(int substeps) : substeps_(substeps) {}

  // The first meeting of any parts of two bodies. A one-sided triangle meets only parts whose
  // middle is in front of it at first touch.
  MeetingTime operator()(const MovingBody& a, std::span<const MovingPart> parts_a,
                         const MovingBody& b, std::span<const MovingPart> parts_b);

  size_t poses() const { return poses_; }  // poses examined so far

 private:
  int substeps_;
  size_t poses_ = 0;
};

}  // namespace carom::accuracy

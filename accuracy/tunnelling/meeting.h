// Whether and when two moving bodies touch, from where they are at one time after the other: exact
// distances by brute force (oracle/), and nothing of time_of_impact().
#pragma once

#include <cstddef>
#include <limits>
#include <span>

#include "accuracy/tunnelling/moving_part.h"

namespace carom::accuracy {

inline constexpr double kNever = std::numeric_limits<double>::infinity();

enum class Meeting : uint8_t {
  none,     // never nearer than a graze
  grazing,  // neither deeper nor further apart than that, when they are nearest
  certain,  // deeper
};

// Grazing is to within this share of the size of a pair, the bounding radius of its smaller part.
inline constexpr double kGrazeShare = 1e-6;

struct MeetingTime {
  Meeting meeting = Meeting::none;
  double until = kNever;  // they are apart until then
  double by = kNever;     // and overlap by then, by more than rounding
  double least = kNever;  // the least separation that was seen, metres
  double travel = 0;      // the most that a point of one moves against the other, metres
};

class MeetingSearch {
 public:
  // Poses at `substeps` + 1 times, evenly apart. Times at which bodies are too far apart to meet
  // before the next one that is looked at are left out; where they may meet between two times, the
  // times in between are looked at as well, as closely as it takes.
  explicit MeetingSearch(int substeps) : substeps_(substeps) {}

  // The first of the meetings of the parts of two bodies. One-sided triangles are met by what first
  // touches them with its middle in front.
  MeetingTime operator()(const MovingBody& a, std::span<const MovingPart> parts_a,
                         const MovingBody& b, std::span<const MovingPart> parts_b);

  size_t poses() const { return poses_; }  // looked at so far

 private:
  int substeps_;
  size_t poses_ = 0;
};

}  // namespace carom::accuracy

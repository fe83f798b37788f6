// Pairs of cores whose gaps are found in lanes of doubles, and the answers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace carom {

// Lanes of doubles hold no hulls with more points than this.
inline constexpr size_t kMostPointsOfDoubles = 64;

struct CoreRows {
  static constexpr size_t kMost = 64;  // whole vectors of every width

  // The first column of each number: B - A in scaled units and world axes, both orientations, a
  // point inside of each core (metres, before it is turned), the radii in scaled units, and the
  // powers of two that scale metres to those units and back. Of round cores: three half axes of the
  // ellipsoid (metres, along the axes before they are turned), and the shares of both points.
  enum Column : size_t {
    kOffset = 0,
    kTurnA = 3,
    kTurnB = 7,
    kMiddleA = 11,
    kMiddleB = 14,
    kRadiusA = 17,
    kRadiusB = 18,
    kDown = 19,
    kUp = 20,
    kRoundnessA = 21,
    kRoundnessB = 26,
    kColumns = 31,
  };

  // Points of the cores, in metres before they are turned: records of four floats, one to
  // kMostPointsOfDoubles.
  struct Side {
    bool is_round = false;  // all rows are, or none is: an ellipsoid lies about each point
    std::array<const float*, kMost> points;
    std::array<uint32_t, kMost> count;
  };

  size_t count = 0;
  bool decides_only = false;      // no contacts, nor depths
  bool decides_separate = false;  // of separate round cores less than their distance will do
  alignas(64) std::array<std::array<double, kMost>, kColumns> column;
  Side a, b;

  // Separation, normal from A to B, arm_a and arm_b from the bodies' positions, in metres and world
  // axes, rounded once; the separation alone where the decision alone is wanted.
  static constexpr size_t kAnswers = 10;
  alignas(64) std::array<std::array<float, kMost>, kAnswers> answer;
  // Whether lanes found the answer, and if so, whether the decision is within rounding.
  std::array<bool, kMost> is_found, is_unsure;
};

// Finds the answers of up to kMost rows of valid bodies; on any thread. On every instruction set
// they have the bits of the scalar form, scalar::core_separation() of the gap that
// find_plain_gap() or find_plain_round_gap() finds. Lanes go no further than these, nor, for the
// contact location of cores that are not round, than the first round of scalar::meeting_point().
using FindCoreGaps = void (*)(CoreRows& rows);
FindCoreGaps find_core_gaps();

}  // namespace carom

// What moving bodies are about to meet.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "carom/results/contact.h"

namespace carom {

// Which impacts of a step are kept. What a body meets stops it, except for sensors and for what
// overlaps it now.
enum class Impacts : uint8_t {
  // Not those that come after both bodies were stopped by others, nor those with a sensor that come
  // after one of them was.
  earliest,
  all,  // of every pair, as if the others were not there
};

// Two bodies that meet within the interval ahead, or overlap now; 64 bytes. At least one of them is
// looked after continuously (Detection). Names and signs are those of Contact, for the bodies at
// the time of impact: arms are relative to where the bodies are then. Pairs with sensors, and all
// pairs at Detail::overlap, have no more than a time; the other numbers are zero.
struct Impact {
  uint32_t a = 0;  // body indices, a < b
  uint32_t b = 0;
  uint32_t sub_a = 0;  // the parts that meet first; 0 for simple shapes
  uint32_t sub_b = 0;
  float toi = 0;  // in [0, 1], a share of the interval; never late. 0: they touch now
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  Eigen::Vector3f arm_a = Eigen::Vector3f::Zero();
  Eigen::Vector3f arm_b = Eigen::Vector3f::Zero();
  float separation = 0;        // about zero, or how deep they overlap now
  Status status = Status::ok;  // as of time_of_impact(); of overlaps that of the contact
  bool sensor = false;         // one of the two is a sensor
  bool overlap = false;        // they overlap now: World::contacts() has them, too
  uint8_t reserved = 0;        // zero, so that impacts compare and hash as bytes
};
static_assert(sizeof(Impact) == 64);

}  // namespace carom

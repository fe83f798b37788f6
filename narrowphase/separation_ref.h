// What the reference tests of a pair of shapes yield.
#pragma once

#include <Eigen/Core>

#include "carom/kernel/contact.h"

namespace carom::reference {

// Names, frames and signs as in Contact.
struct Separation {
  float separation;
  Eigen::Vector3f normal;
  Eigen::Vector3f arm_a;
  Eigen::Vector3f arm_b;
  Status status = Status::ok;
};

// The same with A and B exchanged.
inline Separation flipped(const Separation& s) {
  return {s.separation, -s.normal, s.arm_b, s.arm_a, s.status};
}

}  // namespace carom::reference

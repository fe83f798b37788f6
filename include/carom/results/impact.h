/// @file
/// Impacts: where moving bodies will meet within the interval ahead.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "carom/results/contact.h"

namespace carom {

/// Which impacts of a step are kept. An impact stops both bodies, unless one of them is a sensor or
/// they overlap already.
enum class Impacts : uint8_t {
  /// Drops an impact that comes after both bodies were stopped by others, and an impact with a
  /// sensor that comes after one of the two was stopped.
  earliest,
  all,  ///< keeps those of every pair, as if the others were not there
};

/// Two bodies that meet within the interval ahead, or overlap now; 64 bytes. At least one of them
/// is looked after continuously (Detection). Names and signs are those of Contact, for the bodies
/// at the time of impact: arms are relative to the positions at that time. Pairs with sensors, and
/// all pairs at Detail::overlap, have only a time; their other numbers are zero.
struct Impact {
  uint32_t a = 0;      ///< body index of A, a < b
  uint32_t b = 0;      ///< body index of B
  uint32_t sub_a = 0;  ///< the part of A that meets first; 0 for simple shapes
  uint32_t sub_b = 0;  ///< the part of B that meets first; 0 for simple shapes
  float toi = 0;       ///< in [0, 1], a share of the interval; never late. 0: they touch now
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< unit, world frame, from A to B
  Eigen::Vector3f arm_a = Eigen::Vector3f::Zero();   ///< witness point of A
  Eigen::Vector3f arm_b = Eigen::Vector3f::Zero();   ///< witness point of B
  float separation = 0;        ///< metres; about zero, or minus the depth of an overlap now
  Status status = Status::ok;  ///< that of time_of_impact(), for an overlap that of the contact
  bool sensor = false;         ///< one of the two is a sensor
  bool overlap = false;        ///< they overlap now: World::contacts() has them, too
  uint8_t reserved = 0;        ///< zero, so that impacts compare and hash as bytes
};
static_assert(sizeof(Impact) == 64);

}  // namespace carom

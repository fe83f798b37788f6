// The velocities of bodies -> the normal velocities of contacts.
#pragma once

#include <Eigen/Core>
#include <span>

#include "carom/base/parallelism.h"
#include "carom/results/contact.h"
#include "world/store/body_store.h"

namespace carom {

// The bodies of a world, one entry each.
struct BodyVelocities {
  const Eigen::Vector3f* linear;
  const Eigen::Vector3f* angular;  // nullptr: nothing turns
  // nullptr: all kinds turn. Then there is no need to look at the kind of each body, which lies
  // anywhere.
  const ShapeKind* kinds;
};

// The velocities of a world's bodies at present.
class NormalVelocities {
 public:
  explicit NormalVelocities(BodyStore& bodies);

  // Sets the normal velocity of every contact: how fast the points at the arms part along the
  // normal. They are neighbours in the list of a step.
  void set(std::span<Contact> contacts) const;
  // The same, shared among threads.
  void set_all(std::span<Contact> contacts, Parallelism parallelism) const;

 private:
  BodyVelocities bodies_;
};

}  // namespace carom

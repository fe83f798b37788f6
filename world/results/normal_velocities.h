// The velocities of bodies -> the normal velocities of contacts.
#pragma once

#include <Eigen/Core>
#include <span>

#include "carom/base/parallelism.h"
#include "carom/results/contact.h"
#include "world/store/body_store.h"

namespace carom {

// The velocities of a world's bodies at present.
class NormalVelocities {
 public:
  explicit NormalVelocities(BodyStore& bodies);

  // Sets the normal velocity of every contact. They are neighbours in the list of a step.
  void set(std::span<Contact> contacts) const;
  // The same, shared among threads.
  void set_all(std::span<Contact> contacts, Parallelism parallelism) const;

 private:
  Eigen::Vector3f velocity(uint32_t body, const Eigen::Vector3f& arm) const;

  const BodyStore& bodies_;
  std::span<const Eigen::Vector3f> linear_;
  std::span<const Eigen::Vector3f> angular_;  // empty: nothing turns
  // Whether all kinds turn. Then there is no need to look at the kind of each body, which lies
  // anywhere.
  bool all_turn_;
};

}  // namespace carom

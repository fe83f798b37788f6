#include "world/results/normal_velocities.h"

#include <algorithm>

#include "base/parallel.h"
#include "shapes/point_velocity.h"
#include "world/pairs/pair_history.h"

namespace carom {

using Eigen::Vector3f;

NormalVelocities::NormalVelocities(BodyStore& bodies)
    : bodies_(bodies),
      linear_(bodies.linear_velocities()),
      all_turn_(!bodies.has_kind(ShapeKind::sphere) && !bodies.has_kind(ShapeKind::aabb)) {
  if (bodies.has_angular_velocities()) angular_ = bodies.angular_velocities();
}

Vector3f NormalVelocities::velocity(uint32_t body, const Vector3f& arm) const {
  const bool turns =
      !angular_.empty() && (all_turn_ || bodies_.turns(body)) && !angular_[body].isZero(0);
  return turns ? point_velocity(linear_[body], angular_[body], arm) : linear_[body];
}

void NormalVelocities::set(std::span<Contact> contacts) const {
  constexpr size_t kContactsBefore = 48;  // so many before a contact, its bodies are asked for
  for (size_t i = 0; i < contacts.size(); ++i) {
    // Second bodies lie anywhere, first ones in order; the contacts themselves are in the cache.
    const Contact& ahead = contacts[std::min(i + kContactsBefore, contacts.size() - 1)];
    __builtin_prefetch(&linear_[ahead.b]);
    if (!angular_.empty()) __builtin_prefetch(&angular_[ahead.b]);
    Contact& c = contacts[i];
    const Vector3f v = velocity(c.b, c.arm_b) - velocity(c.a, c.arm_a);
    c.normal_velocity = (v.x() * c.normal.x() + v.y() * c.normal.y()) + v.z() * c.normal.z();
  }
}

void NormalVelocities::set_all(std::span<Contact> contacts, Parallelism parallelism) const {
  for_each_block(
      contacts.size(), kPairsPerMergeBlock, unless_few(parallelism, contacts.size()),
      [&](size_t, size_t begin, size_t end) { set(contacts.subspan(begin, end - begin)); });
}

}  // namespace carom

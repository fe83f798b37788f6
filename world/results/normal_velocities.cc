#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "world/results/normal_velocities.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <algorithm>
#include <cstddef>

#include "base/parallel.h"
#include "simd/gather-inl.h"
#include "world/pairs/pair_history.h"
#include "world/results/normal_velocities.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

constexpr size_t kFetchedAhead = 48;  // contacts; their bodies are asked for so long before

static_assert(offsetof(Contact, a) == 0 && offsetof(Contact, b) == 4 &&
              sizeof(Eigen::Vector3f) == 3 * sizeof(float));

// One of the vectors of each contact.
struct OfContacts {
  const Contact* contacts;
  size_t offset;  // bytes

  HWY_INLINE const float* record(size_t i) const {
    return reinterpret_cast<const float*>(reinterpret_cast<const char*>(contacts + i) + offset);
  }
#if HWY_TARGET != HWY_SCALAR
  HWY_INLINE hn::Vec<Quad> quad(size_t i) const { return hn::LoadU(Quad(), record(i)); }
#endif
  HWY_INLINE float component(size_t i, size_t c) const { return record(i)[c]; }
};

bool can_turn(ShapeKind kind) { return kind != ShapeKind::sphere && kind != ShapeKind::aabb; }

// The vector of one of the two bodies of each contact; zero of a body whose kind does not turn, if
// `kinds` is not nullptr. Nothing may be read behind the last vector.
struct OfBodies {
  const Contact* contacts;
  uint32_t Contact::*body;
  const Eigen::Vector3f* vectors;
  const ShapeKind* kinds;

  HWY_INLINE const float* record(size_t i) const {
    static constexpr float kAtRest[3] = {};
    const uint32_t index = contacts[i].*body;
    return kinds && !can_turn(kinds[index]) ? kAtRest : vectors[index].data();
  }
#if HWY_TARGET != HWY_SCALAR
  HWY_INLINE hn::Vec<Quad> quad(size_t i) const {
    const hn::Half<Quad> half;
    const float* const xyz = record(i);
    return hn::Combine(Quad(), hn::Set(half, xyz[2]), hn::LoadU(half, xyz));
  }
#endif
  HWY_INLINE float component(size_t i, size_t c) const { return c < 3 ? record(i)[c] : 0; }
};

template <class Source>
HWY_INLINE F3 load(const Source& source) {
  F3 xyz;
  F unused;
  transpose_records(source, xyz, unused);
  return xyz;
}

HWY_INLINE F difference(F a, F b, F c, F d) { return hn::Sub(hn::Mul(a, b), hn::Mul(c, d)); }

// As point_velocity(); the linear velocity alone where nothing turns.
HWY_INLINE F3 velocity_at(const F3& linear, const F3& angular, const F3& arm) {
  const F zero = splat(0);
  // Not by Ne(), which is false for NaN on some instruction sets.
  const Mask rests =
      hn::And(hn::And(hn::Eq(angular.x, zero), hn::Eq(angular.y, zero)), hn::Eq(angular.z, zero));
  const F3 turned = {hn::Add(linear.x, difference(angular.y, arm.z, angular.z, arm.y)),
                     hn::Add(linear.y, difference(angular.z, arm.x, angular.x, arm.z)),
                     hn::Add(linear.z, difference(angular.x, arm.y, angular.y, arm.x))};
  return {hn::IfThenElse(rests, linear.x, turned.x), hn::IfThenElse(rests, linear.y, turned.y),
          hn::IfThenElse(rests, linear.z, turned.z)};
}

HWY_INLINE F3 load_velocity(const BodyVelocities& bodies, const Contact* contacts,
                            uint32_t Contact::*body, size_t offset_of_arm) {
  const F3 linear = load(OfBodies{contacts, body, bodies.linear, nullptr});
  if (!bodies.angular) return linear;
  return velocity_at(linear, load(OfBodies{contacts, body, bodies.angular, bodies.kinds}),
                     load(OfContacts{contacts, offset_of_arm}));
}

HWY_INLINE void set_lanes(const BodyVelocities& bodies, Contact* contacts) {
  const F3 of_a = load_velocity(bodies, contacts, &Contact::a, offsetof(Contact, arm_a));
  const F3 v = load_velocity(bodies, contacts, &Contact::b, offsetof(Contact, arm_b)) - of_a;
  const F3 n = load(OfContacts{contacts, offsetof(Contact, normal)});
  HWY_ALIGN float along[kLanes];
  hn::Store(hn::Add(hn::Add(hn::Mul(v.x, n.x), hn::Mul(v.y, n.y)), hn::Mul(v.z, n.z)), FloatTag(),
            along);
  for (size_t k = 0; k < kLanes; ++k) contacts[k].normal_velocity = along[k];
}

void set_velocities(const BodyVelocities& bodies, std::span<Contact> contacts) {
  // Second bodies lie anywhere, first ones in order; the contacts themselves are in the cache.
  const auto fetch = [&](size_t i) HWY_ATTR {
    const uint32_t body = contacts[std::min(i, contacts.size() - 1)].b;
    __builtin_prefetch(bodies.linear + body);
    if (bodies.angular) __builtin_prefetch(bodies.angular + body);
  };
  size_t i = 0;
  for (; i + kLanes <= contacts.size(); i += kLanes) {
    for (size_t k = 0; k < kLanes; ++k) fetch(i + k + kFetchedAhead);
    set_lanes(bodies, contacts.data() + i);
  }
  const std::span<Contact> rest = contacts.subspan(i);
  if (rest.empty()) return;
  Contact copies[kLanes] = {};
  std::copy(rest.begin(), rest.end(), copies);
  set_lanes(bodies, copies);
  std::copy_n(copies, rest.size(), rest.begin());
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(set_velocities);

bool all_turn(const BodyStore& bodies) {
  return !bodies.has_kind(ShapeKind::sphere) && !bodies.has_kind(ShapeKind::aabb);
}

}  // namespace

NormalVelocities::NormalVelocities(BodyStore& bodies)
    : bodies_{
          .linear = bodies.linear_velocities().data(),
          .angular = bodies.has_angular_velocities() ? bodies.angular_velocities().data() : nullptr,
          .kinds = all_turn(bodies) ? nullptr : bodies.kinds().data()} {}

void NormalVelocities::set(std::span<Contact> contacts) const {
  CAROM_DISPATCH(set_velocities)(bodies_, contacts);
}

void NormalVelocities::set_all(std::span<Contact> contacts, Parallelism parallelism) const {
  for_each_block(
      contacts.size(), kPairsPerMergeBlock, unless_few(parallelism, contacts.size()),
      [&](size_t, size_t begin, size_t end) { set(contacts.subspan(begin, end - begin)); });
}

}  // namespace carom
#endif  // HWY_ONCE

// One frame, from bodies to events.
#include "carom/reference/reference.h"
#include "kernel/float_environment.h"
#include "narrowphase/length_ref.h"
#include "reference/events.h"
#include "reference/pairs.h"

namespace carom::reference {
namespace {

// The bodies that take part, and their bounds.
struct Participants {
  std::vector<const Body*> bodies;
  std::vector<Box> boxes;
};

Participants participants(std::span<const Body> bodies, PositionType positions,
                          std::vector<BodyId>& quarantined) {
  Participants result;
  for (const Body& body : bodies) {
    if (is_valid(body.desc.shape, body.desc.position, positions)) {
      result.bodies.push_back(&body);
      result.boxes.push_back(bounds(body.desc.shape, body.desc.position, positions));
    } else {
      quarantined.push_back(body.id);
    }
  }
  return result;
}

float normal_velocity(const BodyDesc& a, const BodyDesc& b, const Vector3f& normal) {
  return dot(b.linear_velocity - a.linear_velocity, normal);
}

Contact contact_between(const Body& a, const Body& b, const PairResult& result, bool velocities) {
  Contact contact{};
  contact.a = a.id.index;
  contact.b = b.id.index;
  contact.normal = result.normal;
  contact.separation = result.separation;
  contact.arm_a = result.arm_a;
  contact.arm_b = result.arm_b;
  contact.status = result.status;
  if (velocities) contact.normal_velocity = normal_velocity(a.desc, b.desc, result.normal);
  return contact;
}

// Tests one pair and records what it yields.
void test_pair(const Body& a, const Body& b, PositionType positions, Detail detail, bool velocities,
               Frame& frame) {
  const PairResult result =
      collide(a.desc.shape, a.desc.position, b.desc.shape, b.desc.position, positions);
  frame.overlaps.push_back(result.overlap ? 1 : 0);
  if (!result.overlap) return;

  const bool sensor = a.desc.sensor || b.desc.sensor;
  Event touch{a.id, b.id, kNoContact, EventKind::begin, sensor};
  if (detail == Detail::contact && !sensor) {
    touch.contact = static_cast<uint32_t>(frame.contacts.size());
    frame.contacts.push_back(contact_between(a, b, result, velocities));
  }
  frame.touching.push_back(touch);
}

}  // namespace

Frame step(std::span<const Body> bodies, PositionType positions, Detail detail, bool velocities,
           const Frame* previous) {
  const FloatEnvironment environment;
  Frame frame;
  const Participants all = participants(bodies, positions, frame.quarantined);
  for (const Pair& rows : overlapping_pairs(all.boxes)) {
    const Body& a = *all.bodies[rows.a];
    const Body& b = *all.bodies[rows.b];
    if (!may_meet(a.desc, b.desc)) continue;
    frame.pairs.push_back({a.id.index, b.id.index});
    if (detail != Detail::pairs) test_pair(a, b, positions, detail, velocities, frame);
  }
  const std::vector<Event> none;
  frame.events = events(previous ? previous->touching : none, frame.touching);
  return frame;
}

}  // namespace carom::reference

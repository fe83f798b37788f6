// One frame, from bodies to events.
#include <algorithm>
#include <utility>
#include <variant>

#include "carom/reference/reference.h"
#include "kernel/float_environment.h"
#include "narrowphase/length_ref.h"
#include "reference/events.h"
#include "reference/pairs.h"

namespace carom::reference {
namespace {

Pose pose_of(const BodyDesc& desc) { return {desc.position, desc.orientation}; }

// The bodies that take part: those that have bounds, and half-spaces.
struct Participants {
  std::vector<const Body*> bodies;
  std::vector<Box> boxes;
  std::vector<const Body*> halfspaces;
  std::vector<Plane> planes;
};

Participants participants(std::span<const Body> bodies, PositionType positions,
                          std::vector<BodyId>& quarantined) {
  Participants result;
  for (const Body& body : bodies) {
    const Pose pose = pose_of(body.desc);
    if (!is_valid(body.desc.shape, pose, positions)) {
      quarantined.push_back(body.id);
    } else if (const auto* halfspace = std::get_if<Halfspace>(&body.desc.shape)) {
      result.halfspaces.push_back(&body);
      result.planes.push_back(world_plane(*halfspace, pose, positions));
    } else {
      result.bodies.push_back(&body);
      result.boxes.push_back(bounds(body.desc.shape, pose, positions));
    }
  }
  return result;
}

// Two bodies, the lower index first.
struct Candidate {
  const Body* a;
  const Body* b;
};

Candidate in_order(const Body* a, const Body* b) {
  return a->id.index < b->id.index ? Candidate{a, b} : Candidate{b, a};
}

// Bodies whose bounds overlap, and those that reach into half-spaces; sorted.
std::vector<Candidate> candidates(const Participants& all) {
  std::vector<Candidate> result;
  for (const Pair& rows : overlapping_pairs(all.boxes)) {
    result.push_back({all.bodies[rows.a], all.bodies[rows.b]});
  }
  if (all.halfspaces.empty()) return result;
  for (size_t h = 0; h < all.halfspaces.size(); ++h) {
    for (size_t i = 0; i < all.bodies.size(); ++i) {
      if (!may_reach(all.boxes[i], all.planes[h])) continue;
      result.push_back(in_order(all.halfspaces[h], all.bodies[i]));
    }
  }
  std::sort(result.begin(), result.end(), [](const Candidate& x, const Candidate& y) {
    return std::pair(x.a->id.index, x.b->id.index) < std::pair(y.a->id.index, y.b->id.index);
  });
  return result;
}

float normal_velocity(const BodyDesc& a, const BodyDesc& b, const Vector3f& normal) {
  return dot(b.linear_velocity - a.linear_velocity, normal);
}

Contact contact_between(const Body& a, const Body& b, const PairResult& result, bool velocities) {
  Contact contact{};
  contact.a = a.id.index;
  contact.b = b.id.index;
  contact.sub_a = result.sub_a;
  contact.sub_b = result.sub_b;
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
      collide(a.desc.shape, pose_of(a.desc), b.desc.shape, pose_of(b.desc), positions);
  frame.overlaps.push_back(result.overlap ? 1 : 0);
  if (!result.overlap) return;

  const bool sensor = a.desc.sensor || b.desc.sensor;
  Event touch{a.id, b.id, kNoContact, EventKind::begin, sensor};
  if (has_contacts(detail) && !sensor) {
    touch.contact = static_cast<uint32_t>(frame.contacts.size());
    frame.contacts.push_back(contact_between(a, b, result, velocities));
    if (detail == Detail::manifold) {
      frame.contacts.back().manifold_count = result.manifold_count;
      frame.manifolds.push_back(result.manifold);
    }
  }
  frame.touching.push_back(touch);
}

}  // namespace

Frame step(std::span<const Body> bodies, PositionType positions, Detail detail, bool velocities,
           const Frame* previous) {
  const FloatEnvironment environment;
  Frame frame;
  const Participants all = participants(bodies, positions, frame.quarantined);
  for (const auto& [a, b] : candidates(all)) {
    if (!may_meet(a->desc, b->desc)) continue;
    frame.pairs.push_back({a->id.index, b->id.index});
    if (detail != Detail::pairs) test_pair(*a, *b, positions, detail, velocities, frame);
  }
  const std::vector<Event> none;
  frame.events = events(previous ? previous->touching : none, frame.touching);
  return frame;
}

}  // namespace carom::reference

// One frame, from bodies to events.
#include <algorithm>
#include <utility>
#include <variant>

#include "base/float_environment.h"
#include "carom/reference/reference.h"
#include "narrowphase/scalar/length.h"
#include "reference/events.h"
#include "reference/impacts.h"
#include "reference/motion.h"
#include "reference/pairs.h"
#include "reference/scalar.h"

namespace carom::reference {
namespace {

// A body with bounds: the present ones, and those over the interval ahead.
struct Participant {
  const Body* body;
  BodyMotion motion;
  Box now;
  Box ahead;
};

struct HalfspaceParticipant {
  const Body* body;
  BodyMotion motion;
  Plane now;
  Plane ahead;
};

struct Participants {
  std::vector<Participant> bodies;
  std::vector<HalfspaceParticipant> halfspaces;
};

Participants participants(std::span<const Body> bodies, PositionType positions, const Ahead& ahead,
                          std::vector<BodyId>& quarantined) {
  Participants result;
  for (const Body& body : bodies) {
    const Pose pose = pose_of(body.desc);
    if (!is_valid(body.desc.shape, pose, positions)) {
      quarantined.push_back(body.id);
      continue;
    }
    const BodyMotion motion = motion_of(body.desc, ahead);
    if (const auto* halfspace = std::get_if<Halfspace>(&body.desc.shape)) {
      const Plane plane = world_plane(*halfspace, pose, positions);
      result.halfspaces.push_back({&body, motion, plane, plane_over(plane, motion.sweep)});
    } else {
      const Box box = bounds(body.desc.shape, pose, positions);
      result.bodies.push_back(
          {&body, motion, box, box_over(box, body.desc, motion.sweep, positions)});
    }
  }
  return result;
}

// Two bodies, the lower index first.
struct Candidate {
  const Body* a;
  const Body* b;
  const BodyMotion* motion_a;
  const BodyMotion* motion_b;
  bool meet_now;  // their present bounds overlap
};

// Two bodies, not in order.
Candidate in_order(const Body* x, const BodyMotion& of_x, const Body* y, const BodyMotion& of_y,
                   bool meet_now) {
  if (x->id.index < y->id.index) return {x, y, &of_x, &of_y, meet_now};
  return {y, x, &of_y, &of_x, meet_now};
}

// If one of the bodies looks ahead, overlapping bounds over the interval are enough.
bool is_candidate(const Candidate& pair) {
  return pair.meet_now || pair.motion_a->looks_ahead() || pair.motion_b->looks_ahead();
}

// Pairs of bodies with overlapping bounds, and of bodies and half-spaces that they reach into;
// sorted.
std::vector<Candidate> candidates(const Participants& all) {
  std::vector<Candidate> result;
  const auto add = [&](const Candidate& pair) {
    if (is_candidate(pair)) result.push_back(pair);
  };
  std::vector<Box> boxes;
  for (const Participant& p : all.bodies) boxes.push_back(p.ahead);
  for (const Pair& rows : overlapping_pairs(boxes)) {
    const Participant& a = all.bodies[rows.a];
    const Participant& b = all.bodies[rows.b];
    add({a.body, b.body, &a.motion, &b.motion, overlap(a.now, b.now)});
  }
  if (all.halfspaces.empty()) return result;
  for (const HalfspaceParticipant& h : all.halfspaces) {
    for (const Participant& p : all.bodies) {
      if (!may_reach(p.ahead, h.ahead)) continue;
      add(in_order(h.body, h.motion, p.body, p.motion, may_reach(p.now, h.now)));
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

// The settings of a frame, which all its pairs share.
struct Settings {
  PositionType positions;
  Detail detail;
  bool velocities;
  Ahead ahead;
};

void add_overlap(const Body& a, const Body& b, const PairResult& result, const Settings& settings,
                 Frame& frame) {
  const bool sensor = a.desc.sensor || b.desc.sensor;
  Event touch{a.id, b.id, kNoContact, EventKind::begin, sensor};
  if (has_contacts(settings.detail) && !sensor) {
    touch.contact = static_cast<uint32_t>(frame.contacts.size());
    frame.contacts.push_back(contact_between(a, b, result, settings.velocities));
    if (settings.detail == Detail::manifold) {
      frame.contacts.back().manifold_count = result.manifold_count;
      frame.manifolds.push_back(result.manifold);
    }
  }
  frame.touching.push_back(touch);
}

// Tests one pair and records what it yields. A pair whose present bounds are separate does not
// overlap, whatever its rounded test says.
void test_pair(const Candidate& pair, const Settings& settings, Frame& frame) {
  const Body& a = *pair.a;
  const Body& b = *pair.b;
  const PairResult result =
      collide(a.desc.shape, pose_of(a.desc), b.desc.shape, pose_of(b.desc), settings.positions);
  const bool overlap = result.overlap && pair.meet_now;
  frame.overlaps.push_back(overlap ? 1 : 0);
  if (overlap) add_overlap(a, b, result, settings, frame);
  if (!pair.motion_a->looks_ahead() && !pair.motion_b->looks_ahead()) return;
  look_ahead({a, b, *pair.motion_a, *pair.motion_b}, result, overlap, settings.positions,
             settings.detail, settings.ahead.dt, frame);
}

// Asks about one pair at a time.
bool keeps(const PairPredicate& predicate, Pair pair) {
  if (!predicate) return true;
  uint8_t keep = 1;
  predicate({&pair, 1}, {&keep, 1});
  return keep != 0;
}

bool passes(const Candidate& candidate, const Filters& filters) {
  const Pair pair = {candidate.a->id.index, candidate.b->id.index};
  return may_meet(candidate.a->desc, candidate.b->desc, filters.rule) &&
         !std::binary_search(filters.excluded.begin(), filters.excluded.end(), pair) &&
         keeps(filters.predicate, pair);
}

void add_impact_events(std::span<const Body> bodies, Frame& frame) {
  const auto id_of = [&](uint32_t index) {
    const auto body = std::lower_bound(
        bodies.begin(), bodies.end(), index,
        [](const Body& candidate, uint32_t wanted) { return candidate.id.index < wanted; });
    return body->id;
  };
  for (size_t i = 0; i < frame.impacts.size(); ++i) {
    const carom::Impact& impact = frame.impacts[i];
    frame.events.push_back({id_of(impact.a), id_of(impact.b), static_cast<uint32_t>(i),
                            EventKind::impact, impact.sensor});
  }
}

}  // namespace

Frame step(std::span<const Body> bodies, PositionType positions, Detail detail, bool velocities,
           const Frame* previous, const Ahead& ahead, const Filters& filters) {
  const FloatEnvironment environment;
  Frame frame;
  const Participants all = participants(bodies, positions, ahead, frame.quarantined);
  for (const Candidate& pair : candidates(all)) {
    if (!passes(pair, filters)) continue;
    frame.pairs.push_back({pair.a->id.index, pair.b->id.index});
    if (detail != Detail::pairs) {
      test_pair(pair, {positions, detail, velocities, ahead}, frame);
    }
  }
  settle(ahead.impacts, frame.impacts);
  const std::vector<Event> none;
  frame.events =
      events(previous ? previous->touching : none, frame.touching, bodies, frame.quarantined);
  add_impact_events(bodies, frame);
  return frame;
}

}  // namespace carom::reference

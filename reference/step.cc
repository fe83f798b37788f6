// One frame, from bodies to events.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "base/float_environment.h"
#include "base/grown.h"
#include "carom/reference/reference.h"
#include "narrowphase/scalar/length.h"
#include "reference/events.h"
#include "reference/impacts.h"
#include "reference/motion.h"
#include "reference/pairs.h"
#include "reference/scalar.h"
#include "shapes/point_velocity.h"

namespace carom::reference {
namespace {

// Bounds: the present ones, those over the interval ahead, and both grown by the body's contact
// distance.
template <class Bounds>
struct AllBounds {
  Bounds now, ahead, near, near_ahead;
};

struct Participant {
  const Body* body;
  BodyMotion motion;
  AllBounds<Box> bounds;
};

struct HalfspaceParticipant {
  const Body* body;
  BodyMotion motion;
  AllBounds<Plane> bounds;
};

float distance_of(const Body& body, const StepOptions& options) {
  if (!has_contacts(options.detail)) return 0;
  return std::fmax(options.contacts.contact_distance, body.desc.contact_distance);
}

float growth_of(const Body& body, const StepOptions& options) {
  const float own = distance_of(body, options);
  return own > 0 ? contact_growth(options.contacts.contact_distance, own) : 0;
}

Box grown(const Box& box, float growth) {
  if (growth == 0) return box;
  return {box.lower.unaryExpr([=](float x) { return below(x, growth); }),
          box.upper.unaryExpr([=](float x) { return above(x, growth); })};
}

Plane grown(Plane plane, float growth) {
  const Eigen::Vector3d n = plane.normal.cwiseAbs();
  const double more = double{growth} * ((n.x() + n.y()) + n.z());
  if (growth > 0) plane.limit = std::nextafter(plane.limit + more, HUGE_VAL);
  return plane;
}

struct Participants {
  std::vector<Participant> bodies;
  std::vector<HalfspaceParticipant> halfspaces;
};

Participants participants(std::span<const Body> bodies, const StepOptions& options,
                          std::vector<BodyId>& quarantined) {
  const PositionType positions = options.positions;
  Participants result;
  for (const Body& body : bodies) {
    const Pose pose = pose_of(body.desc);
    if (!is_valid(body.desc.shape, pose, positions)) {
      quarantined.push_back(body.id);
      continue;
    }
    const BodyMotion motion = motion_of(body.desc, options.ahead);
    const float growth = growth_of(body, options);
    if (const auto* halfspace = std::get_if<Halfspace>(&body.desc.shape)) {
      const Plane plane = world_plane(*halfspace, pose, positions);
      const Plane ahead = plane_over(plane, motion.sweep);
      result.halfspaces.push_back(
          {&body, motion, {plane, ahead, grown(plane, growth), grown(ahead, growth)}});
    } else {
      const Box box = bounds(body.desc.shape, pose, positions);
      const Box ahead = box_over(box, body.desc, motion.sweep, positions);
      result.bodies.push_back(
          {&body, motion, {box, ahead, grown(box, growth), grown(ahead, growth)}});
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
  bool meet_now;    // their present bounds overlap
  bool near_now;    // their grown present bounds overlap
  bool meet_ahead;  // their bounds over the interval overlap
};

// A half-space and a body, not in order.
Candidate in_order(const Body* x, const BodyMotion& of_x, const Body* y, const BodyMotion& of_y,
                   bool meet_now, bool near_now) {
  if (x->id.index < y->id.index) return {x, y, &of_x, &of_y, meet_now, near_now, true};
  return {y, x, &of_y, &of_x, meet_now, near_now, true};
}

// If one of the bodies looks ahead, overlapping bounds over the interval are enough.
bool is_candidate(const Candidate& pair) {
  return pair.near_now || pair.motion_a->looks_ahead() || pair.motion_b->looks_ahead();
}

// Pairs of bodies with overlapping bounds, and of bodies and half-spaces that they reach into;
// sorted.
std::vector<Candidate> candidates(const Participants& all) {
  std::vector<Candidate> result;
  const auto add = [&](const Candidate& pair) {
    if (is_candidate(pair)) result.push_back(pair);
  };
  std::vector<Box> boxes;
  for (const Participant& p : all.bodies) boxes.push_back(p.bounds.near_ahead);
  for (const Pair& rows : overlapping_pairs(boxes)) {
    const Participant& a = all.bodies[rows.a];
    const Participant& b = all.bodies[rows.b];
    add({a.body, b.body, &a.motion, &b.motion, overlap(a.bounds.now, b.bounds.now),
         overlap(a.bounds.near, b.bounds.near), overlap(a.bounds.ahead, b.bounds.ahead)});
  }
  if (all.halfspaces.empty()) return result;
  for (const HalfspaceParticipant& h : all.halfspaces) {
    for (const Participant& p : all.bodies) {
      if (!may_reach(p.bounds.near_ahead, h.bounds.near_ahead)) continue;
      add(in_order(h.body, h.motion, p.body, p.motion, may_reach(p.bounds.now, h.bounds.now),
                   may_reach(p.bounds.near, h.bounds.near)));
    }
  }
  std::sort(result.begin(), result.end(), [](const Candidate& x, const Candidate& y) {
    return std::pair(x.a->id.index, x.b->id.index) < std::pair(y.a->id.index, y.b->id.index);
  });
  return result;
}

Vector3f velocity_at(const BodyDesc& body, const Vector3f& arm) {
  const bool turns =
      !std::holds_alternative<Sphere>(body.shape) && !std::holds_alternative<Aabb>(body.shape);
  const Vector3f& w = body.angular_velocity;
  return turns && !w.isZero(0) ? point_velocity(body.linear_velocity, w, arm)
                               : body.linear_velocity;
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
  if (velocities) {
    const Vector3f v = velocity_at(b.desc, result.arm_b) - velocity_at(a.desc, result.arm_a);
    contact.normal_velocity = dot(v, result.normal);
  }
  return contact;
}

void add_contact(const Body& a, const Body& b, const PairResult& result, const StepOptions& options,
                 Frame& frame) {
  frame.contacts.push_back(contact_between(a, b, result, options.velocities));
  if (!has_manifolds(options.detail)) return;
  frame.contacts.back().manifold_count = result.manifold_count;
  frame.manifolds.push_back(result.manifold);
}

// Returns the index of the first one.
uint32_t add_contacts(const Body& a, const Body& b, const PairContacts& found,
                      const StepOptions& options, Frame& frame) {
  const auto first = static_cast<uint32_t>(frame.contacts.size());
  add_contact(a, b, found.first, options, frame);
  if (options.detail == Detail::regions) {
    frame.contacts.back().left_out = found.left_out;
    for (const PairResult& other : found.others) add_contact(a, b, other, options, frame);
  }
  return first;
}

void add_overlap(const Body& a, const Body& b, const PairContacts& found,
                 const StepOptions& options, Frame& frame) {
  const bool sensor = a.desc.sensor || b.desc.sensor;
  Event touch{a.id, b.id, kNoContact, EventKind::begin, sensor};
  if (has_contacts(options.detail) && !sensor) {
    touch.contact = add_contacts(a, b, found, options, frame);
  }
  frame.touching.push_back(touch);
}

// Tests one pair and records what it yields. A pair whose present bounds are separate does not
// overlap, whatever its rounded test says.
void test_pair(const Candidate& pair, const StepOptions& options, Frame& frame) {
  const Body& a = *pair.a;
  const Body& b = *pair.b;
  const float distance = std::fmax(distance_of(a, options), distance_of(b, options));
  const bool regions = options.detail == Detail::regions;
  PairContacts found =
      find_contacts(a.desc.shape, pose_of(a.desc), b.desc.shape, pose_of(b.desc), options.positions,
                    distance, regions ? options.contacts.region_limits : RegionLimits{});
  PairResult& result = found.first;
  const bool overlap = result.overlap && pair.meet_now;
  const bool sensor = a.desc.sensor || b.desc.sensor;
  const bool near = !overlap && distance > 0 && result.separation <= distance && pair.near_now;
  frame.overlaps.push_back(overlap ? 1 : 0);
  if (overlap) add_overlap(a, b, found, options, frame);
  if (near) result.separation = std::fmax(result.separation, std::numeric_limits<float>::min());
  if (near && !sensor) add_contacts(a, b, found, options, frame);
  const bool looks_ahead = pair.motion_a->looks_ahead() || pair.motion_b->looks_ahead();
  if (!looks_ahead || !pair.meet_ahead) return;
  look_ahead({a, b, *pair.motion_a, *pair.motion_b}, result, overlap, near, options.positions,
             options.detail, options.ahead.dt, frame);
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

Frame step(std::span<const Body> bodies, const StepOptions& options) {
  const FloatEnvironment environment;
  Frame frame;
  const Participants all = participants(bodies, options, frame.quarantined);
  for (const Candidate& pair : candidates(all)) {
    if (!passes(pair, options.filters)) continue;
    frame.pairs.push_back({pair.a->id.index, pair.b->id.index});
    if (options.detail != Detail::pairs) test_pair(pair, options, frame);
  }
  settle(options.ahead.impacts, frame.impacts);
  const std::vector<Event> none;
  frame.events = events(options.previous ? options.previous->touching : none, frame.touching,
                        bodies, frame.quarantined);
  add_impact_events(bodies, frame);
  return frame;
}

}  // namespace carom::reference

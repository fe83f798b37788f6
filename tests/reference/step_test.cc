// Pairs, filters, contacts and events of the reference against the simplest program that computes
// them.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstring>
#include <map>
#include <set>

#include "tests/support/families.h"

namespace carom::test {
namespace {

using reference::Body;
using reference::Frame;

// Bodies that are added, removed, moved, changed and made invalid from frame to frame.
class Crowd {
 public:
  Crowd(size_t count, uint64_t seed) : random_(seed) {
    for (uint32_t i = 0; i < count; ++i) bodies_.push_back(make({i, 0}));
  }

  const std::vector<Body>& bodies() const { return bodies_; }

  void next_frame() {
    for (Body& body : bodies_) {
      if (random_.chance(0.05)) body = make({body.id.index, body.id.generation + 1});
      if (random_.chance(0.05)) body.desc.sensor = !body.desc.sensor;
      if (random_.chance(0.5)) body.desc.position += random_.direction() * 0.3;
    }
    std::erase_if(bodies_, [&](const Body&) { return random_.chance(0.03); });
  }

 private:
  // Half of the bodies have sizes and positions in quarters, so that bounds and shapes touch
  // exactly.
  Body make(BodyId id) {
    Body body;
    body.id = id;
    const bool lattice = random_.chance(0.5);
    const auto number = [&](double low, double high) {
      const double x = random_.uniform(low, high);
      return lattice ? std::round(4 * x) / 4 : x;
    };
    const auto half = [&] { return static_cast<float>(number(0.1, 0.8)); };
    if (random_.chance(0.5)) {
      body.desc.shape = Sphere{half()};
    } else {
      body.desc.shape = Aabb::from_half_extents({half(), half(), half()});
    }
    for (int i = 0; i < 3; ++i) body.desc.position[i] = number(0, 5);
    body.desc.linear_velocity = random_.direction().cast<float>();
    body.desc.motion = static_cast<Motion>(random_.below(3));
    body.desc.layer = 1u << random_.below(3);
    body.desc.mask = static_cast<uint32_t>(1 + random_.below(7));
    body.desc.owner = static_cast<uint32_t>(random_.below(6));
    body.desc.sensor = random_.chance(0.2);
    if (random_.chance(0.3)) body.desc.group = static_cast<int32_t>(random_.below(5)) - 2;
    body.desc.space = random_.chance(0.1) ? 1 : 0;
    if (random_.chance(0.03)) body.desc.position.x() = std::nan("");
    return body;
  }

  std::vector<Body> bodies_;
  Random random_;
};

bool is_spoilt(const Body& body) { return std::isnan(body.desc.position.x()); }

// Exact in double for the sizes and positions of a Crowd, except for the rounding outwards.
bool boxes_overlap(const Body& a, const Body& b, PositionType positions) {
  const RoundedBox shape_a = rounded_box(a.desc.shape);
  const RoundedBox shape_b = rounded_box(b.desc.shape);
  const auto lower = [&](const Body& body, const RoundedBox& shape, int i) {
    const double exact = stored(body.desc.position, positions)[i] + shape.lower[i] - shape.radius;
    const float rounded = static_cast<float>(exact);
    return rounded > exact ? std::nextafter(rounded, -1e30f) : rounded;
  };
  const auto upper = [&](const Body& body, const RoundedBox& shape, int i) {
    const double exact = stored(body.desc.position, positions)[i] + shape.upper[i] + shape.radius;
    const float rounded = static_cast<float>(exact);
    return rounded < exact ? std::nextafter(rounded, 1e30f) : rounded;
  };
  for (int i = 0; i < 3; ++i) {
    if (lower(a, shape_a, i) > upper(b, shape_b, i)) return false;
    if (lower(b, shape_b, i) > upper(a, shape_a, i)) return false;
  }
  return true;
}

bool filter_passes(const BodyDesc& a, const BodyDesc& b, FilterRule rule = FilterRule::both) {
  if (a.motion == Motion::fixed && b.motion == Motion::fixed) return false;
  if (a.owner == b.owner && a.owner != 0) return false;
  if (a.space != b.space) return false;
  if (a.group == b.group && a.group != 0) return a.group > 0;
  if (rule == FilterRule::either) return (a.layer & b.mask) || (b.layer & a.mask);
  return (a.layer & b.mask) && (b.layer & a.mask);
}

std::vector<Pair> simple_pairs(const std::vector<Body>& bodies, PositionType positions) {
  std::vector<Pair> pairs;
  for (size_t i = 0; i < bodies.size(); ++i) {
    for (size_t j = i + 1; j < bodies.size(); ++j) {
      const Body& a = bodies[i];
      const Body& b = bodies[j];
      if (is_spoilt(a) || is_spoilt(b) || !filter_passes(a.desc, b.desc)) continue;
      if (boxes_overlap(a, b, positions)) pairs.push_back({a.id.index, b.id.index});
    }
  }
  return pairs;
}

// The overlapping pairs of ids, with whether a sensor is among the two.
using Touching = std::map<std::pair<BodyId, BodyId>, bool>;

Touching simple_touching(const std::vector<Body>& bodies, PositionType positions) {
  std::map<uint32_t, const Body*> by_index;
  for (const Body& body : bodies) by_index[body.id.index] = &body;
  Touching touching;
  for (const Pair& pair : simple_pairs(bodies, positions)) {
    const Body& a = *by_index[pair.a];
    const Body& b = *by_index[pair.b];
    const Eigen::Vector3d d =
        stored(b.desc.position, positions) - stored(a.desc.position, positions);
    if (textbook_separation(a.desc.shape, b.desc.shape, d) <= 0) {
      touching[{a.id, b.id}] = a.desc.sensor || b.desc.sensor;
    }
  }
  return touching;
}

using EventKey = std::tuple<BodyId, BodyId, EventKind, bool, int>;

// 1: removed, 4: quarantined.
int simple_fate(BodyId id, const std::vector<Body>& bodies) {
  for (const Body& body : bodies) {
    if (body.id == id) return is_spoilt(body) ? 4 : 0;
  }
  return 1;
}

std::set<EventKey> simple_events(const Touching& before, const Touching& now,
                                 const std::vector<Body>& bodies) {
  std::set<EventKey> events;
  for (const auto& [ids, sensor] : now) {
    const EventKind kind = before.contains(ids) ? EventKind::persist : EventKind::begin;
    events.insert({ids.first, ids.second, kind, sensor, 0});
  }
  for (const auto& [ids, sensor] : before) {
    if (now.contains(ids)) continue;
    const int gone = simple_fate(ids.first, bodies) + 2 * simple_fate(ids.second, bodies);
    events.insert({ids.first, ids.second, EventKind::end, sensor, gone});
  }
  return events;
}

// Sorted by indices; for equal indices the end of the old pair comes first.
void expect_sorted(const std::vector<Event>& events) {
  const auto key = [](const Event& e) {
    return std::tuple(e.a.index, e.b.index, e.kind != EventKind::end);
  };
  for (size_t i = 1; i < events.size(); ++i) EXPECT_LT(key(events[i - 1]), key(events[i]));
}

void expect_contacts(const Frame& frame, const std::vector<Body>& bodies, PositionType positions) {
  std::map<uint32_t, const Body*> by_index;
  for (const Body& body : bodies) by_index[body.id.index] = &body;
  size_t next = 0;
  for (size_t i = 0; i < frame.pairs.size(); ++i) {
    const Body& a = *by_index[frame.pairs[i].a];
    const Body& b = *by_index[frame.pairs[i].b];
    if (!frame.overlaps[i] || a.desc.sensor || b.desc.sensor) continue;
    ASSERT_LT(next, frame.contacts.size());
    const Contact& contact = frame.contacts[next++];
    const auto result = reference_result(
        {{a.desc.shape, a.desc.position}, {b.desc.shape, b.desc.position}}, positions);
    EXPECT_EQ(contact.a, frame.pairs[i].a);
    EXPECT_EQ(contact.b, frame.pairs[i].b);
    EXPECT_EQ(contact.separation, result.separation);
    EXPECT_EQ(contact.normal, result.normal);
    EXPECT_EQ(contact.arm_a, result.arm_a);
    EXPECT_EQ(contact.arm_b, result.arm_b);
    const double speed = (b.desc.linear_velocity - a.desc.linear_velocity)
                             .cast<double>()
                             .dot(result.normal.cast<double>());
    EXPECT_NEAR(contact.normal_velocity, speed, 1e-6);
  }
  EXPECT_EQ(next, frame.contacts.size());
}

void expect_event_contacts(const Frame& frame) {
  for (const Event& event : frame.events) {
    if (event.kind == EventKind::end || event.sensor) {
      EXPECT_EQ(event.contact, kNoContact);
    } else {
      ASSERT_LT(event.contact, frame.contacts.size());
      EXPECT_EQ(frame.contacts[event.contact].a, event.a.index);
      EXPECT_EQ(frame.contacts[event.contact].b, event.b.index);
    }
  }
}

void check_frame(const Frame& frame, const std::vector<Body>& bodies, PositionType positions,
                 const Touching& before, const Touching& now) {
  EXPECT_EQ(frame.pairs, simple_pairs(bodies, positions));
  ASSERT_EQ(frame.overlaps.size(), frame.pairs.size());
  expect_contacts(frame, bodies, positions);
  expect_event_contacts(frame);
  expect_sorted(frame.events);
  std::set<EventKey> events;
  for (const Event& e : frame.events) events.insert({e.a, e.b, e.kind, e.sensor, e.gone});
  EXPECT_EQ(events, simple_events(before, now, bodies));
  std::vector<BodyId> quarantined;
  for (const Body& body : bodies) {
    if (is_spoilt(body)) quarantined.push_back(body.id);
  }
  EXPECT_EQ(frame.quarantined, quarantined);
}

TEST(ReferenceStep, FramesOfACrowd) {
  for (const PositionType positions : kPositionTypes) {
    for (uint64_t seed = 1; seed <= 5; ++seed) {
      Crowd crowd(150, seed);
      Frame previous;
      Touching before;
      std::set<EventKind> kinds;
      for (int i = 0; i < 12; ++i) {
        const Frame frame = reference::step(
            crowd.bodies(), {.positions = positions, .previous = i ? &previous : nullptr});
        const Touching now = simple_touching(crowd.bodies(), positions);
        check_frame(frame, crowd.bodies(), positions, before, now);
        ASSERT_FALSE(HasFailure()) << "seed " << seed << ", frame " << i;
        for (const Event& event : frame.events) kinds.insert(event.kind);
        previous = frame;
        before = now;
        crowd.next_frame();
      }
      EXPECT_EQ(kinds.size(), 3u);
    }
  }
}

TEST(ReferenceStep, LesserDetails) {
  const Crowd crowd(150, 1);
  const auto run = [&](Detail detail) {
    return reference::step(crowd.bodies(), {.detail = detail});
  };
  const Frame contact = run(Detail::contact);
  const Frame overlap = run(Detail::overlap);
  const Frame pairs = run(Detail::pairs);
  EXPECT_EQ(overlap.pairs, contact.pairs);
  EXPECT_EQ(overlap.overlaps, contact.overlaps);
  EXPECT_TRUE(overlap.contacts.empty());
  EXPECT_EQ(overlap.events.size(), contact.events.size());
  for (const Event& event : overlap.events) EXPECT_EQ(event.contact, kNoContact);
  EXPECT_EQ(pairs.pairs, contact.pairs);
  EXPECT_TRUE(pairs.overlaps.empty());
  EXPECT_TRUE(contact.manifolds.empty());
  EXPECT_TRUE(pairs.events.empty());
}

// Boxes and half-spaces with sizes in quarters, turned by quarter turns: every height is exact.
class Quarters {
 public:
  explicit Quarters(uint64_t seed) : random_(seed) {}

  Body body(uint32_t index) {
    Body body{{index, index % 3}, {}};
    for (int i = 0; i < 3; ++i) body.desc.position[i] = quarter(-4, 4);
    body.desc.shape = Aabb::from_half_extents(Eigen::Vector3f::Constant(quarter(0, 2)));
    if (random_.chance(0.3)) {
      Halfspace halfspace{Eigen::Vector3f::Zero(), quarter(-3, 3)};
      halfspace.normal[static_cast<int>(random_.below(3))] = random_.chance(0.5) ? 2.0f : -0.5f;
      body.desc.shape = halfspace;
      const float turn = random_.chance(0.5) ? 1.0f : -2.0f;
      body.desc.orientation = Eigen::Quaternionf(turn, 0, 0, 0);
      if (random_.chance(0.7)) body.desc.orientation.coeffs()[random_.below(3)] = turn;
    }
    body.desc.motion = random_.chance(0.3) ? Motion::fixed : Motion::dynamic;
    body.desc.owner = static_cast<uint32_t>(random_.below(9));
    body.desc.sensor = random_.chance(0.1);
    return body;
  }

 private:
  float quarter(int low, int high) {
    return static_cast<float>(low) +
           0.25f * static_cast<float>(random_.below(4 * (high - low) + 1));
  }

  Random random_;
};

// The height of the body's lowest corner above the plane.
double height_above(const BodyDesc& body, const BodyDesc& plane) {
  const auto& halfspace = std::get<Halfspace>(plane.shape);
  const Eigen::Matrix3d rotation = plane.orientation.cast<double>().normalized().toRotationMatrix();
  const Eigen::Vector3d n = (rotation * halfspace.normal.cast<double>() * 4).array().round() / 4;
  const Eigen::Vector3d half = std::get<Aabb>(body.shape).upper.cast<double>();
  return n.dot(body.position - plane.position) - n.cwiseAbs().dot(half) - halfspace.offset;
}

TEST(ReferenceStep, HalfspacesMeetWhatReachesIntoThem) {
  for (const PositionType positions : kPositionTypes) {
    for (uint64_t seed = 1; seed <= 20; ++seed) {
      Quarters quarters(seed);
      std::vector<Body> bodies;
      for (uint32_t i = 0; i < 60; ++i) bodies.push_back(quarters.body(2 * i));
      const Frame frame = reference::step(bodies, {.positions = positions});
      std::vector<Pair> expected;
      for (const Body& a : bodies) {
        for (const Body& b : bodies) {
          if (a.id.index >= b.id.index || !filter_passes(a.desc, b.desc)) continue;
          const bool plane_a = std::holds_alternative<Halfspace>(a.desc.shape);
          const bool plane_b = std::holds_alternative<Halfspace>(b.desc.shape);
          if (plane_a && plane_b) continue;
          const bool meets = plane_a   ? height_above(b.desc, a.desc) <= 0
                             : plane_b ? height_above(a.desc, b.desc) <= 0
                                       : boxes_overlap(a, b, positions);
          if (meets) expected.push_back({a.id.index, b.id.index});
        }
      }
      EXPECT_EQ(frame.pairs, expected);
      EXPECT_GT(expected.size(), 200u);
      // Boxes along the axes fill their bounds, so every pair overlaps.
      EXPECT_EQ(frame.overlaps, std::vector<uint8_t>(expected.size(), 1));
    }
  }
}

TEST(ReferenceStep, HalfspacesThatMakeNoPlaneAreQuarantined) {
  std::vector<Body> bodies(5);
  for (uint32_t i = 0; i < bodies.size(); ++i) {
    bodies[i].id = {i, 0};
    bodies[i].desc.shape = Halfspace{};
  }
  bodies[0].desc.shape = Sphere{1};
  bodies[1].desc.shape = Halfspace{{0, 0, 0}, 1};
  bodies[2].desc.orientation.coeffs().setZero();
  bodies[3].desc.orientation.coeffs()[1] = std::nanf("");
  const Frame frame = reference::step(bodies);
  EXPECT_EQ(frame.quarantined, (std::vector<BodyId>{{1, 0}, {2, 0}, {3, 0}}));
  EXPECT_EQ(frame.pairs, (std::vector<Pair>{{0, 4}}));
}

TEST(ReferenceStep, ManifoldsAreThoseOfThePairs) {
  Random random(1);
  std::vector<Body> bodies;
  for (uint32_t i = 0; i < 120; ++i) {
    Body body{{i, 0}, {}};
    for (int k = 0; k < 3; ++k) body.desc.position[k] = random.uniform(0, 4);
    for (int k = 0; k < 4; ++k) {
      body.desc.orientation.coeffs()[k] = static_cast<float>(random.uniform(-1, 1));
    }
    body.desc.shape = Box{{0.5f, 0.25f, 0.75f}};
    if (i % 3 == 1) body.desc.shape = Sphere{0.5f};
    if (i == 50) body.desc.shape = Halfspace{{1, 2, 3}, 1};
    body.desc.sensor = random.chance(0.1);
    bodies.push_back(body);
  }
  const auto run = [&](Detail detail) {
    return reference::step(bodies, {.positions = PositionType::float64, .detail = detail});
  };
  const Frame contact = run(Detail::contact);
  const Frame manifold = run(Detail::manifold);
  EXPECT_TRUE(contact.manifolds.empty());
  ASSERT_EQ(manifold.contacts.size(), contact.contacts.size());
  ASSERT_EQ(manifold.manifolds.size(), contact.contacts.size());
  EXPECT_GT(contact.contacts.size(), 100u);
  EXPECT_EQ(manifold.events.size(), contact.events.size());
  size_t points = 0;
  for (size_t i = 0; i < contact.contacts.size(); ++i) {
    const Contact& c = manifold.contacts[i];
    const BodyDesc& a = bodies[c.a].desc;
    const BodyDesc& b = bodies[c.b].desc;
    const reference::PairResult result =
        reference::collide(a.shape, {a.position, a.orientation}, b.shape,
                           {b.position, b.orientation}, PositionType::float64);
    EXPECT_EQ(contact.contacts[i].manifold_count, 0);
    EXPECT_EQ(c.manifold_count, result.manifold_count);
    EXPECT_EQ(std::memcmp(&manifold.manifolds[i], &result.manifold, sizeof result.manifold), 0);
    points += c.manifold_count;
  }
  EXPECT_GT(points, contact.contacts.size() * 3 / 2);
}

TEST(ReferenceStep, WithoutVelocitiesNormalVelocityIsZero) {
  const Crowd crowd(150, 1);
  const Frame frame = reference::step(crowd.bodies(), {.velocities = false});
  ASSERT_FALSE(frame.contacts.empty());
  for (const Contact& contact : frame.contacts) EXPECT_EQ(contact.normal_velocity, 0);
}

TEST(ReferenceStep, NothingToDo) {
  const Frame empty = reference::step({});
  EXPECT_TRUE(empty.pairs.empty());
  EXPECT_TRUE(empty.events.empty());
}

TEST(ReferenceStep, ApproachingBodiesHaveNegativeNormalVelocity) {
  Body a{{3, 1}, {}};
  Body b{{7, 2}, {}};
  a.desc.shape = b.desc.shape = Sphere{1};
  b.desc.position.x() = 1.5;
  b.desc.linear_velocity = {-2, 5, 0};
  const Frame frame = reference::step({{a, b}});
  ASSERT_EQ(frame.contacts.size(), 1u);
  EXPECT_EQ(frame.contacts[0].normal_velocity, -2);
  EXPECT_EQ(frame.contacts[0].separation, -0.5f);
}

TEST(ReferenceFilter, ExcludedPairsAndThePredicate) {
  const Crowd crowd(150, 3);
  const auto pairs = [&](const reference::Filters& filters) {
    return reference::step(crowd.bodies(), {.detail = Detail::pairs, .filters = filters}).pairs;
  };
  const std::vector<Pair> all = pairs({});
  ASSERT_GT(all.size(), 20u);
  std::vector<Pair> excluded, left;
  for (size_t i = 0; i < all.size(); ++i) (i % 3 == 0 ? excluded : left).push_back(all[i]);
  EXPECT_EQ(pairs({.excluded = excluded}), left);
  const PairPredicate odd = [](std::span<const Pair> asked, std::span<uint8_t> keep) {
    for (size_t i = 0; i < asked.size(); ++i) keep[i] = asked[i].b % 2;
  };
  std::erase_if(left, [](Pair pair) { return pair.b % 2 == 0; });
  EXPECT_FALSE(left.empty());
  EXPECT_EQ(pairs({.excluded = excluded, .predicate = odd}), left);
  EXPECT_GT(pairs({.rule = FilterRule::either}).size(), all.size());
}

RC_GTEST_PROP(ReferenceFilter, IsSymmetric,
              (uint8_t layer_a, uint8_t mask_a, uint8_t layer_b, uint8_t mask_b, bool owned,
               bool fixed_a, bool fixed_b, bool apart)) {
  BodyDesc a;
  BodyDesc b;
  a.layer = layer_a;
  a.mask = mask_a;
  b.layer = layer_b;
  b.mask = mask_b;
  a.owner = b.owner = owned ? 5 : 0;
  if (fixed_a) a.motion = Motion::fixed;
  if (fixed_b) b.motion = Motion::fixed;
  a.group = *rc::gen::inRange(-1, 2);
  b.group = *rc::gen::inRange(-1, 2);
  b.space = apart ? 1 : 0;
  for (const FilterRule rule : {FilterRule::both, FilterRule::either}) {
    RC_ASSERT(reference::may_meet(a, b, rule) == reference::may_meet(b, a, rule));
    RC_ASSERT(reference::may_meet(a, b, rule) == filter_passes(a, b, rule));
  }
}

TEST(ReferenceOverlap, ClosedBoxes) {
  const reference::Box box{{0, 0, 0}, {1, 1, 1}};
  EXPECT_TRUE(reference::overlap(box, {{1, 1, 1}, {2, 2, 2}}));
  EXPECT_TRUE(reference::overlap({{1, 1, 1}, {2, 2, 2}}, box));
  EXPECT_TRUE(reference::overlap(box, {{0.5f, 0.5f, 0.5f}, {0.5f, 0.5f, 0.5f}}));
  for (int axis = 0; axis < 3; ++axis) {
    reference::Box other{{0, 0, 0}, {2, 2, 2}};
    other.lower[axis] = std::nextafter(1.0f, 2.0f);
    EXPECT_FALSE(reference::overlap(box, other));
    EXPECT_FALSE(reference::overlap(other, box));
  }
}

}  // namespace
}  // namespace carom::test

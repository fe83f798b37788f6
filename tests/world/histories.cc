#include "tests/world/histories.h"

namespace carom::test {

double History::uniform(double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random_);
}

BodyDesc History::random_body(double side, bool filters) {
  BodyDesc body;
  body.position = {uniform(0, side), uniform(0, side), uniform(0, side)};
  if (chance(0.85)) {
    body.shape = Sphere{static_cast<float>(uniform(0.1, 0.8))};
  } else {
    body.shape = Aabb{{-static_cast<float>(uniform(0.1, 0.8)), -0.5f, -0.3f},
                      {static_cast<float>(uniform(0.1, 0.8)), 0.25f, 0.5f}};
  }
  if (kinds_ == Kinds::all && chance(0.7)) make_oriented(body, filters);
  body.linear_velocity = Eigen::Vector3f::Random();
  if (looks_ahead_) set_in_motion(body, filters);
  if (keeps_distance_ && filters_.chance(0.4)) {
    body.contact_distance = static_cast<float>(filters_.uniform(0, 0.8));
  }
  if (!filters) return body;
  if (chance(0.3)) body.motion = Motion::fixed;
  if (chance(0.3)) body.layer = 1u << static_cast<int>(uniform(0, 3));
  if (chance(0.3)) body.mask = 5;
  if (chance(0.3)) body.owner = 1 + static_cast<uint32_t>(uniform(0, 4));
  body.sensor = chance(0.2);
  if (filters_.chance(0.2)) body.group = static_cast<int32_t>(filters_.below(5)) - 2;
  if (filters_.chance(0.1)) body.space = static_cast<uint32_t>(filters_.below(3));
  if (chance(0.02)) body.position.x() = NAN;
  return body;
}

void History::add(const BodyDesc& body) {
  const BodyId id = world_.add(body);
  ASSERT_FALSE(bodies_.contains(id.index));
  bodies_[id.index] = {id, body};
}

void History::remove_random() {
  if (bodies_.empty()) return;
  const BodyId id = pick()->second.id;
  EXPECT_TRUE(world_.remove(id));
  EXPECT_FALSE(world_.contains(id));
  EXPECT_FALSE(world_.remove(id));
  bodies_.erase(id.index);
  std::erase_if(excluded_,
                [&](const Pair& pair) { return pair.a == id.index || pair.b == id.index; });
}

void History::move(double share, double distance) {
  for (auto& [index, body] : bodies_) {
    if (!chance(share)) continue;
    body.desc.position += distance * Eigen::Vector3d::Random();
    if (chance(0.5)) {
      world_.set_position(body.id, body.desc.position);
    } else {
      write(index, body.desc.position);
    }
  }
}

void History::turn(double share) {
  for (auto& [index, body] : bodies_) {
    if (!has_rows(body.desc) || !chance(share)) continue;
    body.desc.orientation = chance(0.02) ? spoilt_orientation() : random_orientation(shapes_);
    if (chance(0.5)) {
      world_.set_orientation(body.id, body.desc.orientation);
    } else {
      std::memcpy(world_.arrays().orientation + 4 * index, body.desc.orientation.coeffs().data(),
                  4 * sizeof(float));
    }
  }
}

void History::write_rows(double share) {
  const ShapeRowArrays arrays = world_.shape_rows();
  for (auto& [index, body] : bodies_) {
    if (!has_rows(body.desc) || !chance(share)) continue;
    std::array<std::array<float, 4>, kMostRows> rows = shape_rows(body.desc.shape);
    const ShapeKind kind = kind_of(body.desc.shape);
    const size_t row = shapes_.below(row_count(kind));
    const size_t column = shapes_.below(4);
    const bool is_radius = kind == ShapeKind::capsule && row == 0;
    if (column == 3 && !is_radius && kind != ShapeKind::halfspace) continue;
    rows[row][column] = chance(0.02) ? NAN : static_cast<float>(uniform(0.05, 0.8));
    body.desc.shape = shape_from_rows(kind, rows.data());
    const uint32_t first = world_.first_row(body.id);
    ASSERT_LT(first + row, arrays.count);
    std::memcpy(arrays.rows + 4 * (first + row), rows[row].data(), sizeof rows[row]);
  }
}

void History::change_motions(double share) {
  for (auto& [index, body] : bodies_) {
    if (!chance(share)) continue;
    set_in_motion(body.desc, true);
    world_.set_detection(body.id, body.desc.detection);
    if (chance(0.5)) {
      world_.set_linear_velocity(body.id, body.desc.linear_velocity);
      world_.set_angular_velocity(body.id, body.desc.angular_velocity);
    } else {
      world_.linear_velocities()[index] = body.desc.linear_velocity;
      world_.angular_velocities()[index] = body.desc.angular_velocity;
    }
  }
}

void History::change_random_body(double side, bool filters) {
  if (bodies_.empty()) return;
  reference::Body& body = pick()->second;
  const BodyDesc other = random_body(side, filters);
  switch (static_cast<int>(uniform(0, 4))) {
    case 0:
      body.desc.shape = other.shape;
      world_.set_shape(body.id, other.shape);
      if (!has_rows(other)) body.desc.orientation.setIdentity();
      break;
    case 1:
      body.desc.motion = other.motion;
      world_.set_motion(body.id, other.motion);
      break;
    case 2:
      body.desc.layer = other.layer;
      body.desc.mask = other.mask;
      body.desc.owner = other.owner;
      body.desc.group = other.group;
      body.desc.space = other.space;
      world_.set_filter(body.id, other.layer, other.mask, other.owner);
      world_.set_group(body.id, other.group);
      world_.set_space(body.id, other.space);
      if (!keeps_distance_) break;
      body.desc.contact_distance = other.contact_distance;
      world_.set_contact_distance(body.id, other.contact_distance);
      break;
    default:
      body.desc.sensor = other.sensor;
      world_.set_sensor(body.id, other.sensor);
  }
}

void History::change_excluded() {
  if (bodies_.size() < 2) return;
  const auto random_body = [&] {
    return std::next(bodies_.begin(), static_cast<ptrdiff_t>(filters_.below(bodies_.size())))
        ->second.id;
  };
  for (size_t i = filters_.below(10); i > 0; --i) {
    BodyId a = random_body(), b = random_body();
    if (!frame_.pairs.empty() && filters_.chance(0.7)) {
      const Pair pair = frame_.pairs[filters_.below(frame_.pairs.size())];
      if (!bodies_.contains(pair.a) || !bodies_.contains(pair.b)) continue;
      a = bodies_[pair.a].id;
      b = bodies_[pair.b].id;
    }
    if (!excluded_.empty() && filters_.chance(0.3)) {
      const auto at = static_cast<ptrdiff_t>(filters_.below(excluded_.size()));
      const Pair pair = *std::next(excluded_.begin(), at);
      a = bodies_[pair.a].id;
      b = bodies_[pair.b].id;
    }
    if (a == b) continue;
    if (filters_.chance(0.5)) std::swap(a, b);
    const Pair pair = {std::min(a.index, b.index), std::max(a.index, b.index)};
    if (filters_.chance(excluded_.contains(pair) ? 0.2 : 0.9)) {
      world_.exclude(a, b);
      excluded_.insert(pair);
    } else {
      world_.include_again(a, b);
      excluded_.erase(pair);
    }
    EXPECT_EQ(world_.is_excluded(a, b), excluded_.contains(pair));
  }
}

void History::change_predicate() {
  const uint64_t odd = filters_.bits() | 1;
  predicate_ = [odd](std::span<const Pair> pairs, std::span<uint8_t> keep) {
    for (size_t i = 0; i < pairs.size(); ++i)
      keep[i] = (pair_key(pairs[i]) * odd) >> 32 >= 0x33333333u;
  };
  world_.set_pair_predicate(predicate_);
}

std::vector<Event> History::wanted_events(std::vector<Event> events) const {
  if (!world_.settings().events) return {};
  if (world_.settings().persist_events) return events;
  std::erase_if(events, [](const Event& event) { return event.kind == EventKind::persist; });
  return events;
}

void History::step_and_check() {
  const StepReport& report = world_.step();
  std::vector<reference::Body> list;
  for (const auto& [index, body] : bodies_) list.push_back(body);
  const std::vector<Pair> excluded(excluded_.begin(), excluded_.end());
  const WorldSettings& settings = world_.settings();
  reference::Frame frame =
      reference::step(list, {.positions = settings.positions,
                             .detail = settings.detail,
                             .previous = report.step == 1 ? nullptr : &frame_,
                             .ahead = {settings.dt, settings.fast_share, settings.impacts},
                             .filters = {settings.filter_rule, excluded, predicate_},
                             .contacts = {settings.contact_distance, settings.region_limits}});
  EXPECT_TRUE(same_bytes<Pair>(world_.pairs(), frame.pairs)) << "pairs";
  EXPECT_TRUE(same_bytes<uint8_t>(world_.overlaps(), frame.overlaps)) << "overlaps";
  EXPECT_TRUE(same_bytes<Contact>(world_.contacts(), frame.contacts)) << "contacts";
  EXPECT_TRUE(same_bytes<ManifoldPoints>(world_.manifolds(), frame.manifolds)) << "manifolds";
  EXPECT_TRUE(same_bytes<Impact>(world_.impacts(), frame.impacts)) << "impacts";
  EXPECT_TRUE(same_bytes<Contact>(world_.speculative_contacts(), frame.speculative));
  EXPECT_TRUE(same_bytes<Event>(world_.events(), wanted_events(frame.events))) << "events";
  EXPECT_TRUE(same_bytes<BodyId>(world_.quarantined(), frame.quarantined)) << "quarantined";
  EXPECT_EQ(report.bodies, bodies_.size());
  size_t left_out = 0;
  for (const Contact& contact : frame.contacts) left_out += contact.left_out;
  EXPECT_EQ(report.left_out, left_out);
  coverage.left_out += left_out;
  if (settings.detail != Detail::pairs) {
    EXPECT_EQ(report.tested + report.kept + report.dropped, report.pairs);
  }
  coverage.tested += report.tested;
  coverage.kept += report.kept;
  coverage.dropped += report.dropped;
  coverage.pairs += report.pairs;
  coverage.overlapping += report.overlaps;
  coverage.quarantined += report.quarantined;
  for (const Event& event : world_.events()) {
    ++coverage.events[static_cast<int>(event.kind)];
    coverage.sensors += event.sensor;
    coverage.gone += event.gone != 0;
  }
  coverage.excluded += excluded.size();
  cover_halfspaces();
  cover_ahead(report);
  for (const Contact& contact : world_.contacts()) {
    ++coverage.manifolds[contact.manifold_count];
    coverage.near += contact.separation > 0;
  }
  frame_ = std::move(frame);
}

Eigen::Quaternionf History::spoilt_orientation() {
  Eigen::Quaternionf q(0, 0, 0, 0);
  if (chance(0.5)) q.coeffs()[static_cast<int>(uniform(0, 4))] = chance(0.5) ? NAN : INFINITY;
  return q;
}

void History::make_oriented(BodyDesc& body, bool spoil) {
  body.shape = random_shape(kOrientedKinds[shapes_.below(std::size(kOrientedKinds))], shapes_);
  if (chance(0.03)) body.shape = random_shape(ShapeKind::halfspace, shapes_);
  body.orientation = random_orientation(shapes_);
  if (!spoil) return;
  if (chance(0.01)) body.orientation = spoilt_orientation();
  if (chance(0.01)) body.shape = Halfspace{{0, 0, 0}, 1};
  if (chance(0.01)) body.shape = Capsule{{0, 0, 1}, {0, NAN, 0}, 1};
  if (chance(0.01)) body.shape = Box{{1, -1, 1}};
}

void History::set_in_motion(BodyDesc& body, bool spoil) {
  constexpr Detection kDetections[] = {Detection::discrete, Detection::swept, Detection::continuous,
                                       Detection::automatic};
  body.detection = kDetections[shapes_.below(4)];
  body.linear_velocity = (shapes_.direction() * shapes_.uniform(0, 80)).cast<float>();
  body.angular_velocity = (shapes_.direction() * shapes_.uniform(0, 40)).cast<float>();
  if (shapes_.chance(0.3)) body.linear_velocity.setZero();
  if (shapes_.chance(0.5)) body.angular_velocity.setZero();
  if (!spoil || !shapes_.chance(0.02)) return;
  (shapes_.chance(0.5) ? body.linear_velocity : body.angular_velocity).y() =
      shapes_.chance(0.5) ? NAN : INFINITY;
}

void History::cover_ahead(const StepReport& report) {
  coverage.swept += report.swept;
  coverage.unswept += report.unswept;
  coverage.speculative += report.speculative;
  coverage.impacts += report.impacts;
  for (const Impact& impact : world_.impacts()) {
    coverage.overlaps_ahead += impact.overlap;
    coverage.impacts_of_sensors += impact.sensor;
  }
}

void History::cover_halfspaces() {
  const auto is_halfspace = [&](uint32_t index) {
    return kind_of(bodies_.at(index).desc.shape) == ShapeKind::halfspace;
  };
  for (size_t i = 0; i < world_.pairs().size(); ++i) {
    const Pair pair = world_.pairs()[i];
    if (!is_halfspace(pair.a) && !is_halfspace(pair.b)) continue;
    ++coverage.with_halfspaces;
    if (!world_.overlaps().empty()) coverage.halfspace_overlaps += world_.overlaps()[i];
  }
}

std::map<uint32_t, reference::Body>::iterator History::pick() {
  auto it = bodies_.begin();
  std::advance(it, static_cast<int>(uniform(0, static_cast<double>(bodies_.size()))));
  return it;
}

void History::write(uint32_t index, const Eigen::Vector3d& position) {
  const BodyArrays arrays = world_.arrays();
  for (int axis = 0; axis < 3; ++axis) {
    if (arrays.record64) {
      arrays.record64[4 * index + axis] = position[axis];
    } else {
      arrays.record32[4 * index + axis] = static_cast<float>(position[axis]);
    }
  }
}

}  // namespace carom::test

#include "carom/world/world.h"

#include <array>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/float_environment.h"
#include "carom/narrowphase/collide.h"
#include "world/world_state.h"

namespace carom {

const char* name(Stage stage) {
  static constexpr std::array<const char*, kStageCount> kNames = {
      "changes", "bounds",      "sweeps",  "margins", "broadphase", "pairs",
      "dops",    "narrowphase", "results", "impacts", "velocities", "events"};
  return kNames[static_cast<size_t>(stage)];
}

namespace {

void check_tolerance(std::optional<float> metres) {
  if (!metres || (std::isfinite(*metres) && *metres >= 0)) return;
  throw std::invalid_argument("the tolerance " + std::to_string(*metres) +
                              " is not a finite number of metres from 0 on");
}

void check_shape(const WorldSettings& settings, const Shape& shape) {
  if (settings.accuracy.tier != Tier::exact || is_decided_exactly(shape)) return;
  throw std::invalid_argument(std::string("the exact tier does not decide a ") +
                              name(kind_of(shape)));
}

const WorldSettings& checked(const WorldSettings& settings) {
  check_tolerance(settings.accuracy.tolerance);
  return settings;
}

}  // namespace

World::World(const WorldSettings& settings) : state_(std::make_unique<State>(checked(settings))) {
  assert(std::isfinite(settings.margin) && settings.margin >= 0);
  assert(std::isfinite(settings.dt) && settings.dt >= 0);
  assert(std::isfinite(settings.contact_distance) && settings.contact_distance >= 0);
}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

const WorldSettings& World::settings() const { return state_->settings; }

BodyId World::add(const BodyDesc& body) {
  check_tolerance(body.tolerance);
  check_shape(state_->settings, body.shape);
  const FloatEnvironment environment;
  return state_->bodies.add(body);
}

void World::add(std::span<const BodyDesc> bodies, std::vector<BodyId>& ids) {
  for (const BodyDesc& body : bodies) {
    check_tolerance(body.tolerance);
    check_shape(state_->settings, body.shape);
  }
  ids.reserve(ids.size() + bodies.size());
  for (const BodyDesc& body : bodies) ids.push_back(add(body));
}

bool World::remove(BodyId id) {
  if (!contains(id)) return false;
  state_->bodies.remove(id);
  state_->excluded.remove_body(id.index);
  return true;
}

size_t World::remove(std::span<const BodyId> ids) {
  size_t removed = 0;
  for (const BodyId id : ids) removed += remove(id);
  return removed;
}

bool World::contains(BodyId id) const { return state_->bodies.contains(id); }
size_t World::size() const { return state_->bodies.size(); }

bool World::is_alive(uint32_t index) const {
  return index < state_->bodies.rows() && state_->bodies.is_alive(index);
}

BodyId World::id_of(uint32_t index) const {
  assert(is_alive(index));
  return state_->bodies.id_of(index);
}

Eigen::Vector3d World::position(BodyId id) const {
  assert(contains(id));
  return state_->bodies.position(id.index);
}

void World::set_position(BodyId id, const Eigen::Vector3d& position) {
  const FloatEnvironment environment;
  assert(contains(id));
  state_->bodies.set_position(id.index, position);
}

void World::set_positions(std::span<const BodyId> ids, std::span<const Eigen::Vector3d> positions) {
  assert(ids.size() == positions.size());
  for (size_t i = 0; i < ids.size(); ++i) set_position(ids[i], positions[i]);
}

Orientation World::orientation(BodyId id) const {
  assert(contains(id));
  return state_->bodies.orientation(id.index);
}

void World::set_orientation(BodyId id, const Orientation& orientation) {
  assert(contains(id));
  state_->bodies.set_orientation(id.index, orientation);
}

Shape World::shape(BodyId id) const {
  assert(contains(id));
  return state_->bodies.shape(id.index);
}

void World::set_shape(BodyId id, const Shape& shape) {
  check_shape(state_->settings, shape);
  const FloatEnvironment environment;
  assert(contains(id));
  state_->bodies.set_shape(id.index, shape);
}

Eigen::Vector3f World::linear_velocity(BodyId id) const {
  assert(contains(id));
  return state_->bodies.linear_velocity(id.index);
}

void World::set_linear_velocity(BodyId id, const Eigen::Vector3f& velocity) {
  const FloatEnvironment environment;
  assert(contains(id));
  state_->bodies.set_linear_velocity(id.index, velocity);
}

Eigen::Vector3f World::angular_velocity(BodyId id) const {
  assert(contains(id));
  return state_->bodies.angular_velocity(id.index);
}

void World::set_angular_velocity(BodyId id, const Eigen::Vector3f& velocity) {
  assert(contains(id));
  state_->bodies.set_angular_velocity(id.index, velocity);
}

Detection World::detection(BodyId id) const {
  assert(contains(id));
  return state_->bodies.detection(id.index);
}

void World::set_detection(BodyId id, Detection detection) {
  assert(contains(id));
  state_->bodies.set_detection(id.index, detection);
}

Motion World::motion(BodyId id) const {
  assert(contains(id));
  return state_->bodies.motion(id.index);
}

void World::set_motion(BodyId id, Motion motion) {
  assert(contains(id));
  state_->bodies.set_motion(id.index, motion);
}

void World::set_filter(BodyId id, uint32_t layer, uint32_t mask, uint32_t owner) {
  assert(contains(id));
  state_->bodies.set_filter(id.index, layer, mask, owner);
}

void World::set_group(BodyId id, int32_t group) {
  assert(contains(id));
  state_->bodies.set_group(id.index, group);
}

void World::set_space(BodyId id, uint32_t space) {
  assert(contains(id));
  state_->bodies.set_space(id.index, space);
}

void World::set_sensor(BodyId id, bool sensor) {
  assert(contains(id));
  state_->bodies.set_sensor(id.index, sensor);
}

float World::contact_distance(BodyId id) const {
  assert(contains(id));
  return state_->bodies.contact_distance(id.index);
}

std::optional<float> World::tolerance(BodyId id) const {
  assert(contains(id));
  return state_->bodies.tolerance(id.index);
}

void World::set_tolerance(BodyId id, std::optional<float> tolerance) {
  assert(contains(id));
  check_tolerance(tolerance);
  state_->bodies.set_tolerance(id.index, tolerance);
}

void World::set_contact_distance(BodyId id, float distance) {
  assert(contains(id));
  assert(distance >= 0 && std::isfinite(distance));
  state_->bodies.set_contact_distance(id.index, distance);
}

bool World::is_sensor(BodyId id) const {
  assert(contains(id));
  return state_->bodies.is_sensor(id.index);
}

uint64_t World::user(BodyId id) const {
  assert(contains(id));
  return state_->bodies.user(id.index);
}

void World::set_user(BodyId id, uint64_t user) {
  assert(contains(id));
  state_->bodies.set_user(id.index, user);
}

BodyArrays World::arrays() {
  BodyStore& bodies = state_->bodies;
  bodies.share_poses();
  BodyArrays arrays{.count = bodies.rows()};
  if (settings().positions == PositionType::float64) {
    arrays.record64 = bodies.records64().data();
  } else {
    arrays.record32 = bodies.records32().data();
  }
  if (!bodies.orientations().empty()) arrays.orientation = bodies.orientations().front().data();
  return arrays;
}

BoxArrays World::boxes() {
  state_->bodies.share_boxes();
  LargeVector<BodyStore::BoxRecord>& boxes = state_->bodies.boxes();
  return {boxes.size(), boxes.empty() ? nullptr : boxes.front().lower.data()};
}

uint32_t World::box_slot(BodyId id) const {
  assert(contains(id) && std::holds_alternative<Aabb>(shape(id)));
  return state_->bodies.box_slot(id.index);
}

ShapeRowArrays World::shape_rows() {
  state_->bodies.share_shape_rows();
  const std::span<BodyStore::Row> rows = state_->bodies.shape_rows();
  return {.count = rows.size(), .rows = rows.empty() ? nullptr : rows.front().data()};
}

uint32_t World::first_row(BodyId id) const {
  assert(contains(id) && row_count(kind_of(shape(id))) > 0);
  return state_->bodies.first_row(id.index);
}

std::span<Eigen::Vector3f> World::linear_velocities() { return state_->bodies.linear_velocities(); }

std::span<Eigen::Vector3f> World::angular_velocities() {
  return state_->bodies.angular_velocities();
}

void World::exclude(BodyId a, BodyId b) {
  assert(contains(a) && contains(b));
  state_->excluded.exclude({a.index, b.index});
}

void World::exclude(std::span<const Pair> pairs) {
  for (const Pair pair : pairs) exclude(id_of(pair.a), id_of(pair.b));
}

void World::include_again(BodyId a, BodyId b) {
  assert(contains(a) && contains(b));
  state_->excluded.include_again({a.index, b.index});
}

void World::include_again(std::span<const Pair> pairs) {
  for (const Pair pair : pairs) include_again(id_of(pair.a), id_of(pair.b));
}

bool World::is_excluded(BodyId a, BodyId b) const {
  assert(contains(a) && contains(b));
  return state_->excluded.contains({a.index, b.index});
}

void World::set_pair_predicate(PairPredicate predicate) {
  state_->predicate = std::move(predicate);
  state_->predicate_changed = true;
}

void World::set_dt(double dt) {
  assert(std::isfinite(dt) && dt >= 0);
  state_->settings.dt = dt;
}

const StepReport& World::step() {
  if (state_->is_broken) state_ = State::without_results(*state_);
  try {
    return state_->step();
  } catch (...) {
    state_->is_broken = true;
    state_ = State::without_results(*state_);
    throw;
  }
}

std::span<const Pair> World::pairs() const { return state_->now.pairs; }
std::span<const uint8_t> World::overlaps() const { return state_->now.overlaps; }
std::span<const Contact> World::contacts() const { return state_->now.contacts; }
std::span<const ContactIdentity> World::identities() const { return state_->now.identities; }
std::span<const ManifoldPoints> World::manifolds() const { return state_->now.manifolds; }
std::span<const Event> World::events() const { return state_->events; }
std::span<const Impact> World::impacts() const { return state_->impacts.impacts(); }
std::span<const Contact> World::speculative_contacts() const {
  return state_->speculative.contacts();
}

// Since the step another body may have taken the index.
const Impact* World::first_impact(BodyId id) const {
  assert(contains(id));
  const bool is_new = (state_->bodies.touched(id.index) & BodyStore::kReplaced) != 0;
  return is_new ? nullptr : state_->impacts.first_of(id.index);
}

std::span<const BodyId> World::quarantined() const { return state_->bounds.quarantined(); }
const StepReport& World::report() const { return state_->report; }

std::span<const Pair> World::added_pairs() const { return state_->pair_changes.added; }
std::span<const Pair> World::removed_pairs() const { return state_->pair_changes.removed; }

WorldMemory World::memory() const { return state_->memory(); }
void World::give_back_memory() { state_->give_back_memory(); }

}  // namespace carom

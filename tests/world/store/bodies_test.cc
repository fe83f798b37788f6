// Bodies of a world: ids, properties, batches, arrays.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "carom/world/world.h"
#include "tests/support/float_modes.h"
#include "tests/support/pairs.h"

namespace carom::test {
namespace {

BodyDesc ball(double x, float radius = 0.5f) {
  return {.shape = Sphere{radius}, .position = {x, 0, 0}};
}

BodyDesc crate(double x, float half = 0.5f) {
  return {.shape = Aabb::from_half_extents({half, half, half}), .position = {x, 0, 0}};
}

WorldSettings settings_with(PositionType positions) {
  WorldSettings settings;
  settings.positions = positions;
  return settings;
}

TEST(Bodies, IndicesAreHandedOutFromZeroAndTheLowestFreeOneFirst) {
  World world;
  std::vector<BodyId> ids;
  for (uint32_t i = 0; i < 10; ++i) {
    ids.push_back(world.add(ball(i)));
    EXPECT_EQ(ids[i], (BodyId{i, 0}));
  }
  for (const uint32_t i : {7, 2, 5}) EXPECT_TRUE(world.remove(ids[i]));
  for (const uint32_t i : {2u, 5u, 7u, 10u}) EXPECT_EQ(world.add(ball(0)).index, i);
  EXPECT_EQ(world.size(), 11u);
}

TEST(Bodies, OldIdsNeverNameNewBodies) {
  World world;
  std::set<BodyId> seen;
  BodyId id = world.add(ball(0));
  for (int i = 0; i < 20; ++i) {
    EXPECT_TRUE(seen.insert(id).second);
    if (i % 3 == 0) world.step();
    EXPECT_TRUE(world.remove(id));
    EXPECT_FALSE(world.remove(id));
    const BodyId next = world.add(ball(0));
    EXPECT_EQ(next.index, id.index);
    EXPECT_FALSE(world.contains(id));
    EXPECT_TRUE(world.contains(next));
    EXPECT_EQ(world.id_of(next.index), next);
    id = next;
  }
  EXPECT_FALSE(world.contains({}));
  EXPECT_FALSE(world.contains({99, 0}));
}

TEST(Bodies, ComeAndGoInBatches) {
  World world;
  std::vector<BodyId> ids = {world.add(ball(-100))};
  const std::vector<BodyDesc> batch = {ball(0), crate(5), ball(10)};
  world.add(batch, ids);
  ASSERT_EQ(ids.size(), 4u);
  EXPECT_EQ(ids[3], (BodyId{3, 0}));
  EXPECT_EQ(world.position(ids[2]).x(), 5);

  std::vector<BodyId> twice = {ids[1], ids[3], ids[1], BodyId{77, 0}};
  EXPECT_EQ(world.remove(twice), 2u);
  EXPECT_EQ(world.size(), 2u);
  EXPECT_EQ(world.remove(twice), 0u);
  world.add(std::span<const BodyDesc>(), ids);
  EXPECT_EQ(ids.size(), 4u);
}

TEST(Bodies, KeepWhatTheyAreGiven) {
  for (const PositionType positions : kPositionTypes) {
    World world(settings_with(positions));
    BodyDesc desc = crate(1, 2);
    desc.position = {0.1, 1e9 + 0.25, -3};
    desc.linear_velocity = {1, 2, 3};
    desc.motion = Motion::kinematic;
    desc.sensor = true;
    desc.user = 0x123456789abcdefull;
    const BodyId plain = world.add(ball(0));
    const BodyId id = world.add(desc);
    EXPECT_EQ(world.position(id), stored(desc.position, positions));
    EXPECT_EQ(std::get<Aabb>(world.shape(id)).upper, Eigen::Vector3f(2, 2, 2));
    EXPECT_EQ(world.linear_velocity(id), desc.linear_velocity);
    EXPECT_EQ(world.motion(id), Motion::kinematic);
    EXPECT_TRUE(world.is_sensor(id));
    EXPECT_EQ(world.user(id), desc.user);

    EXPECT_EQ(world.linear_velocity(plain), Eigen::Vector3f::Zero());
    EXPECT_EQ(world.motion(plain), Motion::dynamic);
    EXPECT_FALSE(world.is_sensor(plain));
    EXPECT_EQ(world.user(plain), 0u);

    // A new body at the same index starts with the defaults.
    world.remove(id);
    const BodyId next = world.add(ball(0, 3));
    ASSERT_EQ(next.index, id.index);
    EXPECT_EQ(std::get<Sphere>(world.shape(next)).radius, 3);
    EXPECT_EQ(world.linear_velocity(next), Eigen::Vector3f::Zero());
    EXPECT_EQ(world.motion(next), Motion::dynamic);
    EXPECT_FALSE(world.is_sensor(next));
    EXPECT_EQ(world.user(next), 0u);
  }
}

// The caller's flush-to-zero or rounding mode must not change numbers as they are stored.
TEST(Bodies, AreStoredTheSameInAnyFloatMode) {
  const BodyDesc desc = {.position = {1e-40, 0.1, -0.1}, .linear_velocity = {1e-40f, 0, 0}};
  const Eigen::Vector3d expected = stored(desc.position, PositionType::float32);
  for (const FloatMode& mode : float_modes()) {
    SCOPED_TRACE(mode.name);
    World world;
    BodyId added, moved;
    {
      const ScopedFloatMode scoped(mode);
      added = world.add(desc);
      moved = world.add({});
      world.set_position(moved, desc.position);
    }
    EXPECT_TRUE(world.position(added) == expected);
    EXPECT_TRUE(world.position(moved) == expected);
    EXPECT_TRUE(world.linear_velocity(added) == desc.linear_velocity);
  }
}

TEST(Bodies, PropertiesCanBeChanged) {
  World world;
  const BodyId a = world.add(ball(0));
  const BodyId b = world.add(ball(0.5));
  const auto pairs = [&] {
    world.step();
    return world.pairs().size();
  };
  EXPECT_EQ(pairs(), 1u);
  world.set_filter(a, 1, 2, 0);
  EXPECT_EQ(pairs(), 1u) << "b is in all layers and meets all";
  world.set_filter(b, 1, 1, 0);
  EXPECT_EQ(pairs(), 0u);
  world.set_filter(b, 2, 1, 0);
  EXPECT_EQ(pairs(), 1u);
  world.set_filter(a, 1, 2, 9);
  world.set_filter(b, 2, 1, 9);
  EXPECT_EQ(pairs(), 0u);
  world.set_filter(b, 2, 1, 8);
  EXPECT_EQ(pairs(), 1u);
  world.set_motion(a, Motion::fixed);
  EXPECT_EQ(pairs(), 1u);
  world.set_motion(b, Motion::fixed);
  EXPECT_EQ(pairs(), 0u);
  world.set_motion(b, Motion::kinematic);
  EXPECT_EQ(pairs(), 1u);
  world.set_sensor(b, true);
  EXPECT_EQ(pairs(), 1u);
  EXPECT_EQ(world.contacts().size(), 0u);
  EXPECT_EQ(world.report().overlaps, 1u);
  world.set_sensor(b, false);
  EXPECT_EQ(pairs(), 1u);
  EXPECT_EQ(world.contacts().size(), 1u);
  world.set_user(a, 7);
  EXPECT_EQ(world.user(a), 7u);
}

TEST(Bodies, AreMovedInBatchesAndThroughTheArrays) {
  for (const PositionType positions : kPositionTypes) {
    World world(settings_with(positions));
    std::vector<BodyId> ids;
    for (int i = 0; i < 4; ++i) ids.push_back(world.add(ball(10 * i)));
    world.step();
    EXPECT_EQ(world.contacts().size(), 0u);

    const std::vector<Eigen::Vector3d> near = {{0, 0, 0}, {0.75, 0, 0}};
    world.set_positions(std::span(ids).first(2), near);
    world.step();
    ASSERT_EQ(world.contacts().size(), 1u);
    EXPECT_EQ(world.contacts()[0].separation, -0.25f);

    const BodyArrays arrays = world.arrays();
    EXPECT_EQ(arrays.count, 4u);
    EXPECT_EQ(arrays.record32 != nullptr, positions == PositionType::float32);
    EXPECT_EQ(arrays.record64 != nullptr, positions == PositionType::float64);
    const auto set = [&](size_t i, double x) {
      if (arrays.record32) arrays.record32[i] = static_cast<float>(x);
      if (arrays.record64) arrays.record64[i] = x;
    };
    set(4 * 2, 1.5);       // body 2 moves next to body 1
    set(4 * 0 + 3, 0.25);  // the radius of body 0
    world.step();
    ASSERT_EQ(world.contacts().size(), 2u);
    EXPECT_EQ(world.contacts()[0].separation, 0.0f);
    EXPECT_EQ(world.contacts()[1].b, 2u);
    EXPECT_EQ(world.position(ids[2]).x(), 1.5);
    EXPECT_EQ(std::get<Sphere>(world.shape(ids[0])).radius, 0.25f);
  }
}

TEST(Bodies, BoxesAreChangedThroughTheArrays) {
  World world;
  world.add(ball(-50));
  const BodyId a = world.add(crate(0));
  const BodyId b = world.add(crate(2));
  world.step();
  EXPECT_EQ(world.contacts().size(), 0u);
  const BoxArrays boxes = world.boxes();
  EXPECT_EQ(boxes.count, 2u);
  boxes.upper(world.box_slot(a))[0] = 1.75f;
  world.step();
  ASSERT_EQ(world.contacts().size(), 1u);
  EXPECT_EQ(world.contacts()[0].separation, -0.25f);
  EXPECT_EQ(std::get<Aabb>(world.shape(a)).upper.x(), 1.75f);
  boxes.lower(world.box_slot(b))[0] = 0.5f;
  world.step();
  EXPECT_EQ(world.contacts().size(), 0u);
}

TEST(Bodies, RowsWithoutABodyAreIgnored) {
  World world;
  std::vector<BodyId> ids;
  for (int i = 0; i < 5; ++i) ids.push_back(world.add(i % 2 ? crate(10 * i) : ball(10 * i)));
  world.step();
  for (const int i : {0, 1, 3}) world.remove(ids[i]);
  for (const float value : {0.0f, 30.0f, std::numeric_limits<float>::quiet_NaN(), -1.0f}) {
    for (const int i : {0, 1, 3}) {
      std::fill_n(world.arrays().record32 + 4 * i, 4, value);
      world.step();
      EXPECT_EQ(world.pairs().size(), 0u);
      EXPECT_EQ(world.quarantined().size(), 0u);
      EXPECT_EQ(world.report().bodies, 2u);
    }
  }
}

TEST(Bodies, ChangeTheKindOfTheirShape) {
  for (const PositionType positions : kPositionTypes) {
    World world(settings_with(positions));
    const BodyId a = world.add(ball(0, 1));
    const BodyId b = world.add(ball(1.5, 1));
    const BodyId c = world.add(crate(50));
    const auto separation = [&] {
      world.step();
      return world.contacts().size() == 1 ? world.contacts()[0].separation : NAN;
    };
    EXPECT_EQ(separation(), -0.5f);
    world.set_shape(a, Aabb::from_half_extents({1, 1, 1}));
    EXPECT_EQ(separation(), -0.5f);
    world.set_shape(b, Aabb::from_half_extents({1, 2, 2}));
    EXPECT_EQ(separation(), -0.5f);
    world.set_shape(b, Sphere{0.75f});
    EXPECT_EQ(separation(), -0.25f);
    world.set_shape(a, Sphere{1});
    EXPECT_EQ(separation(), -0.25f);
    // The slot is used again, so there is still one box.
    EXPECT_EQ(world.boxes().count, 1u);
    world.set_shape(b, Aabb::from_half_extents({3, 3, 3}));
    EXPECT_EQ(world.boxes().count, 2u);
    world.set_shape(b, Aabb::from_half_extents({4, 4, 4}));
    EXPECT_EQ(world.boxes().count, 2u);
    EXPECT_EQ(std::get<Aabb>(world.shape(c)).upper.x(), 0.5f);
    EXPECT_NE(world.box_slot(b), world.box_slot(c));
  }
}

// One shape of each kind, with distinct numbers.
const Shape kShapes[] = {
    Sphere{0.25f},
    Aabb{{-1, -2, -3}, {4, 5, 6}},
    Capsule{{1, 2, 3}, {-1, 0, 2}, 0.5f},
    Box{{1, 2, 3}},
    Triangle{{{{0, 0, 1}, {2, 0, 0}, {0, 3, 0}}}, 0.125f, true, 5},
    Halfspace{{0, 3, 4}, -2},
};

// All numbers of the shape.
std::vector<float> numbers(const Shape& shape) {
  if (const auto* s = std::get_if<Sphere>(&shape)) return {s->radius};
  if (const auto* b = std::get_if<Aabb>(&shape)) {
    return {b->lower.x(), b->lower.y(), b->lower.z(), b->upper.x(), b->upper.y(), b->upper.z()};
  }
  std::vector<float> all;
  const auto rows = shape_rows(shape);
  for (uint32_t i = 0; i < row_count(kind_of(shape)); ++i) {
    all.insert(all.end(), rows[i].begin(), rows[i].end());
  }
  return all;
}

void expect_shape(const World& world, BodyId id, const Shape& shape) {
  const Shape got = world.shape(id);
  EXPECT_EQ(kind_of(got), kind_of(shape));
  EXPECT_EQ(numbers(got), numbers(shape));
}

TEST(Bodies, OfEveryKindKeepShapeAndOrientation) {
  const Eigen::Quaternionf turn(0.5f, 1, -2, 3), identity = Eigen::Quaternionf::Identity();
  for (const PositionType positions : kPositionTypes) {
    World world(settings_with(positions));
    std::vector<BodyId> ids;
    for (const Shape& shape : kShapes)
      ids.push_back(world.add({.shape = shape, .orientation = turn}));
    for (size_t i = 0; i < ids.size(); ++i) {
      const bool turns = row_count(kind_of(kShapes[i])) > 0;
      expect_shape(world, ids[i], kShapes[i]);
      EXPECT_EQ(world.orientation(ids[i]).coeffs(), (turns ? turn : identity).coeffs());
      world.set_orientation(ids[i], {4, 3, 2, 1});
      const Eigen::Vector4f expected = turns ? Eigen::Vector4f(3, 2, 1, 4) : identity.coeffs();
      EXPECT_EQ(world.orientation(ids[i]).coeffs(), expected);
    }
    // A new body at the same index starts with its own numbers.
    for (size_t i = 0; i < ids.size(); ++i) {
      world.remove(ids[i]);
      const BodyId next = world.add({.shape = kShapes[(i + 1) % ids.size()]});
      ASSERT_EQ(next.index, ids[i].index);
      EXPECT_EQ(world.orientation(next).coeffs(), identity.coeffs());
      expect_shape(world, next, kShapes[(i + 1) % ids.size()]);
    }
  }
}

TEST(Bodies, BecomeEveryKindFromEveryKind) {
  const Eigen::Quaternionf turn(0.5f, 1, -2, 3);
  for (const Shape& from : kShapes) {
    for (const Shape& to : kShapes) {
      World world;
      std::vector<BodyId> others;
      for (const Shape& shape : kShapes) others.push_back(world.add({.shape = shape}));
      const BodyId id = world.add({.shape = from, .orientation = turn});
      for (const Shape& shape : kShapes) others.push_back(world.add({.shape = shape}));
      world.set_shape(id, to);
      expect_shape(world, id, to);
      const bool turned = row_count(kind_of(from)) > 0 && row_count(kind_of(to)) > 0;
      EXPECT_EQ(world.orientation(id).coeffs(),
                (turned ? turn : Eigen::Quaternionf::Identity()).coeffs());
      world.set_shape(id, from);
      expect_shape(world, id, from);
      for (size_t i = 0; i < others.size(); ++i) expect_shape(world, others[i], kShapes[i % 6]);
    }
  }
}

TEST(Bodies, RowsOfShapesAreUsedAgainAndGivenBack) {
  World world;
  EXPECT_EQ(world.shape_rows().count, 0u);
  EXPECT_EQ(world.shape_rows().rows, nullptr);
  EXPECT_EQ(world.arrays().orientation, nullptr);
  const BodyId ball_id = world.add(ball(0));
  EXPECT_EQ(world.arrays().orientation, nullptr);
  const BodyId box = world.add({.shape = kShapes[3]});            // row 0
  const BodyId capsule = world.add({.shape = kShapes[2]});        // 1, 2
  const BodyId triangle = world.add({.shape = kShapes[4]});       // 3, 4, 5
  const BodyId other_capsule = world.add({.shape = kShapes[2]});  // 6, 7
  EXPECT_EQ(world.shape_rows().count, 8u);
  EXPECT_EQ(world.first_row(triangle), 3u);
  EXPECT_EQ(world.first_row(other_capsule), 6u);
  world.remove(capsule);
  EXPECT_EQ(world.shape_rows().count, 8u);
  EXPECT_EQ(world.first_row(world.add({.shape = kShapes[5]})), 8u) << "no block of one is free";
  world.set_shape(ball_id, kShapes[2]);
  EXPECT_EQ(world.first_row(ball_id), 1u);
  expect_shape(world, ball_id, kShapes[2]);
  world.set_shape(box, kShapes[5]);
  EXPECT_EQ(world.first_row(box), 0u) << "as many rows";
  expect_shape(world, other_capsule, kShapes[2]);
  expect_shape(world, triangle, kShapes[4]);
  std::vector<BodyId> all;
  for (uint32_t i = 0; i < world.arrays().count; ++i) all.push_back(world.id_of(i));
  world.remove(all);
  EXPECT_EQ(world.shape_rows().count, 0u);
  EXPECT_EQ(world.arrays().orientation, nullptr);
}

TEST(Bodies, AreTurnedAndReshapedThroughTheArrays) {
  World world;
  world.add(ball(-50));
  const BodyId plank = world.add({.shape = Box{{2, 0.5f, 0.5f}}});
  const BodyId rod =
      world.add({.shape = Capsule{{0, 0, 0}, {0, 0, 0}, 0.5f}, .position = {0, 2, 0}});
  const auto contacts = [&] {
    world.step();
    return world.contacts().size();
  };
  EXPECT_EQ(contacts(), 0u);
  float* q = world.arrays().orientation + 4 * plank.index;
  q[2] = q[3] = 3;  // a quarter turn about z
  EXPECT_EQ(contacts(), 1u);
  EXPECT_EQ(world.orientation(plank).coeffs(), Eigen::Vector4f(0, 0, 3, 3));
  q[2] = 0;
  EXPECT_EQ(contacts(), 0u);
  float* row = world.shape_rows().rows + 4 * world.first_row(rod);
  row[3] = 1.75f;  // its radius
  EXPECT_EQ(contacts(), 1u);
  EXPECT_EQ(std::get<Capsule>(world.shape(rod)).radius, 1.75f);
  row[3] = 0.5f;
  EXPECT_EQ(contacts(), 0u);
  row[4 + 1] = -1.25f;  // y of its other end
  EXPECT_EQ(contacts(), 1u);
}

TEST(Bodies, EmptyWorldAndWorldOfOne) {
  for (const Detail detail : {Detail::pairs, Detail::overlap, Detail::contact, Detail::manifold}) {
    for (const BroadphaseMethod method :
         {BroadphaseMethod::automatic, BroadphaseMethod::brute, BroadphaseMethod::sweep}) {
      WorldSettings settings;
      settings.detail = detail;
      settings.broadphase = method;
      World world(settings);
      const auto expect_nothing = [&](size_t bodies) {
        const StepReport& report = world.step();
        EXPECT_EQ(report.bodies, bodies);
        EXPECT_EQ(report.pairs + report.tested + report.kept + report.overlaps, 0u);
        EXPECT_TRUE(world.pairs().empty() && world.overlaps().empty());
        EXPECT_TRUE(world.contacts().empty() && world.events().empty());
        EXPECT_TRUE(world.quarantined().empty());
      };
      EXPECT_EQ(world.size(), 0u);
      EXPECT_EQ(world.arrays().count, 0u);
      for (int i = 0; i < 3; ++i) expect_nothing(0);
      const BodyId id = world.add(crate(1));
      for (int i = 0; i < 3; ++i) expect_nothing(1);
      world.remove(id);
      for (int i = 0; i < 3; ++i) expect_nothing(0);
      EXPECT_EQ(world.report().step, 9u);
    }
  }
}

TEST(Bodies, ResultsBeforeTheFirstStepAreEmpty) {
  World world;
  world.add(ball(0));
  world.add(ball(0));
  EXPECT_TRUE(world.pairs().empty() && world.contacts().empty() && world.events().empty());
  EXPECT_EQ(world.report().step, 0u);
  EXPECT_EQ(world.report().stages_run, 0u);
}

TEST(Bodies, WorldsCanBeMoved) {
  World first({.persist_events = true});
  const BodyId a = first.add(ball(0));
  first.add(ball(0.5));
  first.step();
  const Contact* contact = first.contacts().data();
  World second(std::move(first));
  EXPECT_EQ(second.contacts().data(), contact);
  EXPECT_TRUE(second.contains(a));
  World third;
  third.add(ball(0));
  third = std::move(second);
  EXPECT_EQ(third.size(), 2u);
  third.step();
  EXPECT_EQ(third.report().step, 2u);
  EXPECT_EQ(third.report().kept, 1u);
  ASSERT_EQ(third.events().size(), 1u);
  EXPECT_EQ(third.events()[0].kind, EventKind::persist);
}

}  // namespace
}  // namespace carom::test

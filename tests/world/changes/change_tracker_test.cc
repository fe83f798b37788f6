// The change tracker against a plain copy of every body.
#include "world/changes/change_tracker.h"

#include <gtest/gtest.h>

#include <cstring>
#include <map>

#include "carom/base/thread_arena.h"
#include "tests/support/pairs.h"
#include "tests/support/rounds.h"
#include "tests/world/crowds.h"

namespace carom::test {
namespace {

constexpr size_t kBodies = 5000;  // several blocks
constexpr ShapeKind kSimpleKinds[] = {ShapeKind::sphere, ShapeKind::aabb};

struct Snapshot {
  uint32_t generation;
  std::array<double, 3> position;
  std::array<float, 4> orientation;
  std::array<float, 4 * kMostRows> shape;

  bool operator==(const Snapshot& other) const {
    return generation == other.generation &&
           std::memcmp(&position, &other.position, sizeof position) == 0 &&
           std::memcmp(&orientation, &other.orientation, sizeof orientation) == 0 &&
           std::memcmp(&shape, &other.shape, sizeof shape) == 0;
  }
};

class Tracked {
 public:
  Tracked(PositionType positions, std::span<const ShapeKind> some_kinds, bool shares_poses)
      : store(positions), kinds(some_kinds) {
    if (shares_poses) store.share_poses();
    store.share_boxes();
    store.share_shape_rows();
  }

  void add() {
    BodyDesc body{.position = {random.uniform(-9, 9), 0, 1}};
    body.shape = random_shape(kinds[random.below(kinds.size())], random);
    if (random.chance(0.5)) body.orientation = random_orientation(random);
    ids.push_back(store.add(body));
  }

  void remove() {
    std::swap(ids[random.below(ids.size())], ids.back());
    store.remove(ids.back());
    ids.pop_back();
  }

  uint32_t pick() { return ids[random.below(ids.size())].index; }

  void move() { store.set_position(pick(), {random.uniform(-9, 9), 0, 1}); }

  void turn() {
    const uint32_t index = pick();
    if (!has_rows(index)) return;
    BodyStore::Row q = store.orientations()[index];
    q[random.below(4)] += 0.25f;
    if (store.shares_poses()) {
      store.orientations()[index] = q;
    } else {
      store.set_orientation(index, {q[3], q[0], q[1], q[2]});
    }
  }

  void reshape() {
    const uint32_t index = pick();
    const ShapeKind kind = kind_of(store.shape(index));
    if (kind == ShapeKind::aabb) {
      BodyStore::BoxRecord& box = store.boxes()[store.box_slot(index)];
      (random.chance(0.5) ? box.lower : box.upper)[random.below(3)] += 0.25f;
    } else if (has_rows(index)) {
      const size_t row = store.first_row(index) + random.below(row_count(kind));
      store.shape_rows()[row][random.below(3)] += 0.25f;
    }
  }

  void replace_shape() {
    store.set_shape(pick(), random_shape(kinds[random.below(kinds.size())], random));
  }

  // How many have changed since the last call.
  size_t update() {
    tracker.update(store, Parallelism::none);
    store.clear_touched();
    return tracker.changed_count();
  }

  void update_and_check(Parallelism parallelism) {
    tracker.update(store, parallelism);
    store.clear_touched();
    std::map<uint32_t, Snapshot> now;
    size_t changed = 0;
    for (const BodyId id : ids) {
      const auto it = last.find(id.index);
      const Snapshot state = snapshot(id);
      const bool differs = it == last.end() || it->second != state;
      ASSERT_EQ(tracker.changed(id.index), differs) << id.index;
      changed += differs;
      now[id.index] = state;
    }
    bool same_bodies = last.size() == now.size();
    for (const auto& [index, state] : last) {
      same_bodies = same_bodies && now.contains(index) && now[index] == state;
    }
    EXPECT_EQ(tracker.all_unchanged(), same_bodies);
    EXPECT_GE(tracker.changed_count(), changed);
    EXPECT_LE(tracker.changed_count(), changed + store.rows() - store.size());
    last = std::move(now);
  }

  bool has_rows(uint32_t index) const { return row_count(kind_of(store.shape(index))) > 0; }

  BodyStore store;
  std::span<const ShapeKind> kinds;
  ChangeTracker tracker;
  std::vector<BodyId> ids;
  std::map<uint32_t, Snapshot> last;
  Random random{1};

 private:
  Snapshot snapshot(BodyId id) const {
    const Eigen::Vector3d p = store.position(id.index);
    Snapshot state{id.generation, {p.x(), p.y(), p.z()}, {}, {}};
    const Eigen::Quaternionf q = store.orientation(id.index);
    std::copy_n(q.coeffs().data(), 4, state.orientation.begin());
    const Shape shape = store.shape(id.index);
    if (const auto* sphere = std::get_if<Sphere>(&shape)) {
      state.shape[0] = sphere->radius;
    } else if (const auto* box = std::get_if<Aabb>(&shape)) {
      for (int i = 0; i < 3; ++i) {
        state.shape[i] = box->lower[i];
        state.shape[3 + i] = box->upper[i];
      }
    } else {
      // Compares stored numbers, since a k-DOP has unused ones.
      const std::span<const BodyStore::Row> rows =
          store.shape_rows().subspan(store.first_row(id.index), row_count(kind_of(shape)));
      std::memcpy(state.shape.data(), rows.data(), rows.size_bytes());
    }
    return state;
  }
};

void run(PositionType positions, Parallelism parallelism, std::span<const ShapeKind> kinds,
         bool shares_poses) {
  Tracked tracked(positions, kinds, shares_poses);
  const auto repeat = [](size_t count, const auto& what) {
    for (size_t i = 0; i < count; ++i) what();
  };
  for (uint32_t round = 0; round < rounds(40, 18); ++round) {
    // Many, few or no changes of each kind; sometimes most bodies are removed.
    const auto some = [&] {
      constexpr size_t kMost[] = {0, 0, 1, 3, 1000};
      return tracked.random.below(kMost[tracked.random.below(5)] + 1);
    };
    repeat(round % 10 == 0 ? kBodies : some(), [&] { tracked.add(); });
    if (round % 10 == 7) repeat(tracked.ids.size() - 100, [&] { tracked.remove(); });
    repeat(std::min(some(), tracked.ids.size() - 50), [&] { tracked.remove(); });
    repeat(some(), [&] { tracked.move(); });
    repeat(some() / 100, [&] { tracked.replace_shape(); });
    repeat(some(), [&] { tracked.turn(); });
    repeat(some(), [&] { tracked.reshape(); });
    for (int i = 0; i < 2; ++i) tracked.update_and_check(parallelism);
    if (::testing::Test::HasFatalFailure()) return;
  }
}

TEST(ChangeTracker, SaysWhatChanged) {
  for (const PositionType positions : kPositionTypes) {
    for (const bool shares_poses : {false, true}) {
      run(positions, Parallelism::none, kSimpleKinds, shares_poses);
      run(positions, Parallelism::none, kAllKinds, shares_poses);
      run(positions, Parallelism::none, kOrientedKinds, shares_poses);
    }
  }
}

TEST(ChangeTracker, SaysTheSameOnThreads) {
  ThreadArena arena(4);
  arena.run([&] { run(PositionType::float32, arena.parallelism(), kAllKinds, true); });
}

class ChangesOfPoses : public ::testing::TestWithParam<bool> {};

TEST_P(ChangesOfPoses, CountsExactlyWhatMoved) {
  Tracked tracked(PositionType::float32, kSimpleKinds, GetParam());
  for (size_t i = 0; i < kBodies; ++i) tracked.add();
  const auto update = [&] { return tracked.update(); };
  EXPECT_EQ(update(), kBodies);
  EXPECT_EQ(update(), 0u);
  tracked.store.set_position(7, {50, 0, 0});
  tracked.store.set_position(4000, {50, 0, 0});
  tracked.store.set_motion(7, Motion::fixed);
  EXPECT_EQ(update(), 2u);
  EXPECT_EQ(update(), 0u);
  EXPECT_TRUE(tracked.tracker.all_unchanged());
}

// Columns of orientations and rows appear and disappear with the bodies that need them; this
// changes no body.
TEST_P(ChangesOfPoses, ColumnsThatAppearChangeNobody) {
  Tracked tracked(PositionType::float32, kSimpleKinds, GetParam());
  for (size_t i = 0; i < kBodies; ++i) tracked.add();
  const auto update = [&] { return tracked.update(); };
  update();
  for (int i = 0; i < 3; ++i) {
    const BodyId id = tracked.store.add({.shape = Box{{1, 1, 1}}});
    EXPECT_EQ(update(), 1u);
    EXPECT_EQ(update(), 0u);
    tracked.store.set_orientation(id.index, {0, 1, 0, 0});
    EXPECT_EQ(update(), 1u);
    tracked.store.set_orientation(id.index, {-0.0f, 1, 0, 0});
    EXPECT_EQ(update(), 1u) << "other bits";
    tracked.store.set_shape(7, Capsule{});
    EXPECT_EQ(update(), 1u);
    tracked.store.set_shape(7, Sphere{1});
    EXPECT_EQ(update(), 1u);
    tracked.store.remove(id);
    EXPECT_EQ(update(), 0u);
    EXPECT_FALSE(tracked.tracker.changed(7));
  }
}

TEST_P(ChangesOfPoses, FindsEverythingChangedAfterItForgot) {
  Tracked tracked(PositionType::float32, kSimpleKinds, GetParam());
  tracked.store.add({.shape = Sphere{0}});  // all zero, like memory that was never written
  for (size_t i = 1; i < kBodies; ++i) tracked.add();
  const auto update = [&] { return tracked.update(); };
  update();
  update();
  tracked.tracker.forget();
  tracked.store.set_position(7, {50, 0, 0});
  EXPECT_EQ(update(), kBodies);
  EXPECT_TRUE(tracked.tracker.changed(0));
  EXPECT_FALSE(tracked.tracker.all_unchanged());
  EXPECT_EQ(update(), 0u);
  EXPECT_TRUE(tracked.tracker.all_unchanged());
  EXPECT_FALSE(tracked.tracker.changed(kBodies - 1));
}

TEST_P(ChangesOfPoses, ThatAreSetToWhatTheyWereAreNone) {
  Tracked tracked(PositionType::float64, kAllKinds, GetParam());
  for (size_t i = 0; i < kBodies; ++i) tracked.add();
  const auto set_all_again = [&] {
    for (const BodyId id : tracked.ids) {
      tracked.store.set_position(id.index, tracked.store.position(id.index));
      tracked.store.set_orientation(id.index, tracked.store.orientation(id.index));
    }
  };
  tracked.update_and_check(Parallelism::none);
  set_all_again();
  EXPECT_TRUE(tracked.store.moved_indices().empty());
  tracked.update_and_check(Parallelism::none);
  EXPECT_TRUE(tracked.tracker.all_unchanged());
}

// `true`: the caller has asked for the arrays of poses.
INSTANTIATE_TEST_SUITE_P(OfStoreOrArrays, ChangesOfPoses, ::testing::Bool());

TEST(ChangeTracker, ComparesPosesOnceTheyAreShared) {
  Tracked tracked(PositionType::float32, kAllKinds, false);
  for (size_t i = 0; i < kBodies; ++i) tracked.add();
  const auto update = [&] { return tracked.update(); };
  update();
  tracked.store.set_position(7, {50, 0, 0});
  tracked.store.share_poses();
  tracked.store.records32()[4 * 8] += 1;
  EXPECT_EQ(update(), 2u);
  EXPECT_TRUE(tracked.tracker.changed(7) && tracked.tracker.changed(8));
  EXPECT_FALSE(tracked.tracker.all_unchanged());
  EXPECT_EQ(update(), 0u);
  EXPECT_TRUE(tracked.tracker.all_unchanged());
  tracked.store.records32()[4 * 8] += 1;
  tracked.store.set_position(9, {50, 0, 0});
  EXPECT_EQ(update(), 2u);
  EXPECT_TRUE(tracked.tracker.changed(8) && tracked.tracker.changed(9));
}

// Poses that a caller writes while everything moves are not compared.
TEST(ChangeTracker, TakesAllAsChangedWhileAllMove) {
  constexpr size_t kMany = 9000;
  Tracked tracked(PositionType::float32, kSimpleKinds, true);
  for (size_t i = 0; i < kMany; ++i) tracked.add();
  const auto update = [&](size_t moving) {
    for (size_t i = 0; i < moving; ++i) tracked.store.records32()[4 * i] += 1;
    return tracked.update();
  };
  for (int i = 0; i < 4; ++i) EXPECT_EQ(update(kMany), kMany);
  EXPECT_EQ(update(kMany / 2), kMany) << "the copies are old";
  EXPECT_EQ(update(kMany / 2), kMany / 2);
  EXPECT_FALSE(tracked.tracker.changed(kMany / 2));
  EXPECT_EQ(update(0), 0u);
  EXPECT_TRUE(tracked.tracker.all_unchanged());
  for (int i = 0; i < 4; ++i) EXPECT_EQ(update(kMany), kMany);
  EXPECT_EQ(update(0), kMany);
  EXPECT_FALSE(tracked.tracker.all_unchanged());
  EXPECT_EQ(update(0), 0u);
  EXPECT_TRUE(tracked.tracker.all_unchanged());
  for (int i = 0; i < 4; ++i) update(kMany);
  tracked.add();
  EXPECT_EQ(update(0), kMany + 1) << "another number of rows";
  EXPECT_EQ(update(0), 0u);
}

}  // namespace
}  // namespace carom::test

// What the change tracker says against a plain copy of every body.
#include "world/change_tracker.h"

#include <gtest/gtest.h>

#include <cstring>
#include <map>

#include "carom/kernel/thread_arena.h"
#include "tests/support/pairs.h"
#include "tests/support/random.h"

namespace carom::test {
namespace {

constexpr size_t kBodies = 5000;  // several blocks

struct Snapshot {
  uint32_t generation;
  std::array<double, 3> position;
  std::array<float, 6> shape;

  bool operator==(const Snapshot& other) const {
    return generation == other.generation &&
           std::memcmp(&position, &other.position, sizeof position) == 0 &&
           std::memcmp(&shape, &other.shape, sizeof shape) == 0;
  }
};

class Tracked {
 public:
  explicit Tracked(PositionType positions) : store(positions) {}

  void add() {
    BodyDesc body{.position = {random.uniform(-9, 9), 0, 1}};
    body.shape = Sphere{0.5f};
    if (random.chance(0.5)) body.shape = Aabb::from_half_extents({1, 2, 3});
    ids.push_back(store.add(body));
  }

  void remove() {
    std::swap(ids[random.below(ids.size())], ids.back());
    store.remove(ids.back());
    ids.pop_back();
  }

  uint32_t pick() { return ids[random.below(ids.size())].index; }

  void move() { store.set_position(pick(), {random.uniform(-9, 9), 0, 1}); }

  void reshape() {
    const uint32_t index = pick();
    if (std::holds_alternative<Aabb>(store.shape(index))) {
      store.boxes()[random.below(6)][store.box_slot(index)] += 0.25f;
    }
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

  BodyStore store;
  ChangeTracker tracker;
  std::vector<BodyId> ids;
  std::map<uint32_t, Snapshot> last;
  Random random{1};

 private:
  Snapshot snapshot(BodyId id) const {
    const Eigen::Vector3d p = store.position(id.index);
    Snapshot state{id.generation, {p.x(), p.y(), p.z()}, {}};
    const Shape shape = store.shape(id.index);
    if (const auto* sphere = std::get_if<Sphere>(&shape)) {
      state.shape[0] = sphere->radius;
    } else {
      const auto& box = std::get<Aabb>(shape);
      for (int i = 0; i < 3; ++i) {
        state.shape[i] = box.lower[i];
        state.shape[3 + i] = box.upper[i];
      }
    }
    return state;
  }
};

void run(PositionType positions, Parallelism parallelism) {
  Tracked tracked(positions);
  const auto repeat = [](size_t count, const auto& what) {
    for (size_t i = 0; i < count; ++i) what();
  };
  for (int round = 0; round < 40; ++round) {
    // Many, few or none of each kind of change; sometimes most bodies go.
    const auto some = [&] {
      constexpr size_t kMost[] = {0, 0, 1, 3, 1000};
      return tracked.random.below(kMost[tracked.random.below(5)] + 1);
    };
    repeat(round % 10 == 0 ? kBodies : some(), [&] { tracked.add(); });
    if (round % 10 == 7) repeat(tracked.ids.size() - 100, [&] { tracked.remove(); });
    repeat(std::min(some(), tracked.ids.size() - 50), [&] { tracked.remove(); });
    repeat(some(), [&] { tracked.move(); });
    repeat(some(), [&] { tracked.reshape(); });
    for (int i = 0; i < 2; ++i) tracked.update_and_check(parallelism);
    if (::testing::Test::HasFatalFailure()) return;
  }
}

TEST(ChangeTracker, SaysWhatChanged) {
  for (const PositionType positions : kPositionTypes) run(positions, Parallelism::none);
}

TEST(ChangeTracker, SaysTheSameOnThreads) {
  ThreadArena arena(4);
  arena.run([&] { run(PositionType::float32, arena.parallelism()); });
}

TEST(ChangeTracker, CountsExactlyWhatMoved) {
  Tracked tracked(PositionType::float32);
  for (size_t i = 0; i < kBodies; ++i) tracked.add();
  const auto update = [&] {
    tracked.tracker.update(tracked.store, Parallelism::none);
    tracked.store.clear_touched();
    return tracked.tracker.changed_count();
  };
  EXPECT_EQ(update(), kBodies);
  EXPECT_EQ(update(), 0u);
  tracked.store.set_position(7, {50, 0, 0});
  tracked.store.set_position(4000, {50, 0, 0});
  tracked.store.set_motion(7, Motion::fixed);
  EXPECT_EQ(update(), 2u);
  EXPECT_EQ(update(), 0u);
  EXPECT_TRUE(tracked.tracker.all_unchanged());
}

TEST(ChangeTracker, FindsEverythingChangedAfterItForgot) {
  Tracked tracked(PositionType::float32);
  tracked.store.add({.shape = Sphere{0}});  // all zero, as memory that was never written
  for (size_t i = 1; i < kBodies; ++i) tracked.add();
  const auto update = [&] {
    tracked.tracker.update(tracked.store, Parallelism::none);
    tracked.store.clear_touched();
    return tracked.tracker.changed_count();
  };
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

}  // namespace
}  // namespace carom::test

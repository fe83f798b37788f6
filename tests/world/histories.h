// Random histories of a world: bodies are added, removed, moved, left at rest and changed, and
// every step is compared with the reference.
#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <random>
#include <set>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "carom/reference/reference.h"
#include "carom/world/world.h"
#include "tests/world/crowds.h"

namespace carom::test {

template <class T>
::testing::AssertionResult same_bytes(std::span<const T> got, std::span<const T> expected) {
  if (got.size() != expected.size()) {
    return ::testing::AssertionFailure() << got.size() << " instead of " << expected.size();
  }
  for (size_t i = 0; i < got.size(); ++i) {
    if (std::memcmp(&got[i], &expected[i], sizeof(T)) != 0) {
      return ::testing::AssertionFailure() << "entry " << i << " differs";
    }
  }
  return ::testing::AssertionSuccess();
}

// Counts of events in all histories of a test, so that no test runs empty.
struct Coverage {
  size_t tested = 0, kept = 0, dropped = 0, overlapping = 0, pairs = 0, quarantined = 0,
         sensors = 0;
  size_t events[kEventKindCount] = {};
  size_t with_halfspaces = 0, halfspace_overlaps = 0;  // pairs with half-spaces
  size_t manifolds[5] = {};                            // by number of points
  size_t impacts = 0, overlaps_ahead = 0, impacts_of_sensors = 0, speculative = 0;
  size_t swept = 0, unswept = 0;
  size_t near = 0;                // contacts of separate pairs
  size_t left_out = 0;            // contacts beyond the limit of a pair
  size_t excluded = 0, gone = 0;  // pairs; events of removed or quarantined bodies
};

enum class Kinds { spheres_and_aabbs, all };

// A world and a plain list of its bodies.
class History {
 public:
  History(const WorldSettings& settings, uint32_t seed, Kinds kinds = Kinds::spheres_and_aabbs)
      : world_(settings), random_(seed), shapes_(seed), filters_(seed), kinds_(kinds) {}

  Coverage coverage;

  World& world() { return world_; }
  size_t size() const { return bodies_.size(); }

  double uniform(double low, double high);
  bool chance(double probability) { return uniform(0, 1) < probability; }

  // From now on new bodies, and bodies whose motion changes, get detections and high velocities.
  void look_ahead() { looks_ahead_ = true; }

  // From now on some of the new bodies, and of those that change, have contact distances.
  void keep_distance() { keeps_distance_ = true; }

  // A body in a box of side `side`; with `filters`, some have layers, owners, groups, spaces, are
  // sensors or static.
  BodyDesc random_body(double side, bool filters);

  void add(const BodyDesc& body);

  void remove_random();

  // Moves about `share` of the bodies, half of them through the arrays.
  void move(double share, double distance);

  // Turns about `share` of the bodies with an orientation, half of them through the arrays; some
  // become invalid for a while.
  void turn(double share);

  // Changes one number in the rows of about `share` of the bodies that have rows.
  void write_rows(double share);

  // Changes the velocities of about `share` of the bodies, half of them through the arrays.
  void change_motions(double share);

  void change_random_body(double side, bool filters);

  // Excludes some pairs, most of which are pairs of the last step, and includes some again.
  void change_excluded();

  // Sets a predicate that drops about one pair in five; another one at each call.
  void change_predicate();

  // Steps the world and compares everything with the reference.
  void step_and_check();

 private:
  static bool has_rows(const BodyDesc& body) { return row_count(kind_of(body.shape)) > 0; }

  Eigen::Quaternionf spoilt_orientation();

  void make_oriented(BodyDesc& body, bool spoil);

  // Most bodies move by about a metre in a step or less; some rest.
  void set_in_motion(BodyDesc& body, bool spoil);

  void cover_ahead(const StepReport& report);

  void cover_halfspaces();

  std::map<uint32_t, reference::Body>::iterator pick();

  void write(uint32_t index, const Eigen::Vector3d& position);

  // As World::events() has them.
  std::vector<Event> wanted_events(std::vector<Event> events) const;

  World world_;
  std::mt19937 random_;
  Random shapes_;
  Random filters_;
  Kinds kinds_;
  bool looks_ahead_ = false;
  bool keeps_distance_ = false;
  std::map<uint32_t, reference::Body> bodies_;
  std::set<Pair> excluded_;
  PairPredicate predicate_;
  reference::Frame frame_;
};

}  // namespace carom::test

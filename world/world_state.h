// The stages of a world, and the data that flows between them.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "broadphase/resting/box_memory.h"
#include "broadphase/sort/pair_selection.h"
#include "carom/world/world.h"
#include "world/changes/change_tracker.h"
#include "world/changes/drift.h"
#include "world/changes/pace_sample.h"
#include "world/changes/rest_watch.h"
#include "world/motion/body_bounds.h"
#include "world/motion/fat_bounds.h"
#include "world/motion/look_ahead.h"
#include "world/motion/present_bounds.h"
#include "world/motion/sweeps.h"
#include "world/motion/swept_bounds.h"
#include "world/motion/wide_bounds.h"
#include "world/pairs/carry_plan.h"
#include "world/pairs/direction_memory.h"
#include "world/pairs/dop_stage.h"
#include "world/pairs/gap_stage.h"
#include "world/pairs/halfspace_stage.h"
#include "world/pairs/outer_stage.h"
#include "world/pairs/pair_changes.h"
#include "world/pairs/pair_history.h"
#include "world/pairs/pair_sieve.h"
#include "world/pairs/result_hold.h"
#include "world/pairs/shell_memory.h"
#include "world/query_index.h"
#include "world/results/contact_stage.h"
#include "world/results/event_stage.h"
#include "world/results/identity_stage.h"
#include "world/results/impact_stage.h"
#include "world/results/refresh_stage.h"
#include "world/results/speculative_stage.h"
#include "world/store/body_store.h"
#include "world/store/excluded_pairs.h"

namespace carom {

struct World::State {
  explicit State(const WorldSettings& chosen)
      : settings(chosen),
        bodies(chosen.positions, chosen.accuracy.tolerance, !has_proofs(chosen.accuracy.tier)) {}

  const StepReport& step();
  // The bodies, exclusions and predicate of a world whose step has thrown, as if the bodies had
  // just been added. If this throws as well, `broken` is as it was.
  static std::unique_ptr<State> without_results(State& broken);
  BoundsView bounds_view() const { return bounds.view(); }
  WorldMemory memory() const;
  void give_back_memory();
  const BodyIndex& index_for_queries(Parallelism parallelism);

  WorldSettings settings;
  BodyStore bodies;
  ExcludedPairs excluded;
  PairPredicate predicate;
  bool predicate_changed = false;  // since the last step
  bool is_broken = false;          // a step has thrown
  StepReport report;

  HalfspaceStage halfspaces;
  BodyBounds bounds;
  QueryIndex query_index;
  PairHistory now;
  PairChanges pair_changes;
  ImpactStage impacts;
  SpeculativeStage speculative;
  RawVector<Event> events;

 private:
  bool has_narrowphase() const { return settings.detail != Detail::pairs; }
  bool has_velocities() { return has_contacts(settings.detail) && bodies.has_velocities(); }
  bool has_events() const { return settings.events && has_narrowphase(); }
  bool has_margin() const { return settings.margin > 0; }
  // Only a world that carries results can hold on to them, and not one that proves them.
  bool has_tolerance() const {
    return carries() && !has_proofs(settings.accuracy.tier) &&
           (is_tolerance(settings.accuracy.tolerance) || bodies.has_tolerances());
  }
  static bool is_tolerance(float metres) { return metres > 0 && std::isfinite(metres); }
  // None with contact distances, since pairs with separate k-DOPs may have contacts.
  bool has_dops() const {
    return settings.dop_bounds && *settings.dop_bounds != DopKind::k6 && !has_distances();
  }
  bool has_composites() const { return bodies.has_composites(); }
  // For the same reason.
  bool has_outer() const { return has_composites() && !has_distances(); }
  ContactDistances distances() const {
    if (!has_contacts(settings.detail)) return {};
    return {settings.contact_distance, bodies.contact_distances()};
  }
  bool has_distances() const { return distances().any(); }
  bool carries() const { return settings.carry_results && has_narrowphase(); }
  // At detail pairs there are no results to carry, so comparing all bodies pays only while none
  // moves.
  bool watches_rest() const { return settings.carry_results && !has_narrowphase(); }
  bool compares_bodies() const { return carries() || (watches_rest() && rest_watch.is_on()); }
  bool looks_ahead() const { return sweeps.any(); }
  PresentBounds present_bounds() const { return {bounds_view(), halfspaces}; }
  // The same, grown by the contact distances.
  PresentBounds wide_present_bounds() const {
    return has_distances() ? PresentBounds{wide_bounds.view(), halfspaces, distances()}
                           : present_bounds();
  }
  // The bounds from which pairs are made, before any margin.
  BoundsView reach_view() const {
    if (has_distances()) return looks_ahead() ? wide_swept_bounds.view() : wide_bounds.view();
    return looks_ahead() ? swept_bounds.view() : bounds_view();
  }
  bool uses_directions() const;
  bool has_identities() const { return settings.identities && has_contacts(settings.detail); }
  bool needs_sorted_pairs() const {
    return has_narrowphase() || settings.pair_changes || halfspaces.has_any() ||
           !excluded.pairs().empty();
  }
  bool needs_last() const {
    return carries() || has_events() || settings.pair_changes || has_identities();
  }

  // How long something took, and of that, how long one thread worked alone.
  struct Time {
    uint64_t ns, serial_ns;

    Time part(double share) const {
      const auto of = [share](uint64_t time) {
        return static_cast<uint64_t>(share * static_cast<double>(time));
      };
      return {of(ns), of(serial_ns)};
    }
  };

  template <class Work>
  Time time_of(const Work& work);
  void count(Stage stage, const Time& time);
  template <class Work>
  void run(Stage stage, const Work& work);
  bool is_still();
  bool can_drift() const { return has_tolerance() && !bodies.has_detections(); }
  bool may_drift();
  bool is_still_within_tolerance();
  bool has_same_filters() const { return !excluded.has_changes() && !predicate_changed; }
  bool keeps_pairs() const;
  // Whether results of pairs that stay are renewed where they are. At detail regions a pair has any
  // number of contacts.
  bool refreshes() const { return drifts && settings.detail != Detail::regions; }
  // Whether a step may differ from the last one by such results alone.
  bool only_refreshes() const {
    return refreshes() && keeps_pairs() && !settings.identities && !settings.persist_events;
  }
  void refresh_due();
  size_t pairs_at_once() const;
  void find_changes();
  void find_sweeps();
  void find_all();
  void watch_rest(bool still);
  void fill_report();
  void find_bounds();
  void sweep_bounds();
  void widen_bounds();
  void find_pairs();
  void select_pairs();
  void compare_pairs();
  void drop_pairs();
  void drop_outer();
  ContactStage::Last use_of_last_contacts(bool in_one_range) const;
  void find_results();
  void write_contacts(const PairRange& range, const ContactStage::Input& found,
                      const NormalVelocities* velocities);
  float tolerance_of_tests() const;
  void test_pairs(std::span<const Pair> pairs, const PairRange& range, uint32_t* direction,
                  ShellLists* lists);
  ShellLists* prepare_shells();
  void measure_gaps(std::span<const Pair> all, const PairRange& range);
  void find_impacts();
  void forget_ahead();
  void stop_looking_ahead();

  std::chrono::steady_clock::time_point last_stage_end;
  bool was_still = false;  // the last step repeated its predecessor
  ChangeTracker changes;
  HoldWatch hold_watch;
  bool drifts = false;  // this step holds on to results within the tolerance
  PaceSample paces;
  Drift drift;
  ResultHold hold;
  RefreshStage refresh;
  GapStage gaps;
  RestWatch rest_watch;
  BoxSample sample;
  Sweeps sweeps;
  SweptBounds swept_bounds;
  WideBounds wide_bounds, wide_swept_bounds;  // of bodies now, and over the interval ahead
  FatBounds fat_bounds;
  PairFinder finder;
  bool searched_plain = false;  // whether its last search took the bounds as they are
  PairSearch search;
  PairSieve sieve;
  PairSelection selection;
  PairHistory last;
  CarryPlan plan;
  DopStage dops;
  OuterStage outer;
  DirectionMemory directions;
  ShellMemory shells;
  ResultBuffer results;
  ContactStage contact_stage;
  EventStage event_stage;
};

// The time between two stages, which is short, counts to the second: in a small world a look at the
// clock takes as long.
template <class Work>
World::State::Time World::State::time_of(const Work& work) {
  const uint64_t shared_before = shared_nanoseconds();
  work();
  const auto end = std::chrono::steady_clock::now();
  const auto duration = end - std::exchange(last_stage_end, end);
  const auto ns = static_cast<uint64_t>(std::chrono::nanoseconds(duration).count());
  return {ns, ns - std::min(shared_nanoseconds() - shared_before, ns)};
}

template <class Work>
void World::State::run(Stage stage, const Work& work) {
  count(stage, time_of(work));
}

}  // namespace carom

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "base/few_of.h"
#include "base/float_environment.h"
#include "base/parallel.h"
#include "carom/bounds/bounds.h"
#include "midphase/collide_pairs.h"
#include "world/world_state.h"

namespace carom {

// How many pairs are tested before their results are read. Those of one thread stay in its cache;
// threads share more, so that all have work.
size_t World::State::pairs_at_once() const {
  constexpr size_t kBlocksOfOneThread = 1, kBlocksOfThreads = 16;
  return kPairsPerMergeBlock *
         (uses_threads(settings.parallelism) ? kBlocksOfThreads : kBlocksOfOneThread);
}

void World::State::count(Stage stage, const Time& time) {
  const auto index = static_cast<size_t>(stage);
  report.stages_run |= 1u << index;
  report.stage_ns[index] += time.ns;
  report.serial_ns[index] += time.serial_ns;
}

const StepReport& World::State::step() {
  const FloatEnvironment environment;
  const Parallelism parallelism = settings.parallelism;
  report = {.step = report.step + 1, .search = {}};
  last_stage_end = std::chrono::steady_clock::now();
  bodies.find_geometries();
  const bool drifted = drifts;

  const bool still = is_still();
  const bool keeps_list = still || only_refreshes();
  if (keeps_list) {
    plan.carry_all();
    last.clear();
    pair_changes.clear();
    if (has_identities() && !was_still) repeat_identities(parallelism, now);
  } else {
    if (needs_last()) std::swap(last, now);
    find_all();
  }
  const bool refreshed = !still && refreshes();
  refresh.clear();
  if (refreshed) refresh_due();
  if (!keeps_list && has_identities()) {
    run(Stage::results, [&] { find_previous(last, bodies, parallelism, now); });
  }
  if ((keeps_list || refreshes()) && has_velocities()) {
    run(Stage::velocities, [&] { NormalVelocities(bodies).set_all(now.contacts, parallelism); });
  }
  // After two still steps no event is a begin or an end; keep them.
  if (has_events() && !(still && was_still)) {
    run(Stage::events, [&] {
      if (keeps_list && !settings.persist_events) {
        events.clear();
      } else {
        event_stage.run({still ? now : last, now, still ? nullptr : &plan, bodies,
                         bounds.quarantined(), settings.persist_events, refreshes()},
                        parallelism, events);
      }
      if (refreshed && !settings.persist_events) {
        refresh.add_events(bodies, now, events);
      }
      EventStage::add_impacts(impacts.impacts(), bodies, events);
      event_stage.remember(bodies);
    });
  }
  bodies.clear_touched();
  predicate_changed = false;
  was_still = still;
  if (watches_rest()) watch_rest(still);
  fill_report();
  if (has_tolerance() && !still) hold_watch.saw(report.kept, report.pairs, drifted);
  return report;
}

std::unique_ptr<World::State> World::State::without_results(State& broken) {
  broken.bodies.touch_all();
  auto state = std::make_unique<State>(broken.settings);
  state->bodies = std::move(broken.bodies);
  state->excluded = std::move(broken.excluded);
  state->predicate = std::move(broken.predicate);
  state->predicate_changed = true;
  state->report.step = broken.report.step;
  return state;
}

// Whether the step repeats the last one.
bool World::State::is_still() {
  const bool drifted = std::exchange(drifts, may_drift());
  if (drifts) return is_still_within_tolerance();
  if (drifted) changes.forget();
  now.holds_until.clear();
  const bool compares = compares_bodies();
  if (compares || bodies.has_detections()) {
    run(Stage::changes, [&] {
      if (compares) find_changes();
      if (bodies.has_detections()) find_sweeps();
    });
  }
  if (!bodies.has_detections()) stop_looking_ahead();
  return compares && changes.all_unchanged() && !sweeps.changed() && has_same_filters();
}

void World::State::find_sweeps() {
  sweeps.update(bodies, settings.dt, settings.fast_share, settings.parallelism);
}

void World::State::find_changes() {
  changes.update_shapes(bodies, settings.parallelism);
  changes.update_bodies(bodies, settings.parallelism);
}

void World::State::find_all() {
  run(Stage::bounds, [&] { find_bounds(); });
  if (looks_ahead()) {
    run(Stage::sweeps, [&] { sweep_bounds(); });
  } else {
    forget_ahead();
  }
  if (has_distances()) run(Stage::margins, [&] { widen_bounds(); });
  if (has_margin()) {
    run(Stage::margins,
        [&] { fat_bounds.update(reach_view(), settings.margin, settings.parallelism); });
  }
  run(Stage::broadphase, [&] { find_pairs(); });
  if (settings.pair_changes || has_narrowphase()) run(Stage::pairs, [&] { compare_pairs(); });
  if (!has_narrowphase()) return;
  if (has_dops()) {
    run(Stage::dops, [&] { drop_pairs(); });
  } else if (has_outer() && outer.starts_step()) {
    run(Stage::dops, [&] { drop_outer(); });
  }
  find_results();
  if (looks_ahead()) run(Stage::impacts, [&] { find_impacts(); });
}

// Says whether nothing seems to have moved. Where the broadphase keeps boxes, it has counted the
// changes; a sample of the bounds covers the rest.
void World::State::watch_rest(bool still) {
  if (still) {
    rest_watch.saw_rest();
  } else {
    rest_watch.saw_step(search.changed == 0 && sample.changed_share(bounds_view()) == 0);
    if (!rest_watch.is_on()) changes.forget();
  }
}

void World::State::fill_report() {
  report.bodies = bodies.size();
  report.quarantined = bounds.quarantined().size();
  report.pairs = now.pairs.size();
  report.tested = has_narrowphase() ? plan.tested() + refresh.renewed() : 0;
  report.dropped = has_narrowphase() ? plan.dropped() : 0;
  report.kept = has_narrowphase() ? report.pairs - report.tested - report.dropped : 0;
  report.overlaps = has_narrowphase() ? contact_stage.overlaps() : 0;
  report.contacts = now.contacts.size();
  report.left_out = has_contacts(settings.detail) ? contact_stage.left_out() : 0;
  report.undecided = has_narrowphase() ? contact_stage.undecided() : 0;
  report.swept = sweeps.swept();
  report.unswept = sweeps.unswept();
  report.impacts = impacts.impacts().size();
  report.speculative = speculative.contacts().size();
  report.search = search;
}

void World::State::find_bounds() {
  if (drifts) {
    if (drift.all_outgrown()) {
      bounds.update_all(bodies, settings.parallelism, halfspaces);
    } else if (!drift.outgrown().empty() || bodies.any_touched()) {
      bounds.update(bodies, drift.outgrown(), halfspaces);
    }
    bounds.grow(drift.outgrown(), drift.growth(), settings.parallelism);
  } else if (carries() && changes.are_few()) {
    bounds.update(bodies, changes.few(), halfspaces);
  } else {
    bounds.update_all(bodies, settings.parallelism, halfspaces);
  }
}

void World::State::sweep_bounds() {
  swept_bounds.update(bodies.view(), sweeps, bounds_view(), settings.parallelism);
  halfspaces.sweep(sweeps);
}

void World::State::widen_bounds() {
  wide_bounds.update(bounds_view(), distances(), settings.parallelism);
  if (looks_ahead()) {
    wide_swept_bounds.update(swept_bounds.view(), distances(), settings.parallelism);
  }
  halfspaces.widen(distances());
}

void World::State::find_pairs() {
  if (keeps_pairs()) {
    now.pairs = last.pairs;
    return;
  }
  if (!settings.carry_results) finder.forget();
  finder.set_most_pairs(settings.most_pairs);
  excluded.update();
  finder.set_order(needs_sorted_pairs() ? PairOrder::sorted : settings.pair_order);
  const BoundsView searched = has_margin() ? fat_bounds.view() : reach_view();
  std::vector<Pair>& found = halfspaces.has_any() ? halfspaces.other_pairs() : now.pairs;
  PairFilter filter = bodies.filter();
  filter.rule = settings.filter_rule;
  // Bounds that are swept or grown may differ where bodies do not.
  const bool plain = !looks_ahead() && !has_distances() && !has_margin();
  const bool knows_changes = std::exchange(searched_plain, plain) && plain && carries();
  const bool few_changed = knows_changes && (drifts ? !drift.all_outgrown() : changes.are_few());
  const std::span<const uint32_t> changed = drifts ? drift.outgrown() : changes.few();
  const BroadphaseMethod method = settings.broadphase;
  const Parallelism parallelism = settings.parallelism;
  search = few_changed ? finder.find_changed(searched, filter, changed, found, method, parallelism)
                       : finder.find(searched, filter, found, method, parallelism);
  if (halfspaces.has_any()) {
    halfspaces.add_pairs(reach_view(), filter, settings.most_pairs, settings.parallelism, now.pairs,
                         search);
  }
  if (looks_ahead()) sieve.run(sweeps, wide_present_bounds(), settings.parallelism, now.pairs);
  select_pairs();
  if (search.complete) search.pairs = now.pairs.size();
}

// Drops the pairs that the caller does not want.
void World::State::select_pairs() {
  selection.run(excluded.pairs(), &excluded.digest(), predicate ? &predicate : nullptr,
                settings.parallelism, now.pairs);
}

// Finds the pairs that appeared and vanished, and those to test.
void World::State::compare_pairs() {
  if (settings.pair_changes) {
    pair_changes.run(last.pairs, now.pairs, bodies, settings.parallelism);
  }
  if (!has_narrowphase()) return;
  if (refreshes()) {
    plan.match(last.pairs, now.pairs, drift.replaced(), settings.parallelism);
    hold.follow(plan, now.pairs.size());
    return;
  }
  if (drifts) {
    plan.match_undue(last.pairs, now.pairs, hold.due_flags(last.pairs.size()),
                     settings.parallelism);
    return;
  }
  // If all bodies changed, nothing is carried.
  const bool all_changed = changes.changed_count() == bodies.rows();
  if (carries() && !all_changed) {
    plan.match(last.pairs, now.pairs, changes.changed(), settings.parallelism);
  } else {
    plan.test_all(now.pairs.size());
  }
}

// Drops pairs whose k-DOPs are separate: they need no test.
void World::State::drop_pairs() {
  const std::span<const uint8_t> changed =
      carries() && !drifts ? changes.changed() : std::span<const uint8_t>();
  dops.update(bodies.view(), *settings.dop_bounds, changed, settings.parallelism);
  const std::vector<Pair>& pairs = plan.pairs_to_test(now.pairs);
  if (pairs.empty()) return;
  plan.drop(dops.test(pairs, settings.parallelism), now.pairs, settings.parallelism);
}

// Drops pairs of meshes and compounds whose hulls are apart.
void World::State::drop_outer() {
  const std::vector<Pair>& pairs = plan.pairs_to_test(now.pairs);
  if (pairs.empty()) return;
  const std::vector<uint8_t>& needs_test = outer.test(bodies, pairs, settings.parallelism);
  if (std::find(needs_test.begin(), needs_test.end(), 0) == needs_test.end()) return;
  plan.drop(needs_test, now.pairs, settings.parallelism);
}

// Whether the world has two kinds whose test remembers the separating direction.
bool World::State::uses_directions() const {
  if (!carries() || !has_contacts(settings.detail) || has_distances()) {
    return false;
  }
  const auto is_there = [this](int kind) { return bodies.has_kind(static_cast<ShapeKind>(kind)); };
  for (int a = 0; a < kShapeKindCount; ++a) {
    for (int b = 0; b < kShapeKindCount; ++b) {
      const bool use_them =
          carom::uses_directions(static_cast<ShapeKind>(a), static_cast<ShapeKind>(b));
      if (use_them && is_there(a) && is_there(b)) return true;
    }
  }
  return false;
}

ContactStage::Last World::State::use_of_last_contacts(bool in_one_range) const {
  if (has_identities()) return ContactStage::Last::copied;
  const size_t open = plan.tested() + plan.dropped(), pairs = now.pairs.size();
  if (open >= pairs) return ContactStage::Last::unused;
  // Threads copy faster than one of them moves. Where few are carried, runs are short.
  const bool moves = in_one_range && 4 * open < pairs && settings.detail != Detail::regions &&
                     !uses_threads(settings.parallelism);
  return moves ? ContactStage::Last::in_place : ContactStage::Last::copied;
}

// Tests pairs and lists their contacts, range by range, so that the results of a range are read
// while they are in the cache.
void World::State::find_results() {
  const bool remembers = uses_directions() && directions.starts_step();
  uint32_t* directions_of_tests = nullptr;
  if (remembers) {
    run(Stage::narrowphase,
        [&] { directions_of_tests = directions.prepare(plan, last, settings.parallelism, now); });
  }
  ShellLists* const lists = remembers ? prepare_shells() : nullptr;
  const size_t pairs = now.pairs.size();
  // Where most pairs are carried, more of them have as many to test.
  const size_t share = std::clamp<size_t>(pairs / std::max<size_t>(1, plan.tested()), 1, 64);
  const size_t at_once = share * pairs_at_once();
  contact_stage.start(use_of_last_contacts(at_once >= pairs), last, now);
  std::optional<NormalVelocities> velocities;
  if (has_velocities() && !refreshes()) velocities.emplace(bodies);
  for (size_t begin = 0; begin == 0 || begin < pairs; begin += at_once) {
    const size_t end = std::min(begin + at_once, pairs);
    const size_t first_row = plan.rows_before(begin);
    const PairRange range{begin, end, first_row, plan.rows_before(end) - first_row};
    run(Stage::narrowphase, [&] {
      test_pairs(plan.pairs_to_test(now.pairs), range,
                 directions_of_tests ? directions_of_tests + first_row : nullptr, lists);
      if (drifts) measure_gaps(plan.pairs_to_test(now.pairs), range);
    });
    const ContactStage::Input found = {plan, last, results, bodies, settings};
    run(Stage::results, [&] { contact_stage.add_results(range, found, now); });
    if (drifts) {
      run(Stage::pairs,
          [&] { hold.set_terms(range, plan, gaps, drift, last, settings.parallelism, now); });
    }
    if (has_contacts(settings.detail)) {
      write_contacts(range, found, velocities ? &*velocities : nullptr);
    }
  }
  if (lists) {
    report.by_shells = shells.keep();
  } else {
    shells.forget();
  }
  if (remembers) {
    run(Stage::narrowphase, [&] { directions.keep(plan, settings.parallelism, now); });
  } else {
    now.direction.clear();
  }
}

// Contacts get their velocities while they are in the cache.
void World::State::write_contacts(const PairRange& range, const ContactStage::Input& found,
                                  const NormalVelocities* velocities) {
  double part = 0;  // of the velocities
  const Time time =
      time_of([&] { part = contact_stage.write_contacts(range, found, velocities, now); });
  count(Stage::results, time.part(1 - part));
  if (velocities) count(Stage::velocities, time.part(part));
}

// Tests the rows of a range; `all`: the pairs of all rows.
void World::State::test_pairs(std::span<const Pair> all, const PairRange& range,
                              uint32_t* direction, ShellLists* lists) {
  const Collidables view = bodies.view();
  const bool composites = has_composites();
  const std::span<const Pair> pairs = all.subspan(range.first_row, range.rows);
  bodies.count_by_rung(pairs, report.by_rung);
  report.by_models =
      std::accumulate(std::begin(report.by_rung), std::end(report.by_rung), size_t{0});
  FewOf<ColumnRole, 2> wanted;
  if (composites) wanted.push_back(ColumnRole::sub_shape);
  if (has_identities()) wanted.push_back(ColumnRole::name);
  const ResultColumns& columns =
      results.prepare(range, settings.detail, {wanted.begin(), wanted.size()});
  CollideOptions options = {.frame = WitnessFrame::body,
                            .parallelism = settings.parallelism,
                            .measured = Measured::overlapping,
                            .accuracy = {settings.accuracy.tier, tolerance_of_tests()},
                            .region_limits = settings.region_limits};
  if (has_distances()) {
    options.contact_distances = results.prepare_distances(pairs, distances(), settings.parallelism);
  }
  collide_pairs({.bodies = view,
                 .pairs = pairs,
                 .has_composites = composites,
                 .direction = direction,
                 .shells = lists,
                 .first_row = range.first_row,
                 .extra = results.extra_of(settings.detail)},
                settings.detail, columns, options);
  if (has_margin() || looks_ahead() || has_distances()) {
    results.reject_apart(pairs, present_bounds(), settings.parallelism);
  }
  if (has_distances()) results.find_near(pairs, wide_present_bounds(), settings.parallelism);
}

void World::State::find_impacts() {
  const Collidables shapes = bodies.view();
  const BoundsView swept = swept_bounds.view();
  const LookAhead ahead{settings, bodies, shapes, sweeps, swept, now};
  impacts.run(ahead);
  speculative.run(ahead);
}

// Drops what the last step found ahead. Keeps memory, since bodies may be fast and slow in turns.
void World::State::forget_ahead() {
  halfspaces.stay();
  impacts.clear();
  speculative.clear();
}

// Runs in steps without a body with a detection: frees what looking ahead has used.
void World::State::stop_looking_ahead() {
  if (sweeps.bytes() == 0) return;
  forget_ahead();
  sweeps = {};
  swept_bounds = {};
  sieve = {};
  impacts = {};
  speculative = {};
}

}  // namespace carom

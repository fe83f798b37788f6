// A step that holds on to results within Accuracy::tolerance does this otherwise.
#include <algorithm>

#include "world/world_state.h"

namespace carom {

// Whether this step holds on to results within the tolerance. It takes two steps to begin. After
// the first step of a world, which builds everything anyway, a few of many bodies are looked at
// before that, so that a world in which everything flies pays for no more.
bool World::State::may_drift() {
  if (!can_drift() || !hold_watch.starts_step()) {
    drift.forget();
    paces.forget();
    return false;
  }
  if (drifts) return true;
  constexpr float kFewest = 0.25f;
  if (drift.is_prepared()) {
    float slow = 0;
    run(Stage::changes, [&] { slow = drift.measure_paces(bodies, settings.parallelism); });
    if (slow >= kFewest) return true;
    drift.forget();
    hold_watch.pause();
    return false;
  }
  const float tolerance = settings.accuracy.tolerance;
  const bool looks_at_all = bodies.rows() < PaceSample::kFewBodies || report.step == 1;
  if (looks_at_all || paces.is_taken()) {
    const bool is_slow = looks_at_all || paces.slow_share(bodies, tolerance) >= kFewest;
    paces.forget();
    if (is_slow) {
      run(Stage::changes, [&] { drift.prepare(bodies, tolerance); });
    } else {
      hold_watch.pause();
    }
  } else {
    paces.take(bodies);
  }
  return false;
}

// The same where all results hold within the tolerance.
bool World::State::is_still_within_tolerance() {
  stop_looking_ahead();
  run(Stage::changes, [&] {
    changes.update_shapes(bodies, settings.parallelism);
    drift.update(bodies, changes, settings.accuracy.tolerance, settings.parallelism);
  });
  size_t due = 0;
  run(Stage::pairs, [&] { due = hold.find_due(now, drift, settings.parallelism); });
  return due == 0 && keeps_pairs();
}

// Whether this step has the pairs of the last one, for certain.
bool World::State::keeps_pairs() const {
  return drifts && drift.outgrown().empty() && has_same_filters() && !bodies.any_touched();
}

// How far results may be off when they are found. Those that are held need their tolerance for the
// motion.
float World::State::tolerance_of_tests() const {
  return carries() && !drifts ? bodies.spare_tolerance() : 0;
}

// The lists of shells, if this step is to have any: their places are those of all pairs, so hulls
// must not be few among the bodies. The pairs must have their directions.
ShellLists* World::State::prepare_shells() {
  constexpr size_t kFewest = 4;  // fewer than one in so many are few
  if (tolerance_of_tests() <= 0 || kFewest * bodies.count_of(ShapeKind::hull) < bodies.size() ||
      !shells.starts_step()) {
    return nullptr;
  }
  return &shells.prepare(plan.tested());
}

// Tests the pairs that are due and are not tested otherwise.
void World::State::refresh_due() {
  const RefreshStage::Input found = {
      results, gaps, bodies, drift, settings.detail, has_identities(), settings.parallelism};
  run(Stage::pairs, [&] { refresh.start(hold.due_pairs(), now, settings.parallelism); });
  const size_t at_once = pairs_at_once(), due = refresh.renewed();
  for (size_t begin = 0; begin < due; begin += at_once) {
    const PairRange range{0, 0, begin, std::min(at_once, due - begin)};
    run(Stage::narrowphase, [&] {
      test_pairs(refresh.pairs(), range, nullptr, nullptr);
      measure_gaps(refresh.pairs(), range);
    });
    run(Stage::results, [&] { refresh.take(range, found, now); });
  }
  run(Stage::results, [&] { contact_stage.add_overlaps(refresh.finish(found, now)); });
}

void World::State::measure_gaps(std::span<const Pair> all, const PairRange& range) {
  gaps.measure(all, range, results, bodies.view(), distances(), drift, settings.parallelism);
}

}  // namespace carom

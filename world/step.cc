#include <algorithm>
#include <chrono>
#include <limits>

#include "carom/kernel/bounds.h"
#include "kernel/float_environment.h"
#include "narrowphase/collide_pairs.h"
#include "world/world_state.h"

namespace carom {

template <class Work>
void World::State::run(Stage stage, const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  const auto duration = std::chrono::steady_clock::now() - start;
  const auto index = static_cast<size_t>(stage);
  report.stages_run |= 1u << index;
  report.stage_ns[index] = static_cast<uint64_t>(std::chrono::nanoseconds(duration).count());
}

const StepReport& World::State::step() {
  const FloatEnvironment environment;
  const Parallelism parallelism = settings.parallelism;
  report = {.step = report.step + 1, .search = {}};

  if (carries()) run(Stage::changes, [&] { changes.update(bodies, parallelism); });
  const bool still = carries() && report.step > 1 && changes.all_unchanged();
  if (still) {
    plan.carry_all();
  } else {
    if (carries() || has_events()) std::swap(last, now);
    run(Stage::bounds, [&] { find_bounds(); });
    run(Stage::broadphase, [&] { find_pairs(); });
    if (has_narrowphase()) {
      run(Stage::pairs, [&] { plan_tests(); });
      run(Stage::narrowphase, [&] { test_pairs(); });
      run(Stage::results, [&] {
        contact_stage.run(plan, last, results, bodies, settings.detail, parallelism, now);
      });
    }
  }
  if (settings.detail == Detail::contact && bodies.has_velocities()) {
    run(Stage::velocities,
        [&] { set_normal_velocities(bodies.linear_velocities(), parallelism, now.contacts); });
  }
  if (has_events()) {
    run(Stage::events, [&] {
      event_stage.run(still ? now : last, now, bodies, parallelism, events);
      event_stage.remember(bodies);
    });
  }
  bodies.clear_touched();

  report.bodies = bodies.size();
  report.quarantined = quarantined.size();
  report.pairs = now.pairs.size();
  report.tested = has_narrowphase() ? plan.tested() : 0;
  report.kept = has_narrowphase() ? report.pairs - report.tested : 0;
  report.overlaps = has_narrowphase() ? contact_stage.overlaps() : 0;
  report.contacts = now.contacts.size();
  report.search = search;
  return report;
}

BoundsView World::State::bounds_view() const {
  return {{bounds[0].data(), bounds[1].data(), bounds[2].data()},
          {bounds[3].data(), bounds[4].data(), bounds[5].data()},
          bounds[0].size()};
}

void World::State::find_bounds() {
  for (std::vector<float>& column : bounds) resize_and_give_back(column, bodies.rows());
  const size_t invalid = compute_bounds(bodies.view(),
                                        {{bounds[0].data(), bounds[1].data(), bounds[2].data()},
                                         {bounds[3].data(), bounds[4].data(), bounds[5].data()}},
                                        settings.parallelism);
  // Rows without a body hold whatever was last written there.
  for (const uint32_t index : bodies.free_indices()) {
    for (size_t axis = 0; axis < 3; ++axis) {
      bounds[axis][index] = std::numeric_limits<float>::infinity();
      bounds[3 + axis][index] = -std::numeric_limits<float>::infinity();
    }
  }
  quarantined.clear();
  if (invalid > 0) find_quarantined();
}

void World::State::find_quarantined() {
  for (uint32_t i = 0; i < bodies.rows(); ++i) {
    const bool empty = bounds[0][i] > bounds[3][i];
    if (empty && bodies.is_alive(i)) quarantined.push_back(bodies.id_of(i));
  }
}

void World::State::find_pairs() {
  if (!settings.carry_results) finder.forget();
  finder.set_most_pairs(settings.most_pairs);
  search = finder.find(bounds_view(), bodies.filter(), now.pairs, settings.broadphase,
                       settings.parallelism);
}

void World::State::plan_tests() {
  if (carries()) {
    plan.match(last, now.pairs, changes, settings.parallelism);
  } else {
    plan.test_all(now.pairs.size());
  }
}

void World::State::test_pairs() {
  collide_pairs(bodies.view(), plan.pairs_to_test(now.pairs), settings.detail,
                results.prepare(plan.tested(), settings.detail), settings.parallelism);
}

size_t World::State::bytes() const {
  size_t sum = bodies.bytes() + changes.bytes() + finder.bytes() + now.bytes() + last.bytes() +
               plan.bytes() + results.bytes() + contact_stage.bytes() + event_stage.bytes() +
               events.capacity() * sizeof(Event) + quarantined.capacity() * sizeof(BodyId);
  for (const std::vector<float>& column : bounds) sum += column.capacity() * sizeof(float);
  return sum;
}

}  // namespace carom

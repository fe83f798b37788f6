// What a world consists of; its step reads like the flow of data.
#pragma once

#include <vector>

#include "carom/world/world.h"
#include "world/body_store.h"
#include "world/change_tracker.h"
#include "world/contact_stage.h"
#include "world/event_stage.h"
#include "world/pair_history.h"

namespace carom {

struct World::State {
  explicit State(const WorldSettings& chosen) : settings(chosen), bodies(chosen.positions) {}

  const StepReport& step();
  BoundsView bounds_view() const;
  size_t bytes() const;

  WorldSettings settings;
  BodyStore bodies;
  StepReport report;

  PairHistory now;
  std::vector<Event> events;
  std::vector<BodyId> quarantined;

 private:
  bool has_narrowphase() const { return settings.detail != Detail::pairs; }
  bool has_events() const { return settings.events && has_narrowphase(); }
  bool carries() const { return settings.carry_results && has_narrowphase(); }

  template <class Work>
  void run(Stage stage, const Work& work);
  void find_bounds();
  void find_quarantined();
  void find_pairs();
  void plan_tests();
  void test_pairs();

  ChangeTracker changes;
  std::array<std::vector<float>, 6> bounds;
  PairFinder finder;
  PairSearch search;
  PairHistory last;
  CarryPlan plan;
  ResultBuffer results;
  ContactStage contact_stage;
  EventStage event_stage;
};

}  // namespace carom

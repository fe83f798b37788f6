#include "world/results/event_stage.h"

#include <algorithm>

namespace carom {
namespace {

bool is_of_sensor(uint32_t contact) { return contact == PairHistory::kSensor; }

// Undecided pairs have no events.
bool overlaps(const PairHistory& history, size_t i) { return history.overlaps[i] == 1; }

Event overlap_of(EventKind kind, const PairHistory& now, size_t i, const BodyStore& bodies) {
  const Pair pair = now.pairs[i];
  const bool sensor = is_of_sensor(now.contact[i]);
  return {.a = bodies.id_of(pair.a),
          .b = bodies.id_of(pair.b),
          .contact = sensor ? kNoContact : now.contact[i],
          .kind = kind,
          .sensor = sensor};
}

// What became of a body of the last step, as bits of Gone for body A.
uint8_t fate_of(BodyId id, const EventStage::Input& input) {
  if (!input.bodies.contains(id)) return kRemovedA;
  const auto& list = input.quarantined;
  return std::binary_search(list.begin(), list.end(), id) ? kQuarantinedA : 0;
}

}  // namespace

Event EventStage::end_of(size_t pair, const Input& input) const {
  const BodyId a = last_id(input.last.pairs[pair].a);
  const BodyId b = last_id(input.last.pairs[pair].b);
  const int gone = fate_of(a, input) | fate_of(b, input) << 1;
  return {.a = a,
          .b = b,
          .contact = kNoContact,
          .kind = EventKind::end,
          .sensor = is_of_sensor(input.last.contact[pair]),
          .gone = static_cast<uint8_t>(gone)};
}

void EventStage::run(const Input& input, Parallelism parallelism, std::vector<Event>& events) {
  const PairHistory& last = input.last;
  const PairHistory& now = input.now;
  const BodyStore& bodies = input.bodies;
  lists_.reset(merge_block_count(now.pairs.size()));
  const auto merge = [&](size_t block, size_t begin, size_t stop) {
    std::vector<Event>& out = lists_[block];
    const auto gone = [&](size_t before) {
      if (overlaps(last, before)) out.push_back(end_of(before, input));
    };
    const auto there = [&](size_t i, size_t before) {
      const Pair pair = now.pairs[i];
      const bool overlapped = before != kNotThere && overlaps(last, before);
      const bool same = is_same_body(pair.a, bodies) && is_same_body(pair.b, bodies);
      const bool persists = overlapped && overlaps(now, i) && same;
      if (overlapped && !persists) out.push_back(end_of(before, input));
      if (!overlaps(now, i) || (persists && !input.wants_persist)) return;
      out.push_back(overlap_of(persists ? EventKind::persist : EventKind::begin, now, i, bodies));
    };
    merge_block(last.pairs, now.pairs, begin, stop, gone, there);
  };
  for_each_merge_block(now.pairs.size(), parallelism, merge);
  lists_.concatenate(events, parallelism);
}

void EventStage::add_impacts(std::span<const Impact> impacts, const BodyStore& bodies,
                             std::vector<Event>& events) {
  for (size_t i = 0; i < impacts.size(); ++i) {
    events.push_back({.a = bodies.id_of(impacts[i].a),
                      .b = bodies.id_of(impacts[i].b),
                      .contact = static_cast<uint32_t>(i),
                      .kind = EventKind::impact,
                      .sensor = impacts[i].sensor});
  }
}

void EventStage::remember(const BodyStore& bodies) {
  resize_and_give_back(generation_, bodies.rows());  // new rows are touched
  for (const uint32_t index : bodies.touched_indices()) {
    if (index < generation_.size()) generation_[index] = bodies.id_of(index).generation;
  }
}

}  // namespace carom

#include "world/results/event_stage.h"

#include <algorithm>

namespace carom {
namespace {

bool is_of_sensor(uint32_t contact) { return contact == PairHistory::kSensor; }

// Undecided pairs have no events.
bool overlaps(const PairHistory& history, size_t i) { return history.overlaps[i] == 1; }

// What became of a body of the last step, as bits of Gone for body A.
uint8_t fate_of(BodyId id, const EventStage::Input& input) {
  if (!input.bodies.contains(id)) return kRemovedA;
  const auto& list = input.quarantined;
  return std::binary_search(list.begin(), list.end(), id) ? kQuarantinedA : 0;
}

}  // namespace

// Which pairs have events cannot be predicted: overlaps come and go. So this part has no branches
// on them, and the events are made afterwards.
void EventStage::find_changes(const Input& input, Parallelism parallelism) {
  const PairHistory& last = input.last;
  const PairHistory& now = input.now;
  const BodyStore& bodies = input.bodies;
  // Whether all indices have the bodies of the last step. It saves looking at two bodies a pair.
  const bool same_bodies = !bodies.any_touched();
  const auto are_same_bodies = [&](Pair pair) {
    return is_same_body(pair.a, bodies) && is_same_body(pair.b, bodies);
  };
  lists_.reset(merge_block_count(now.pairs.size()));
  const auto merge = [&](size_t block, size_t begin, size_t stop) {
    const MergeRange range = matching_range(last.pairs, now.pairs, begin, stop);
    std::vector<Change>& list = lists_[block];
    // At most so many, and one that is written and does not count.
    list.resize(2 * (stop - begin) + (range.end - range.begin) + 1);
    size_t count = 0;
    const auto add = [&](bool happened, size_t pair, EventKind kind) {
      list[count] = {static_cast<uint32_t>(pair), kind};
      count += happened;
    };
    size_t before = range.begin, i = begin;
    while (before < range.end && i < stop) {
      const uint64_t key_before = pair_key(last.pairs[before]), key = pair_key(now.pairs[i]);
      const bool was_there = key_before <= key, is_there = key <= key_before;
      const bool overlapped = was_there & overlaps(last, before);
      const bool overlapping = is_there & overlaps(now, i);
      const bool persists =
          (overlapped & overlapping) && (same_bodies || are_same_bodies(now.pairs[i]));
      add(overlapped & !persists, before, EventKind::end);
      add(overlapping & (!persists | input.wants_persist), i,
          persists ? EventKind::persist : EventKind::begin);
      before += was_there;
      i += is_there;
    }
    for (; before < range.end; ++before) add(overlaps(last, before), before, EventKind::end);
    for (; i < stop; ++i) add(overlaps(now, i), i, EventKind::begin);
    list.resize(count);
  };
  for_each_merge_block(now.pairs.size(), parallelism, merge);
}

void EventStage::run(const Input& input, Parallelism parallelism, RawVector<Event>& events) {
  find_changes(input, parallelism);
  events.resize(lists_.place());
  for_each_block(lists_.blocks(), 1, parallelism, [&](size_t block, size_t, size_t) {
    make_events(lists_[block], input, events.data() + lists_.first(block));
  });
}

void EventStage::make_events(std::span<const Change> changes, const Input& input,
                             Event* events) const {
  constexpr size_t kAhead = 16;
  const bool all_stayed = !input.bodies.any_touched() && input.quarantined.empty();
  // One array for both steps if they have the same bodies: less memory to wait for.
  const uint32_t* const before = generation_.data();
  const uint32_t* const after = all_stayed ? before : input.bodies.generations().data();
  const auto history = [&](const Change& change) -> const PairHistory& {
    return change.kind == EventKind::end ? input.last : input.now;
  };
  for (size_t k = 0; k < changes.size(); ++k) {
    const Change& ahead = changes[std::min(k + kAhead, changes.size() - 1)];
    __builtin_prefetch(after + history(ahead).pairs[ahead.pair].b);
    const Change& change = changes[k];
    const PairHistory& step = history(change);
    const bool ends = change.kind == EventKind::end;
    const uint32_t* const generation = ends ? before : after;
    const Pair pair = step.pairs[change.pair];
    const BodyId a = {pair.a, generation[pair.a]}, b = {pair.b, generation[pair.b]};
    const uint32_t contact = step.contact[change.pair];
    const bool sensor = is_of_sensor(contact);
    const int gone = !ends || all_stayed ? 0 : fate_of(a, input) | fate_of(b, input) << 1;
    events[k] = {.a = a,
                 .b = b,
                 .contact = ends || sensor ? kNoContact : contact,
                 .kind = change.kind,
                 .sensor = sensor,
                 .gone = static_cast<uint8_t>(gone)};
  }
}

void EventStage::add_impacts(std::span<const Impact> impacts, const BodyStore& bodies,
                             RawVector<Event>& events) {
  for (size_t i = 0; i < impacts.size(); ++i) {
    events.push_back({.a = bodies.id_of(impacts[i].a),
                      .b = bodies.id_of(impacts[i].b),
                      .contact = static_cast<uint32_t>(i),
                      .kind = EventKind::impact,
                      .sensor = impacts[i].sensor});
  }
}

void EventStage::remember(const BodyStore& bodies) {
  generation_.resize(bodies.rows());  // new rows are touched
  for (const uint32_t index : bodies.touched_indices()) {
    if (index < generation_.size()) generation_[index] = bodies.id_of(index).generation;
  }
}

}  // namespace carom

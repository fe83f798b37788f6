#include "world/results/event_stage.h"

namespace carom {
namespace {

Event make_event(EventKind kind, BodyId a, BodyId b, uint32_t contact) {
  const bool sensor = contact == PairHistory::kSensor;
  const bool has_contact = kind != EventKind::end && !sensor;
  return {.a = a,
          .b = b,
          .contact = has_contact ? contact : kNoContact,
          .kind = kind,
          .sensor = sensor};
}

// Undecided pairs have no events.
bool overlaps(const PairHistory& history, size_t i) { return history.overlaps[i] == 1; }

}  // namespace

void EventStage::run(const PairHistory& last, const PairHistory& now, const BodyStore& bodies,
                     Parallelism parallelism, std::vector<Event>& events) {
  const auto end = [&](std::vector<Event>& out, size_t i) {
    const Pair pair = last.pairs[i];
    out.push_back(make_event(EventKind::end, last_id(pair.a), last_id(pair.b), last.contact[i]));
  };
  const auto overlap = [&](std::vector<Event>& out, EventKind kind, size_t i) {
    const Pair pair = now.pairs[i];
    out.push_back(make_event(kind, bodies.id_of(pair.a), bodies.id_of(pair.b), now.contact[i]));
  };
  const auto is_same_body = [&](uint32_t index) {
    return index < generation_.size() && last_id(index) == bodies.id_of(index);
  };

  lists_.reset(merge_block_count(now.pairs.size()));
  const auto merge = [&](size_t block, size_t begin, size_t stop) {
    std::vector<Event>& out = lists_[block];
    const auto gone = [&](size_t before) {
      if (overlaps(last, before)) end(out, before);
    };
    const auto there = [&](size_t i, size_t before) {
      const Pair pair = now.pairs[i];
      const bool overlapped = before != kNotThere && overlaps(last, before);
      const bool same = is_same_body(pair.a) && is_same_body(pair.b);
      if (overlapped && !(overlaps(now, i) && same)) end(out, before);
      if (overlaps(now, i)) {
        overlap(out, overlapped && same ? EventKind::persist : EventKind::begin, i);
      }
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

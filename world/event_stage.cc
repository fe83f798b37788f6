#include "world/event_stage.h"

#include <algorithm>

#include "world/columns.h"

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

  // A block of current pairs and the last step's pairs between them; one block, at least.
  const auto merge = [&](size_t block, size_t begin, size_t stop) {
    std::vector<Event>& out = lists_[block];
    const MergeRange range = matching_range(last.pairs, now.pairs, begin, stop);
    size_t before = range.begin;
    for (size_t i = begin; i < stop; ++i) {
      const Pair pair = now.pairs[i];
      for (; before < range.end && last.pairs[before] < pair; ++before) {
        if (last.overlaps[before]) end(out, before);
      }
      const bool known = before < range.end && last.pairs[before] == pair;
      const bool overlapped = known && last.overlaps[before];
      const bool same = is_same_body(pair.a) && is_same_body(pair.b);
      if (overlapped && !(now.overlaps[i] && same)) end(out, before);
      if (now.overlaps[i]) {
        overlap(out, overlapped && same ? EventKind::persist : EventKind::begin, i);
      }
      before += known;
    }
    for (; before < range.end; ++before) {
      if (last.overlaps[before]) end(out, before);
    }
  };
  const size_t blocks = block_count(now.pairs.size(), kPairsPerMergeBlock);
  lists_.reset(std::max<size_t>(1, blocks));
  if (blocks == 0) merge(0, 0, 0);
  for_each_block(now.pairs.size(), kPairsPerMergeBlock, parallelism, merge);
  lists_.concatenate(events, parallelism);
}

void EventStage::remember(const BodyStore& bodies) {
  resize_and_give_back(generation_, bodies.rows());  // new rows are touched
  for (const uint32_t index : bodies.touched_indices()) {
    if (index < generation_.size()) generation_[index] = bodies.id_of(index).generation;
  }
}

}  // namespace carom

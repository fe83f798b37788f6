#include "world/results/event_stage.h"

#include <algorithm>
#include <utility>

namespace carom {
namespace {

// What became of a body of the last step, as bits of Gone for body A.
uint8_t fate_of(BodyId id, const EventStage::Input& input) {
  if (!input.bodies.contains(id)) return kRemovedA;
  const auto& list = input.quarantined;
  return std::binary_search(list.begin(), list.end(), id) ? kQuarantinedA : 0;
}

// Says of ends which bodies are gone.
void tell_fates(std::span<Event> events, const EventStage::Input& input) {
  for (Event& event : events) {
    if (event.kind != EventKind::end) continue;
    event.gone = static_cast<uint8_t>(fate_of(event.a, input) | fate_of(event.b, input) << 1);
  }
}

}  // namespace

size_t EventStage::Scratch::bytes() const {
  return bytes_of(unnamed) + bytes_of(events) + last.bytes() + now.bytes();
}

// Room for a block and the pairs of the last step that belong to it, which are seldom many more.
void EventStage::Scratch::make_room() {
  constexpr size_t kUsual = kPairsPerMergeBlock + kPairsPerMergeBlock / 8;
  last.reserve(kUsual);
  now.reserve(kUsual);
  events.reserve(2 * kUsual);
}

void EventStage::run(const Input& input, Parallelism parallelism, RawVector<Event>& events) {
  events.clear();
  const size_t blocks = merge_block_count(input.now.pairs.size());
  if (uses_threads(unless_few(parallelism, input.now.pairs.size()))) {
    for (size_t first = 0; first < blocks; first += kBlocksAtOnce) {
      add_blocks(input, first, std::min(first + kBlocksAtOnce, blocks), parallelism, events);
    }
  } else {
    for (size_t block = 0; block < blocks; ++block) {
      reserve_at_rate(events, events.size() + 2 * kPairsPerMergeBlock, block, blocks);
      add_block(input, block, scratch_[0], events);
    }
  }
}

// Adds the events of a block of this step's pairs and of the last step's that belong to it.
void EventStage::add_block(const Input& input, size_t block, Scratch& scratch,
                           RawVector<Event>& events) const {
  read_block(input, block, scratch);
  const size_t first = events.size();
  // Until a body is removed every index keeps its body, of generation 0.
  const bool any_removed = input.bodies.any_removed();
  const bool same_bodies = !any_removed || !input.bodies.any_touched();
  if (same_bodies) {
    const Persisting persisting = input.wants_persist ? Persisting::wanted : Persisting::dropped;
    merge_overlaps(scratch.last, scratch.now, persisting, events);
    if (any_removed) name(std::span(events).subspan(first), input.bodies.generations());
  } else {
    scratch.unnamed.clear();
    merge_overlaps(scratch.last, scratch.now, Persisting::apart, scratch.unnamed);
    add_named(input, scratch.unnamed, events);
  }
  if (!same_bodies || !input.quarantined.empty()) {
    tell_fates(std::span(events).subspan(first), input);
  }
}

// Reads the overlaps of a block in both steps. Pairs that are carried make no event unless those
// that persist are wanted.
void EventStage::read_block(const Input& input, size_t block, Scratch& scratch) {
  const size_t begin = block * kPairsPerMergeBlock;
  const size_t end = std::min(begin + kPairsPerMergeBlock, input.now.pairs.size());
  const MergeRange range = matching_range(input.last.pairs, input.now.pairs, begin, end);
  const PairHistory &last = input.last, &now = input.now;
  const CarryPlan* const plan = input.plan;
  scratch.last.start(range.end - range.begin);
  scratch.now.start(end - begin);
  // Many short runs take longer than all pairs.
  const bool skips =
      plan && !input.wants_persist &&
      (input.skips_carried || plan->runs_of(block).size() <= kPairsPerMergeBlock / 16);
  if (skips) {
    size_t before = range.begin;
    const auto open = [&](size_t first, size_t stop, size_t) {
      scratch.now.add(now, first, stop, EventKind::begin);
    };
    const auto carried = [&](const CarriedRun& run) {
      if (before < run.before) scratch.last.add(last, before, run.before, EventKind::end);
      before = run.before + (run.end - run.begin);
    };
    plan->for_each_stretch(begin, end, open, carried);
    scratch.last.add(last, before, range.end, EventKind::end);
  } else {
    scratch.last.add(last, range.begin, range.end, EventKind::end);
    scratch.now.add(now, begin, end, EventKind::begin);
  }
  scratch.last.finish();
  scratch.now.finish();
}

// Does so for some blocks side by side, each to a list of its own.
void EventStage::add_blocks(const Input& input, size_t first, size_t end, Parallelism parallelism,
                            RawVector<Event>& events) {
  for_each_block(end - first, 1, parallelism, [&](size_t i, size_t, size_t) {
    Scratch& scratch = scratch_[i];
    scratch.make_room();
    scratch.events.clear();
    add_block(input, first + i, scratch, scratch.events);
  });
  std::array<size_t, kBlocksAtOnce> place;
  size_t next = events.size();
  for (size_t i = 0; i < end - first; ++i) {
    place[i] = std::exchange(next, next + scratch_[i].events.size());
  }
  reserve_at_rate(events, next, first, merge_block_count(input.now.pairs.size()));
  events.resize(next);
  for_each_block(end - first, 1, parallelism, [&](size_t i, size_t, size_t) {
    std::ranges::copy(scratch_[i].events, events.begin() + place[i]);
  });
}

// Sets the generations of the bodies of events.
void EventStage::name(std::span<Event> events, std::span<const uint32_t> generations) {
  constexpr size_t kAhead = 16;
  for (size_t k = 0; k < events.size(); ++k) {
    __builtin_prefetch(&generations[events[std::min(k + kAhead, events.size() - 1)].b.index]);
    events[k].a.generation = generations[events[k].a.index];
    events[k].b.generation = generations[events[k].b.index];
  }
}

// Adds events with the generations of their bodies. `unnamed`: ends and begins. An end and a begin
// of the same bodies are one event that persists.
void EventStage::add_named(const Input& input, std::span<const Event> unnamed,
                           RawVector<Event>& events) const {
  const std::span<const uint32_t> generations = input.bodies.generations();
  const auto before = [this](Event event) {
    event.a.generation = last_generation(event.a.index);
    event.b.generation = last_generation(event.b.index);
    return event;
  };
  const auto now = [&](Event event) {
    event.a.generation = generations[event.a.index];
    event.b.generation = generations[event.b.index];
    return event;
  };
  for (size_t k = 0; k < unnamed.size(); ++k) {
    if (unnamed[k].kind == EventKind::begin) {
      events.push_back(now(unnamed[k]));
      continue;
    }
    const Event end = before(unnamed[k]);
    // Bodies of an end may have no generation any more.
    const bool begins = k + 1 < unnamed.size() && unnamed[k + 1].kind == EventKind::begin;
    Event next = begins ? now(unnamed[k + 1]) : end;
    const bool persists = begins && next.a == end.a && next.b == end.b;
    if (!persists) {
      events.push_back(end);
      continue;
    }
    next.kind = EventKind::persist;
    if (input.wants_persist) events.push_back(next);
    ++k;
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
  if (!bodies.any_removed()) return;
  generation_.resize(bodies.rows());  // new rows are touched
  for (const uint32_t index : bodies.touched_indices()) {
    if (index < generation_.size()) generation_[index] = bodies.id_of(index).generation;
  }
}

void EventStage::give_back() {
  carom::give_back(generation_);
  give_back_scratch(scratch_);
}

size_t EventStage::bytes() const {
  size_t sum = bytes_of(generation_);
  for (const Scratch& scratch : scratch_) sum += scratch.bytes();
  return sum;
}

}  // namespace carom

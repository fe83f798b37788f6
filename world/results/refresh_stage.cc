#include "world/results/refresh_stage.h"

#include <algorithm>
#include <array>

#include "base/parallel.h"
#include "world/results/contact_rows.h"
#include "world/store/columns.h"

namespace carom {
namespace {

// The place of the first contact at or behind a pair.
size_t place_at(const PairHistory& now, size_t pair) {
  while (pair < now.pairs.size() && !now.has_contact(pair)) ++pair;
  return pair < now.pairs.size() ? now.contact[pair] : now.contacts.size();
}

uint64_t key_of(const Event& event) { return pair_key({event.a.index, event.b.index}); }

}  // namespace

void RefreshStage::start(std::span<const uint32_t> due, const PairHistory& now,
                         Parallelism parallelism) {
  due_ = due;
  changes_.clear();
  pairs_.resize(due.size());
  for_each_block(due.size(), kPairsPerMergeBlock, parallelism,
                 [&](size_t, size_t begin, size_t end) {
                   for (size_t k = begin; k < end; ++k) pairs_[k] = now.pairs[due[k]];
                 });
}

void RefreshStage::take(const PairRange& range, const Input& input, PairHistory& now) {
  changes_of_block_.reset(block_count(range.rows, kPairsPerMergeBlock));
  for_each_block(range.rows, kPairsPerMergeBlock, input.parallelism,
                 [&](size_t block, size_t begin, size_t end) {
                   take_rows(range.first_row + begin, range.first_row + end, input,
                             changes_of_block_[block], now);
                 });
  changes_of_block_.concatenate(found_, input.parallelism);
  changes_.insert(changes_.end(), found_.begin(), found_.end());
}

void RefreshStage::take_rows(size_t begin, size_t end, const Input& input,
                             std::vector<Change>& changes, PairHistory& now) const {
  const auto& [results, gaps, bodies, drift, detail, identities, parallelism] = input;
  const bool lists = has_contacts(detail), knows_sensors = bodies.knows_sensors();
  std::array<uint32_t, kPairsPerMergeBlock> places;  // of contacts to overwrite
  for (size_t row = begin; row < end; ++row) {
    const uint32_t i = due_[row];
    const Pair pair = pairs_[row];
    now.holds_until[i] = drift.holds_until(pair, gaps.gap(row));
    const uint8_t decision = results.overlap(row);
    const bool overlap = decision == 1;
    const bool sensor = knows_sensors && (bodies.is_sensor(pair.a) || bodies.is_sensor(pair.b));
    const bool listed = lists && (overlap || results.is_near(row)) && !sensor;
    const bool is_same = decision == now.overlaps[i] && listed == now.has_contact(i);
    places[row - begin] = is_same ? now.contact[i] : PairHistory::kNone;
    if (is_same) continue;
    const uint32_t without = overlap && sensor ? PairHistory::kSensor : PairHistory::kNone;
    Change change{.pair = i,
                  .contact = listed ? 0 : without,
                  .overlap = decision,
                  .overlap_before = now.overlaps[i],
                  .new_contact = {},
                  .new_points = {},
                  .new_names = {}};
    if (listed) {
      change.new_contact = results.contact(row, pair);
      if (has_manifolds(detail)) change.new_points = results.manifold(row);
      if (identities) change.new_names = results.names(row);
    }
    changes.push_back(change);
  }
  if (!lists) return;
  const std::span<uint32_t> of_rows = std::span(places).first(end - begin);
  overwrite_contact_rows(
      results.rows_of(std::span(pairs_).subspan(begin, end - begin), begin, of_rows), now.contacts);
  if (!has_manifolds(detail) && !identities) return;
  for (size_t row = begin; row < end; ++row) {
    const uint32_t place = of_rows[row - begin];
    if (!PairHistory::is_place(place)) continue;
    if (has_manifolds(detail)) now.manifolds[place] = results.manifold(row);
    if (identities) now.identities[place].names = results.names(row);
  }
}

ptrdiff_t RefreshStage::finish(const Input& input, PairHistory& now) {
  move_contacts(input, now);
  ptrdiff_t more = 0;
  for (const Change& change : changes_) {
    now.overlaps[change.pair] = change.overlap;
    more += (change.overlap == 1) - (change.overlap_before == 1);
  }
  return more;
}

// Runs of contacts between changes move as one.
void RefreshStage::move_contacts(const Input& input, PairHistory& now) {
  moves_.clear();
  size_t pair = 0, from = 0, to = 0;  // where the run begins
  const auto end_run = [&](size_t end_pair, size_t end_place) {
    const auto shift = static_cast<uint32_t>(to - from);
    for (; shift != 0 && pair < end_pair; ++pair) {
      const uint32_t contact = now.contact[pair];
      now.contact[pair] = contact + (PairHistory::is_place(contact) ? shift : 0u);
    }
    if (end_place > from) moves_.push_back({from, to, end_place - from});
    to += end_place - from;
  };
  for (Change& change : changes_) {
    const size_t place = place_at(now, change.pair);
    const bool had = now.has_contact(change.pair), has = PairHistory::is_place(change.contact);
    end_run(change.pair, place);
    from = place + had;
    pair = size_t{change.pair} + 1;
    now.contact[change.pair] = has ? static_cast<uint32_t>(to) : change.contact;
    change.contact = now.contact[change.pair];
    to += has;
  }
  const size_t before = now.contacts.size();
  end_run(now.pairs.size(), before);
  const auto move = [&](auto& list, const auto& of_change) {
    list.resize(std::max(before, to));
    move_runs(moves_, list.data());
    list.resize(to);
    for (const Change& change : changes_) {
      if (PairHistory::is_place(change.contact)) list[change.contact] = of_change(change);
    }
  };
  if (changes_.empty()) return;
  move(now.contacts, [](const Change& change) { return change.new_contact; });
  if (has_manifolds(input.detail)) {
    move(now.manifolds, [](const Change& change) { return change.new_points; });
  }
  if (input.identities) {
    move(now.identities, [](const Change& change) {
      ContactIdentity identity;
      identity.names = change.new_names;
      return identity;
    });
  }
}

void RefreshStage::add_events(const BodyStore& bodies, const PairHistory& now,
                              RawVector<Event>& events) {
  own_events_.clear();
  for (const Change& change : changes_) {
    const bool overlap = change.overlap == 1;
    if (overlap == (change.overlap_before == 1)) continue;
    const Pair pair = now.pairs[change.pair];
    const bool has_contact = overlap && PairHistory::is_place(change.contact);
    own_events_.push_back({.a = bodies.id_of(pair.a),
                           .b = bodies.id_of(pair.b),
                           .contact = has_contact ? change.contact : kNoContact,
                           .kind = overlap ? EventKind::begin : EventKind::end,
                           .sensor = bodies.is_sensor(pair.a) || bodies.is_sensor(pair.b)});
  }
  others_.assign(events.begin(), events.end());
  events.resize(others_.size() + own_events_.size());
  std::ranges::merge(others_, own_events_, events.begin(), {}, key_of, key_of);
}

void RefreshStage::give_back() {
  give_back_scratch(pairs_, changes_of_block_, changes_, found_, moves_, own_events_, others_);
}

size_t RefreshStage::bytes() const {
  return bytes_of(pairs_) + changes_of_block_.bytes() + bytes_of(changes_) + bytes_of(found_) +
         moves_.capacity() * sizeof(ListMove) + bytes_of(own_events_) + bytes_of(others_);
}

}  // namespace carom

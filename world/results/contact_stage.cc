#include "world/results/contact_stage.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <utility>

#include "base/fetch_ahead.h"
#include "base/fresh_pages.h"
#include "base/parallel.h"
#include "carom/results/tier.h"
#include "world/results/contact_rows.h"

namespace carom {
namespace {

// Counts the results of a block of pairs.
struct Counts {
  size_t overlaps = 0, undecided = 0, contacts = 0, left_out = 0;
};

// Pairs [begin, end) that are not carried, and the number of the first one.
struct OpenPairs {
  size_t begin, end;
  size_t number;

  size_t size() const { return end - begin; }
};

// Stands in `contact` for a contact that is still to be written. Any index would do.
constexpr uint32_t kToBeWritten = 0;

// Whether the decisions on open pairs lie side by side in the results and say all.
bool decisions_say_all(const ContactStage::Input& input) {
  return input.plan.dropped() == 0 && input.settings.detail != Detail::regions &&
         !input.results.has_near() && !input.bodies.knows_sensors();
}

void read_decisions(const OpenPairs& open, const ContactStage::Input& input, PairHistory& now,
                    Counts& counts) {
  const uint32_t listed = has_contacts(input.settings.detail) ? 0xffffffffu : 0;
  const uint8_t* const decision = input.results.overlaps_from(open.number);
  uint32_t* const contact = now.contact.data() + open.begin;
  uint32_t overlapping = 0, unknown = 0;
  for (size_t i = 0; i < open.size(); ++i) {
    const bool overlap = decision[i] == 1;
    contact[i] = ~((0u - overlap) & listed);  // kToBeWritten or kNone
    overlapping += overlap;
    unknown += decision[i] == kUndecided;
  }
  std::copy_n(decision, open.size(), now.overlaps.data() + open.begin);
  counts.overlaps += overlapping;
  counts.undecided += unknown;
  counts.contacts += listed ? overlapping : 0;
}

// The same where there are sensors, near pairs, pairs that were dropped, or several contacts a
// pair.
void read_results(const OpenPairs& open, const ContactStage::Input& input, PairHistory& now,
                  Counts& counts) {
  const auto& [plan, last, results, bodies, settings] = input;
  // The entries of `contact` for a pair without a contact, with one, and for an overlap with a
  // sensor.
  const uint32_t kinds[] = {PairHistory::kNone,
                            has_contacts(settings.detail) ? kToBeWritten : PairHistory::kNone,
                            PairHistory::kSensor};
  const bool regions = settings.detail == Detail::regions;
  for (size_t i = open.begin, number = open.number; i < open.end; ++i, ++number) {
    const size_t row = plan.row(number);
    const uint8_t decision = results.overlap(row);
    // Whether a pair overlaps cannot be predicted, so there is no branch on it.
    const bool overlap = decision == 1;
    const bool touches = overlap | results.is_near(row);
    const Pair pair = now.pairs[i];
    const bool sensor = bodies.is_sensor(pair.a) || bodies.is_sensor(pair.b);
    const bool listed = touches & !sensor;
    now.overlaps[i] = decision;
    now.contact[i] = kinds[listed | (overlap & sensor) << 1];
    counts.overlaps += overlap;
    counts.undecided += decision == kUndecided;
    counts.contacts += listed;
    if (!regions || !listed) continue;
    counts.contacts += results.extra(row).size();
    counts.left_out += results.left_out(row);
  }
}

// The contacts of neighbouring pairs, which follow one another.
MergeRange contacts_of(const PairHistory& history, size_t begin, size_t end, bool regions) {
  while (begin < end && !history.has_contact(begin)) ++begin;
  while (begin < end && !history.has_contact(end - 1)) --end;
  if (begin == end) return {0, 0};
  const size_t last = history.contact[end - 1];
  return {history.contact[begin],
          last + (regions ? contact_run(history.contacts, last).size() : 1)};
}

// The contacts of carried pairs, in the last step.
MergeRange contacts_of(const CarriedRun& run, const ContactStage::Input& input) {
  return contacts_of(input.last, run.before, run.before + (run.end - run.begin),
                     input.settings.detail == Detail::regions);
}

// Copies what the last step said of carried pairs. Their contacts keep the places that they had,
// until they are written.
void repeat_results(const CarriedRun& run, const ContactStage::Input& input, PairHistory& now,
                    Counts& counts) {
  const size_t count = run.end - run.begin;
  const uint8_t* const decision = input.last.overlaps.data() + run.before;
  std::copy_n(decision, count, now.overlaps.data() + run.begin);
  std::copy_n(input.last.contact.data() + run.before, count, now.contact.data() + run.begin);
  uint32_t overlapping = 0, unknown = 0;
  for (size_t i = 0; i < count; ++i) {
    overlapping += decision[i] == 1;
    unknown += decision[i] == kUndecided;
  }
  const bool regions = input.settings.detail == Detail::regions;
  const MergeRange contacts = contacts_of(run, input);
  counts.overlaps += overlapping;
  counts.undecided += unknown;
  counts.contacts += contacts.end - contacts.begin;
  if (!regions) return;
  for (size_t c = contacts.begin; c < contacts.end; ++c) {
    counts.left_out += input.last.contacts[c].left_out;
  }
}

// Lists the pairs of [begin, end) that have contacts, without branches, and returns their number.
size_t list_contacts(const PairHistory& now, size_t begin, size_t end,
                     std::array<uint32_t, kPairsPerMergeBlock>& listed) {
  size_t count = 0;
  for (size_t i = begin; i < end; ++i) {
    listed[count] = static_cast<uint32_t>(i);
    count += now.has_contact(i);
  }
  return count;
}

// Writes the contacts of open pairs from `next` on, and returns the place after the last one.
size_t write_new(const OpenPairs& open, const ContactStage::Input& input, size_t next,
                 PairHistory& now) {
  const auto& [plan, last, results, bodies, settings] = input;
  const bool manifolds = has_manifolds(settings.detail);
  const bool regions = settings.detail == Detail::regions;
  // Where a row is a pair and a pair a contact, contacts are written in lanes; then what belongs to
  // them.
  const bool in_lanes = plan.dropped() == 0 && !regions;
  if (in_lanes) {
    const size_t end = write_contact_rows(
        results.rows_of(std::span(now.pairs).subspan(open.begin, open.size()), open.number,
                        std::span(now.contact).subspan(open.begin, open.size())),
        next, now.contacts);
    if (!manifolds && !settings.identities) return end;
  }
  std::array<uint32_t, kPairsPerMergeBlock> listed;
  const size_t count = list_contacts(now, open.begin, open.end, listed);
  for (size_t k = 0; k < count; ++k) {
    const size_t i = listed[k];
    const size_t row = plan.row(open.number + (i - open.begin));
    if (!in_lanes) now.contacts[next] = results.contact(row, now.pairs[i]);
    if (manifolds) {
      fetch_to_write(now.manifolds.data() + next, kContactsAhead);
      now.manifolds[next] = results.manifold(row);
    }
    if (settings.identities) now.identities[next].names = results.names(row);
    now.contact[i] = static_cast<uint32_t>(next++);
    if (!regions) continue;
    now.contacts[next - 1].left_out = results.left_out(row);
    for (const ContactWithPoints& each : results.extra(row)) {
      now.contacts[next] = each.contact;
      if (settings.identities) now.identities[next].names = each.names;
      now.manifolds[next++] = each.points;
    }
  }
  return next;
}

// Copies neighbours of a list to another one. Runs are short, and follow one another closely in
// both lists: so those to come are asked for in the cache.
template <class T>
void copy_run(const T* from, size_t count, T* to) {
  // As bytes, since vectors of Eigen would be copied number by number.
  for (size_t i = 0; i < count; ++i) {
    fetch_to_write(to + i, kContactsAhead);
    fetch_to_read(from + i, kContactsAhead);
    std::memcpy(static_cast<void*>(to + i), from + i, sizeof(T));
  }
}

// As write_new(), for carried pairs. `in_place`: their contacts are in place already.
size_t write_old(const CarriedRun& run, const ContactStage::Input& input, bool in_place,
                 size_t next, PairHistory& now) {
  const PairHistory& last = input.last;
  const MergeRange from = contacts_of(run, input);
  const size_t count = in_place ? 0 : from.end - from.begin;
  const auto copy = [&](const auto& old, auto& list) {
    if (count == 0) return;  // in place, `old` may have no memory
    copy_run(old.data() + from.begin, count, list.data() + next);
  };
  copy(last.contacts, now.contacts);
  if (has_manifolds(input.settings.detail)) copy(last.manifolds, now.manifolds);
  if (input.settings.identities) copy(last.identities, now.identities);
  const auto shift = static_cast<uint32_t>(next - from.begin);
  for (size_t i = run.begin; i < run.end; ++i) {
    const uint32_t contact = now.contact[i];
    now.contact[i] = contact + (PairHistory::is_place(contact) ? shift : 0u);
  }
  return next + (from.end - from.begin);
}

}  // namespace

void ContactStage::start(Last what, PairHistory& last, PairHistory& now) {
  overlaps_ = undecided_ = left_out_ = 0;
  resize_for_overwriting(now.overlaps, now.pairs.size());
  resize_for_overwriting(now.contact, now.pairs.size());
  now.clear_contacts();
  in_place_ = what == Last::in_place;
  if (in_place_) {
    now.contacts.swap(last.contacts);
    now.manifolds.swap(last.manifolds);
  }
  const auto take_memory = [what](auto& before, auto& list) {
    if (what != Last::unused || list.capacity() >= before.capacity()) return;
    before.clear();
    list.swap(before);
  };
  take_memory(last.contacts, now.contacts);
  take_memory(last.manifolds, now.manifolds);
  take_memory(last.identities, now.identities);
}

void ContactStage::add_results(const PairRange& range, const Input& input, PairHistory& now) {
  const size_t pairs = range.end - range.begin;
  block_first_.assign(block_count(pairs, kPairsPerMergeBlock), 0);
  const bool simple = decisions_say_all(input);
  std::atomic<size_t> overlaps{0}, undecided{0}, left_out{0};
  for_each_block(
      pairs, kPairsPerMergeBlock, unless_few(input.settings.parallelism, pairs),
      [&](size_t block, size_t begin, size_t end) {
        Counts counts;
        const auto open = [&](size_t first, size_t stop, size_t number) {
          (simple ? read_decisions : read_results)({first, stop, number}, input, now, counts);
        };
        const auto carried = [&](const CarriedRun& run) {
          repeat_results(run, input, now, counts);
        };
        input.plan.for_each_stretch(range.begin + begin, range.begin + end, open, carried);
        block_first_[block] = counts.contacts;
        overlaps += counts.overlaps;
        undecided += counts.undecided;
        left_out += counts.left_out;
      });
  overlaps_ += overlaps;
  undecided_ += undecided;
  left_out_ += left_out;
  if (has_contacts(input.settings.detail)) make_room(range, input, now);
}

// Makes room for the contacts of the range. Carried ones that stay in their list go to their
// places.
void ContactStage::make_room(const PairRange& range, const Input& input, PairHistory& now) {
  size_t contacts = in_place_ ? 0 : now.contacts.size();
  for (size_t& block : block_first_) contacts += std::exchange(block, contacts);
  // In place, the lists hold the contacts of all pairs already.
  const size_t done = in_place_ ? now.pairs.size() : range.begin;
  const auto resize = [&](size_t count) {
    const auto resize_list = [&](auto& list) {
      reserve_at_rate(list, count, done, now.pairs.size());
      list.resize(count);
    };
    resize_list(now.contacts);
    if (has_manifolds(input.settings.detail)) resize_list(now.manifolds);
    if (input.settings.identities) resize_list(now.identities);
  };
  if (in_place_) {
    resize(std::max(contacts, now.contacts.size()));
    move_carried(range, input, now);
  }
  resize(contacts);
}

// Moves the contacts of carried pairs to their places within the list.
void ContactStage::move_carried(const PairRange& range, const Input& input, PairHistory& now) {
  moves_.clear();
  size_t next = 0;
  const auto open = [&](size_t first, size_t stop, size_t) {
    for (size_t i = first; i < stop; ++i) next += now.has_contact(i);
  };
  const auto carried = [&](const CarriedRun& run) {
    const MergeRange from = contacts_of(run, input);
    const size_t count = from.end - from.begin;
    if (count > 0) moves_.push_back({from.begin, next, count});
    next += count;
  };
  for_each_merge_block(range.end, Parallelism::none, [&](size_t, size_t begin, size_t end) {
    input.plan.for_each_stretch(begin, end, open, carried);
  });
  move_runs(moves_, now.contacts.data());
  if (has_manifolds(input.settings.detail)) move_runs(moves_, now.manifolds.data());
}

double ContactStage::write_contacts(const PairRange& range, const Input& input,
                                    const NormalVelocities* velocities, PairHistory& now) {
  using Clock = std::chrono::steady_clock;
  std::atomic<Clock::rep> of_contacts{0}, of_velocities{0};
  const size_t pairs = range.end - range.begin;
  for_each_block(pairs, kPairsPerMergeBlock, unless_few(input.settings.parallelism, pairs),
                 [&](size_t block, size_t begin, size_t end) {
                   const size_t first = block_first_[block];
                   if (!velocities) {
                     write_block(range, {begin, end}, input, first, now);
                     return;
                   }
                   const Clock::time_point start = Clock::now();
                   const size_t next = write_block(range, {begin, end}, input, first, now);
                   const Clock::time_point written = Clock::now();
                   velocities->set(std::span(now.contacts).subspan(first, next - first));
                   of_contacts += (written - start).count();
                   of_velocities += (Clock::now() - written).count();
                 });
  const auto all = static_cast<double>(of_contacts + of_velocities);
  return all > 0 ? static_cast<double>(of_velocities) / all : 0;
}

// Writes the contacts of a block from `next` on, and returns the place after the last one.
size_t ContactStage::write_block(const PairRange& range, const MergeRange& block,
                                 const Input& input, size_t next, PairHistory& now) const {
  const auto open = [&](size_t first, size_t stop, size_t number) {
    next = write_new({first, stop, number}, input, next, now);
  };
  const auto carried = [&](const CarriedRun& run) {
    next = write_old(run, input, in_place_, next, now);
  };
  input.plan.for_each_stretch(range.begin + block.begin, range.begin + block.end, open, carried);
  return next;
}

}  // namespace carom

#include "world/results/overlap_merge.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "base/fetch_ahead.h"
#include "world/results/overlap_keys.h"
#include "world/store/columns.h"

namespace carom {

void Overlaps::reserve(size_t pairs) {
  key.reserve(pairs + kOverlapsBeyond);
  tail.reserve(pairs + kOverlapsBeyond);
}

void Overlaps::start(size_t pairs) {
  resize_for_overwriting(key, pairs + kOverlapsBeyond);
  resize_for_overwriting(tail, pairs + kOverlapsBeyond);
  count = 0;
}

void Overlaps::add(const PairHistory& history, size_t begin, size_t end, EventKind kind) {
  count += list_overlaps(std::span(history.pairs).subspan(begin, end - begin),
                         history.overlaps.data() + begin, history.contact.data() + begin, kind,
                         key.data() + count, tail.data() + count);
}

void Overlaps::finish() {
  key[count] = ~uint64_t{0};
  tail[count] = 0;
}

size_t Overlaps::bytes() const { return bytes_of(key) + bytes_of(tail); }

namespace {

// Events are asked for in the cache so long before they are written: 3 KiB.
constexpr size_t kEventsAhead = 128;

void put(uint64_t number, Event* event, size_t offset) {
  std::memcpy(reinterpret_cast<std::byte*>(event) + offset, &number, sizeof(number));
}

// Which pairs have events cannot be predicted: overlaps come and go. So there is no branch on it:
// an event is written for every pair, and counts or does not. It is written as three numbers, since
// a store for each field takes longer than the rest of the merge.
template <Persisting kPersisting>
Event* merge(const Overlaps& last, const Overlaps& now, Event* out) {
  static_assert(offsetof(Event, b) == 8 && offsetof(Event, contact) == 16 &&
                offsetof(Event, kind) == 20 && offsetof(Event, sensor) == 21);
  static_assert(static_cast<int>(EventKind::begin) == 0);
  static_assert(static_cast<int>(EventKind::persist) == 1);
  const uint64_t *key_before = last.key.data(), *key = now.key.data();
  const uint64_t *tail_before = last.tail.data(), *tail = now.tail.data();
  const size_t most = last.count + now.count;
  size_t before = 0, i = 0;
  while (before + i < most) {
    fetch_to_write(out, kEventsAhead);
    const uint64_t left = key_before[before], right = key[i];
    const bool overlapped = left <= right;
    const bool overlaps = kPersisting == Persisting::apart ? right < left : right <= left;
    const bool persists = overlapped & overlaps;
    const uint64_t choice = uint64_t{0} - overlaps;  // a mask, since compilers make branches
    const uint64_t pair = std::min(left, right);
    const uint64_t either = (tail[i] & choice) | (tail_before[before] & ~choice);
    put(pair >> 32, out, offsetof(Event, a));
    put(pair & 0xffffffffu, out, offsetof(Event, b));
    put(either + (uint64_t{persists} << 32), out, offsetof(Event, contact));
    out += kPersisting == Persisting::dropped ? !persists : true;
    before += overlapped;
    i += overlaps;
  }
  return out;
}

}  // namespace

void merge_overlaps(const Overlaps& last, const Overlaps& now, Persisting persisting,
                    RawVector<Event>& events) {
  const size_t first = events.size();
  events.resize(first + last.count + now.count);
  Event* const begin = events.data() + first;
  Event* end = begin;
  switch (persisting) {
    case Persisting::wanted:
      end = merge<Persisting::wanted>(last, now, begin);
      break;
    case Persisting::dropped:
      end = merge<Persisting::dropped>(last, now, begin);
      break;
    case Persisting::apart:
      end = merge<Persisting::apart>(last, now, begin);
      break;
  }
  events.resize(static_cast<size_t>(end - events.data()));
}

}  // namespace carom

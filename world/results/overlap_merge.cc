#include "world/results/overlap_merge.h"

#include <algorithm>

#include "world/results/overlap_keys.h"
#include "world/store/columns.h"

namespace carom {

void Overlaps::reserve(size_t pairs) {
  key.reserve(pairs + kOverlapsBeyond);
  contact.reserve(pairs + kOverlapsBeyond);
}

void Overlaps::start(size_t pairs) {
  resize_for_overwriting(key, pairs + kOverlapsBeyond);
  resize_for_overwriting(contact, pairs + kOverlapsBeyond);
  count = 0;
}

void Overlaps::add(const PairHistory& history, size_t begin, size_t end) {
  count += list_overlaps(std::span(history.pairs).subspan(begin, end - begin),
                         history.overlaps.data() + begin, history.contact.data() + begin,
                         key.data() + count, contact.data() + count);
}

void Overlaps::finish() {
  key[count] = ~uint64_t{0};
  contact[count] = PairHistory::kNone;
}

size_t Overlaps::bytes() const { return bytes_of(key) + bytes_of(contact); }

// Which pairs have events cannot be predicted: overlaps come and go. So there is no branch on it:
// an event is written for every pair, and counts or does not.
void merge_overlaps(const Overlaps& last, const Overlaps& now, Persisting persisting,
                    RawVector<Event>& events) {
  static_assert(static_cast<int>(EventKind::begin) == 0);
  static_assert(static_cast<int>(EventKind::persist) == 1);
  static_assert(static_cast<int>(EventKind::end) == 2);
  const bool joins = persisting != Persisting::apart, wanted = persisting == Persisting::wanted;
  const size_t first = events.size(), most = last.count + now.count;
  events.resize(first + most);
  Event* out = events.data() + first;
  size_t before = 0, i = 0;
  while (before + i < most) {
    const uint64_t key_before = last.key[before], key = now.key[i];
    const bool overlapped = key_before <= key;
    const bool overlaps = (key < key_before) | (joins & (key == key_before));
    const uint32_t choice = overlaps ? 0xffffffffu : 0u;  // a mask, since compilers make branches
    const uint32_t contact = (now.contact[i] & choice) | (last.contact[before] & ~choice);
    const bool sensor = contact == PairHistory::kSensor;
    const bool persists = overlapped & overlaps;
    const bool unlisted = sensor | !overlaps;
    const uint64_t pair = std::min(key_before, key);
    *out = {.a = {static_cast<uint32_t>(pair >> 32), 0},
            .b = {static_cast<uint32_t>(pair), 0},
            .contact = contact | (unlisted ? kNoContact : 0u),
            .kind = static_cast<EventKind>(persists | !overlaps << 1),
            .sensor = sensor};
    out += !persists | wanted;
    before += overlapped;
    i += overlaps;
  }
  events.resize(static_cast<size_t>(out - events.data()));
}

}  // namespace carom

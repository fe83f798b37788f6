#include "world/results/overlap_merge.h"

#include <algorithm>

#include "world/results/overlap_keys.h"
#include "world/store/columns.h"

namespace carom {
namespace {

static_assert(static_cast<int>(EventKind::begin) == 0);
static_assert(static_cast<int>(EventKind::persist) == 1);
static_assert(static_cast<int>(EventKind::end) == 2);

// Merges a part of both lists. Which pairs have events cannot be predicted: overlaps come and go.
// So there is no branch on it: an event is written for every pair, and counts or does not.
class PartMerge {
 public:
  // The parts begin at `before` and `i`, and have `left` overlaps together. Behind each part
  // follows a key that is above those of the other part.
  PartMerge(const Overlaps& last, const Overlaps& now, Persisting persisting, size_t before,
            size_t i, size_t left, Event* out)
      : left_(left),
        key_before_(last.key.data() + before),
        contact_before_(last.contact.data() + before),
        key_(now.key.data() + i),
        contact_(now.contact.data() + i),
        out_(out),
        joins_(persisting != Persisting::apart),
        wanted_(persisting == Persisting::wanted) {}

  bool is_done() const { return left_ == 0; }
  Event* end() const { return out_; }

  void step() {
    const bool overlapped = *key_before_ <= *key_;
    const bool overlaps = (*key_ < *key_before_) | (joins_ & (*key_ == *key_before_));
    const uint32_t choice = overlaps ? 0xffffffffu : 0u;  // a mask, since compilers make branches
    const uint32_t contact = (*contact_ & choice) | (*contact_before_ & ~choice);
    const bool sensor = contact == PairHistory::kSensor;
    const bool persists = overlapped & overlaps;
    const bool unlisted = sensor | !overlaps;
    const uint64_t pair = std::min(*key_before_, *key_);
    *out_ = {.a = {static_cast<uint32_t>(pair >> 32), 0},
             .b = {static_cast<uint32_t>(pair), 0},
             .contact = contact | (unlisted ? kNoContact : 0u),
             .kind = static_cast<EventKind>(persists | !overlaps << 1),
             .sensor = sensor};
    out_ += !persists | wanted_;
    key_before_ += overlapped;
    contact_before_ += overlapped;
    key_ += overlaps;
    contact_ += overlaps;
    left_ -= size_t{overlapped} + overlaps;
  }

 private:
  size_t left_;
  const uint64_t* key_before_;
  const uint32_t* contact_before_;
  const uint64_t* key_;
  const uint32_t* contact_;
  Event* out_;
  const bool joins_, wanted_;
};

}  // namespace

void Overlaps::start(size_t pairs) {
  key.resize(pairs + kOverlapsBeyond);
  contact.resize(pairs + kOverlapsBeyond);
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

// Each step of a merge waits for the comparison of the last one. So two parts are merged side by
// side: the pairs below the middle one of this step, and the others.
void merge_overlaps(const Overlaps& last, const Overlaps& now, Persisting persisting,
                    RawVector<Event>& events) {
  const size_t i = now.count / 2;
  const auto before = static_cast<size_t>(
      std::lower_bound(last.key.begin(), last.key.begin() + static_cast<ptrdiff_t>(last.count),
                       now.key[i]) -
      last.key.begin());
  const size_t first = events.size(), lower_most = before + i;
  const size_t most = last.count + now.count;
  events.resize(first + most);
  Event* const lower_events = events.data() + first;
  Event* const upper_events = lower_events + lower_most;
  PartMerge lower(last, now, persisting, 0, 0, lower_most, lower_events);
  PartMerge upper(last, now, persisting, before, i, most - lower_most, upper_events);
  while (!lower.is_done() && !upper.is_done()) {
    lower.step();
    upper.step();
  }
  while (!lower.is_done()) lower.step();
  while (!upper.is_done()) upper.step();
  Event* end = upper.end();
  if (lower.end() < upper_events) end = std::move(upper_events, end, lower.end());
  events.resize(static_cast<size_t>(end - events.data()));
}

}  // namespace carom

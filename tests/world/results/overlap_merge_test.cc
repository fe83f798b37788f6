// Two lists of overlaps, merged into events: those of a comparison pair by pair.
#include "world/results/overlap_merge.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <vector>

#include "oracle/random.h"
#include "world/results/overlap_keys.h"

namespace carom::test {
namespace {

constexpr uint32_t kSensor = PairHistory::kSensor;

// The contact (or kSensor) of each overlap, by pair_key().
using Contacts = std::map<uint64_t, uint32_t>;

Overlaps list_of(const Contacts& contacts, EventKind kind) {
  Overlaps overlaps;
  overlaps.start(contacts.size());
  for (const auto& [key, contact] : contacts) {
    overlaps.key[overlaps.count] = key;
    overlaps.tail[overlaps.count++] = event_tail(contact, kind);
  }
  overlaps.finish();
  return overlaps;
}

Event event_of(uint64_t key, uint32_t contact, EventKind kind) {
  const bool sensor = contact == kSensor;
  const bool listed = !sensor && kind != EventKind::end;
  return {.a = {static_cast<uint32_t>(key >> 32), 0},
          .b = {static_cast<uint32_t>(key), 0},
          .contact = listed ? contact : kNoContact,
          .kind = kind,
          .sensor = sensor};
}

std::vector<Event> expected(const Contacts& last, const Contacts& now, Persisting persisting) {
  std::set<uint64_t> keys;
  for (const Contacts* each : {&last, &now}) {
    for (const auto& [key, contact] : *each) keys.insert(key);
  }
  std::vector<Event> events;
  for (const uint64_t key : keys) {
    const bool overlapped = last.contains(key), overlaps = now.contains(key);
    if (overlapped && overlaps && persisting != Persisting::apart) {
      if (persisting == Persisting::wanted) {
        events.push_back(event_of(key, now.at(key), EventKind::persist));
      }
      continue;
    }
    if (overlapped) events.push_back(event_of(key, last.at(key), EventKind::end));
    if (overlaps) events.push_back(event_of(key, now.at(key), EventKind::begin));
  }
  return events;
}

Contacts random_contacts(oracle::Random& random, size_t count, uint32_t bodies) {
  Contacts contacts;
  for (size_t i = 0; i < count; ++i) {
    const auto a = static_cast<uint32_t>(random.below(bodies));
    const auto b = a + 1 + static_cast<uint32_t>(random.below(bodies));
    contacts[pair_key({a, b})] = random.chance(0.125) ? kSensor : static_cast<uint32_t>(i);
  }
  return contacts;
}

void expect_merged(const Contacts& last, const Contacts& now) {
  for (const auto persisting : {Persisting::wanted, Persisting::dropped, Persisting::apart}) {
    RawVector<Event> events(3);  // what is there stays
    merge_overlaps(list_of(last, EventKind::end), list_of(now, EventKind::begin), persisting,
                   events);
    const std::vector<Event> all = expected(last, now, persisting);
    ASSERT_EQ(events.size(), 3 + all.size()) << static_cast<int>(persisting);
    for (size_t i = 0; i < all.size(); ++i) {
      const Event &is = events[3 + i], &should = all[i];
      ASSERT_EQ(is.a, should.a) << i;
      ASSERT_EQ(is.b, should.b) << i;
      ASSERT_EQ(is.contact, should.contact) << i;
      ASSERT_EQ(is.kind, should.kind) << i;
      ASSERT_EQ(is.sensor, should.sensor) << i;
      ASSERT_EQ(is.gone, 0) << i;
    }
  }
}

TEST(OverlapMerge, OfNothingAndOfOneSide) {
  const Contacts one = {{pair_key({3, 7}), 5}};
  const Contacts two = {{pair_key({0, 1}), 0}, {pair_key({3, 7}), kSensor}};
  for (const Contacts& last : {Contacts{}, one, two}) {
    for (const Contacts& now : {Contacts{}, one, two}) expect_merged(last, now);
  }
}

TEST(OverlapMerge, OfRandomLists) {
  oracle::Random random(71);
  for (size_t round = 0; round < 600; ++round) {
    // Few bodies: most overlaps stay. Many: nearly all begin or end.
    const uint32_t bodies = round % 3 == 0 ? 5 : round % 3 == 1 ? 20 : 1000;
    const size_t most = round % 2 ? 12 : 200;
    const Contacts last = random_contacts(random, random.below(most), bodies);
    expect_merged(last, random_contacts(random, random.below(most), bodies));
  }
}

// All pairs of one step lie above or below all of the other.
TEST(OverlapMerge, OfListsThatDoNotMeet) {
  Contacts low, high;
  for (uint32_t i = 0; i < 40; ++i) {
    low[pair_key({i, i + 1})] = i;
    high[pair_key({i + 100, i + 101})] = i;
  }
  expect_merged(low, high);
  expect_merged(high, low);
  expect_merged(low, low);
}

}  // namespace
}  // namespace carom::test

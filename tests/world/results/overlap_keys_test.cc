// Lists of pairs that overlap, against one pair at a time.
#include "world/results/overlap_keys.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <vector>

#include "oracle/random.h"
#include "tests/support/isas.h"

namespace carom::test {
namespace {

// The last eight bytes of the event of an overlap.
uint64_t tail_of(uint32_t contact, EventKind kind) {
  const bool sensor = contact == PairHistory::kSensor;
  const Event event = {.a = {},
                       .b = {},
                       .contact = sensor || kind == EventKind::end ? kNoContact : contact,
                       .kind = kind,
                       .sensor = sensor};
  uint64_t tail;
  std::memcpy(&tail, reinterpret_cast<const std::byte*>(&event) + offsetof(Event, contact),
              sizeof(tail));
  return tail;
}

TEST(OverlapKeys, AreThoseOfThePairsThatOverlap) {
  oracle::Random random(61);
  size_t listed = 0, all = 0;
  for (const double share : {0.0, 0.1, 0.5, 0.95, 1.0}) {
    for (const size_t count : {0, 1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 33, 500}) {
      std::vector<Pair> pairs(count);
      std::vector<uint8_t> overlap(count);
      std::vector<uint32_t> contact(count);
      std::vector<uint64_t> expected_keys;
      std::vector<uint64_t> expected_tails;
      const EventKind kind = count % 2 ? EventKind::begin : EventKind::end;
      for (size_t i = 0; i < count; ++i) {
        pairs[i] = {static_cast<uint32_t>(random.bits()), static_cast<uint32_t>(random.bits())};
        // 0, 1, or undecided
        overlap[i] = random.chance(share) ? 1 : static_cast<uint8_t>(2 * random.below(2));
        contact[i] =
            random.chance(0.125) ? PairHistory::kSensor : static_cast<uint32_t>(random.bits());
        if (overlap[i] != 1) continue;
        expected_keys.push_back(pair_key(pairs[i]));
        expected_tails.push_back(tail_of(contact[i], kind));
      }
      for_each_isa([&] {
        std::vector<uint64_t> keys(count + kOverlapsBeyond);
        std::vector<uint64_t> tails(count + kOverlapsBeyond);
        const size_t found =
            list_overlaps(pairs, overlap.data(), contact.data(), kind, keys.data(), tails.data());
        keys.resize(found);
        tails.resize(found);
        EXPECT_EQ(keys, expected_keys);
        EXPECT_EQ(tails, expected_tails);
        listed += found;
        all += count;
      });
    }
  }
  EXPECT_GT(listed, all / 3);
  EXPECT_LT(listed, all * 2 / 3);
}

}  // namespace
}  // namespace carom::test

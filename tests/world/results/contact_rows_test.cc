// Rows of results written as contacts, against one pair at a time.
#include "world/results/contact_rows.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "carom/results/result_arrays.h"
#include "midphase/contact_of_row.h"
#include "oracle/random.h"
#include "tests/support/isas.h"
#include "world/pairs/pair_history.h"

namespace carom::test {
namespace {

void fill_columns(oracle::Random& random, const ResultColumns& columns, size_t rows) {
  const auto fill = [&](auto* column) {
    if (!column) return;
    for (size_t i = 0; i < rows; ++i) {
      const auto bits = static_cast<uint32_t>(random.bits());
      std::memcpy(&column[i], &bits, sizeof(column[i]));
    }
  };
  for (const auto* vector : {&columns.normal, &columns.point_a, &columns.point_b}) {
    for (float* column : *vector) fill(column);
  }
  fill(columns.separation);
  fill(columns.sub_a);
  fill(columns.sub_b);
  fill(columns.status);
  fill(columns.manifold_count);
}

// Every bit matters, those of NaN included.
bool same_bytes(const Contact& a, const Contact& b) {
  return std::memcmp(&a, &b, sizeof(Contact)) == 0;
}

TEST(ContactRows, AreThoseOfOneAtATime) {
  oracle::Random random(62);
  size_t written = 0, all = 0;
  for (const Detail detail : {Detail::contact, Detail::manifold}) {
    for (const bool with_parts : {false, true}) {
      for (const double share : {0.0, 0.1, 0.5, 0.9, 1.0}) {
        for (const size_t count : {0, 1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 33, 400}) {
          const size_t first_row = random.below(9), next = random.below(5);
          std::vector<ColumnRole> wanted;
          if (with_parts) wanted.push_back(ColumnRole::sub_shape);
          ResultArrays arrays;
          arrays.resize(first_row + count, detail, std::span<const ColumnRole>(wanted));
          fill_columns(random, arrays.columns(), first_row + count);
          std::vector<Pair> pairs(count);
          std::vector<uint32_t> contact(count), expected_places;
          std::vector<Contact> expected;
          for (size_t i = 0; i < count; ++i) {
            pairs[i] = {static_cast<uint32_t>(random.bits()), static_cast<uint32_t>(random.bits())};
            const bool has_one = random.chance(share);
            contact[i] = has_one                ? static_cast<uint32_t>(random.below(2))
                         : random.chance(0.125) ? PairHistory::kSensor
                                                : PairHistory::kNone;
            expected_places.push_back(has_one ? static_cast<uint32_t>(next + expected.size())
                                              : contact[i]);
            if (has_one) {
              expected.push_back(contact_of_row(arrays.columns(), first_row + i, pairs[i]));
            }
          }
          for_each_isa([&] {
            // Contacts before and after these stay as they are.
            Contact guard;
            std::memset(static_cast<void*>(&guard), 0x5a, sizeof(guard));
            std::vector<Contact> contacts(next + expected.size() + 3, guard);
            std::vector<uint32_t> places = contact;
            const size_t end =
                write_contact_rows({arrays.columns(), first_row, pairs, places}, next, contacts);
            ASSERT_EQ(end, next + expected.size());
            EXPECT_EQ(places, expected_places);
            for (size_t i = 0; i < contacts.size(); ++i) {
              const bool is_new = i >= next && i < end;
              ASSERT_TRUE(same_bytes(contacts[i], is_new ? expected[i - next] : guard)) << i;
            }
            written += expected.size();
            all += count;
          });
          ASSERT_FALSE(HasFatalFailure());
        }
      }
    }
  }
  EXPECT_GT(written, all / 3);
  EXPECT_LT(written, all * 2 / 3);
}

}  // namespace
}  // namespace carom::test

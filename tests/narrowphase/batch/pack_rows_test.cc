// Rows that are wanted, packed, against one row at a time.
#include "narrowphase/batch/pack_rows.h"

#include <gtest/gtest.h>

#include <bit>
#include <vector>

#include "oracle/random.h"
#include "tests/support/isas.h"

namespace carom::test {
namespace {

struct Packed {
  std::vector<Pair> pairs;
  std::vector<uint16_t> rows;
  std::vector<std::vector<uint32_t>> columns;  // bits of the numbers

  bool operator==(const Packed&) const = default;
};

struct Rows {
  std::vector<uint8_t> wanted;
  std::vector<Pair> pairs;
  std::vector<std::vector<float>> columns;

  Rows(oracle::Random& random, size_t count, size_t column_count, double share) {
    for (size_t i = 0; i < count; ++i) {
      // Other bytes than 1, as undecided pairs have, are not wanted.
      wanted.push_back(random.chance(share) ? 1 : static_cast<uint8_t>(2 * random.below(2)));
      pairs.push_back({static_cast<uint32_t>(random.bits()), static_cast<uint32_t>(random.bits())});
    }
    columns.resize(column_count);
    for (std::vector<float>& column : columns) {
      // Any bits, NaN among them.
      for (size_t i = 0; i < count; ++i) {
        column.push_back(std::bit_cast<float>(static_cast<uint32_t>(random.bits())));
      }
    }
  }

  Packed one_at_a_time() const {
    Packed packed{{}, {}, std::vector<std::vector<uint32_t>>(columns.size())};
    for (size_t i = 0; i < wanted.size(); ++i) {
      if (wanted[i] != 1) continue;
      packed.pairs.push_back(pairs[i]);
      packed.rows.push_back(static_cast<uint16_t>(i));
      for (size_t c = 0; c < columns.size(); ++c) {
        packed.columns[c].push_back(std::bit_cast<uint32_t>(columns[c][i]));
      }
    }
    return packed;
  }

  Packed in_lanes() const {
    const size_t room = wanted.size() + 1;
    std::vector<Pair> to_pairs(room);
    std::vector<uint16_t> rows(room);
    std::vector<std::vector<float>> to(columns.size(), std::vector<float>(room));
    std::vector<PackedColumn> packs;
    for (size_t c = 0; c < columns.size(); ++c) packs.push_back({columns[c].data(), to[c].data()});
    const size_t count = pack_rows(wanted.data(), wanted.size(),
                                   {pairs.data(), to_pairs.data(), rows.data()}, packs);
    Packed packed{{to_pairs.begin(), to_pairs.begin() + static_cast<ptrdiff_t>(count)},
                  {rows.begin(), rows.begin() + static_cast<ptrdiff_t>(count)},
                  {}};
    for (const std::vector<float>& column : to) {
      std::vector<uint32_t> bits;
      for (size_t i = 0; i < count; ++i) bits.push_back(std::bit_cast<uint32_t>(column[i]));
      packed.columns.push_back(bits);
    }
    return packed;
  }
};

TEST(PackRows, KeepsThoseThatAreWantedInTheirOrder) {
  oracle::Random random(97);
  size_t wanted = 0, all = 0;
  for (const double share : {0.0, 0.1, 0.5, 0.95, 1.0}) {
    for (const size_t count : {0, 1, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 33, 1000, 1024}) {
      for (const size_t columns : {0, 1, 8}) {
        const Rows rows(random, count, columns, share);
        const Packed expected = rows.one_at_a_time();
        for_each_isa([&] { EXPECT_EQ(rows.in_lanes(), expected) << count << ", " << columns; });
        wanted += expected.rows.size();
        all += count;
      }
    }
  }
  EXPECT_GT(wanted, all / 3);
  EXPECT_LT(wanted, all * 2 / 3);
}

}  // namespace
}  // namespace carom::test

// The list of columns, and what is made of it: memory, copies, rows.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "carom/results/result_arrays.h"
#include "carom/results/result_row.h"
#include "narrowphase/batch/column_memory.h"

namespace carom::test {
namespace {

// The columns that are there, by name; the components of a vector count once each.
std::multiset<std::string> names_of(const ResultColumns& columns) {
  std::multiset<std::string> names;
  for_each_column(
      [&](const ColumnInfo& info, const auto* column) {
        if (column) names.insert(info.name);
      },
      columns);
  return names;
}

// Writes another value to every row of every column.
void number(const ResultColumns& columns, size_t count) {
  int next = 1;
  for_each_column(
      [&]<class T>(const ColumnInfo&, T* column) {
        for (size_t i = 0; column && i < count; ++i) {
          if constexpr (std::is_same_v<T, ManifoldPoints>) {
            column[i] = {};
            column[i].separation[0] = static_cast<float>(next++);
          } else if constexpr (std::is_same_v<T, PointNames>) {
            column[i] = {};
            column[i].point[0] = static_cast<uint64_t>(next++);
          } else {
            column[i] = static_cast<T>(next++);
          }
        }
      },
      columns);
}

const std::multiset<std::string> kOfOverlaps = {"overlap", "status"};
const std::multiset<std::string> kOfContacts = {"overlap", "status",  "separation", "normal",
                                                "normal",  "normal",  "point_a",    "point_a",
                                                "point_a", "point_b", "point_b",    "point_b"};

TEST(Columns, EveryOneHasANameOfItsOwn) {
  std::set<std::string> names;
  size_t fields = 0;
  for_each_result(
      [&](const ColumnInfo& info, const auto&) {
        names.insert(info.name);
        ++fields;
      },
      ResultColumns());
  EXPECT_EQ(names.size(), fields);
}

TEST(Columns, ArraysHaveWhatTheDetailFills) {
  EXPECT_EQ(names_of(ResultArrays().columns()), std::multiset<std::string>());
  EXPECT_EQ(names_of(ResultArrays(3, Detail::overlap).columns()), kOfOverlaps);
  EXPECT_EQ(names_of(ResultArrays(3, Detail::contact).columns()), kOfContacts);
  std::multiset<std::string> all = kOfContacts;
  all.insert({"manifold", "manifold_count"});
  EXPECT_EQ(names_of(ResultArrays(3, Detail::manifold).columns()), all);
}

TEST(Columns, OptionalOnesExistIfWantedAndFilled) {
  std::multiset<std::string> names = kOfContacts;
  names.insert({"sub_a", "sub_b", "separation_bound"});
  EXPECT_EQ(
      names_of(
          ResultArrays(3, Detail::contact, {ColumnRole::sub_shape, ColumnRole::bound}).columns()),
      names);
  names = kOfOverlaps;
  names.insert("separation_bound");
  EXPECT_EQ(
      names_of(
          ResultArrays(3, Detail::overlap, {ColumnRole::sub_shape, ColumnRole::bound}).columns()),
      names);
}

TEST(Columns, ArraysDoNotOverlapAndCanBeUsedAgain) {
  ResultArrays arrays;
  for (const size_t count : {0, 1, 63, 64, 65, 1000, 7}) {
    arrays.resize(count, Detail::manifold, {ColumnRole::bound, ColumnRole::memory});
    EXPECT_EQ(arrays.count(), count);
    number(arrays.columns(), count);
    int expected = 1;
    for_each_column(
        [&]<class T>(const ColumnInfo& info, const T* column) {
          if (!column) return;
          EXPECT_EQ(reinterpret_cast<uintptr_t>(column) % 64, 0u) << info.name;
          for (size_t i = 0; i < count; ++i, ++expected) {
            if constexpr (std::is_same_v<T, ManifoldPoints>) {
              EXPECT_EQ(column[i].separation[0], static_cast<float>(expected));
            } else if constexpr (std::is_same_v<T, PointNames>) {
              EXPECT_EQ(column[i].point[0], static_cast<uint64_t>(expected));
            } else {
              EXPECT_EQ(column[i], static_cast<T>(expected));
            }
          }
        },
        arrays.columns());
  }
}

TEST(Columns, RowsAreCopiedWhereBothHaveThemAndTheDetailFillsThem) {
  constexpr size_t kCount = 5;
  ResultArrays from(kCount, Detail::manifold), to(10, Detail::manifold, {ColumnRole::bound});
  number(from.columns(), kCount);
  const std::vector<size_t> rows = {9, 0, 4, 2, 7};
  for (const Detail detail : {Detail::overlap, Detail::contact, Detail::manifold}) {
    number(to.columns(), 10);
    std::vector<ResultRow> before;
    for (size_t i = 0; i < 10; ++i) before.push_back(result_row(to.columns(), i));
    copy_rows(from.columns(), to.columns(), detail, kCount, [&](size_t i) { return rows[i]; });
    for (size_t row = 0; row < 10; ++row) {
      const auto found = std::find(rows.begin(), rows.end(), row);
      ResultRow expected = before[row];
      if (found != rows.end()) {
        const ResultRow source =
            result_row(from.columns(), static_cast<size_t>(found - rows.begin()));
        for_each_column(
            [&](const ColumnInfo& info, auto& field, const auto& copied) {
              if (info.detail <= detail && !is_optional(info.role)) field = copied;
            },
            expected, source);
      }
      EXPECT_TRUE(same_bits(result_row(to.columns(), row), expected)) << "row " << row;
    }
  }
}

TEST(Columns, FromARowOnAllOfThemMove) {
  ResultArrays arrays(10, Detail::manifold, {ColumnRole::sub_shape});
  number(arrays.columns(), 10);
  const ResultColumns moved = from_row(arrays.columns(), 4);
  EXPECT_EQ(names_of(moved), names_of(arrays.columns()));
  EXPECT_TRUE(same_bits(result_row(moved, 3), result_row(arrays.columns(), 7)));
}

TEST(Columns, CompleteMeansAllThatAreNotOptional) {
  ResultColumns columns = ResultArrays(1, Detail::contact).columns();
  EXPECT_TRUE(is_complete(columns, Detail::overlap));
  EXPECT_TRUE(is_complete(columns, Detail::contact));
  EXPECT_FALSE(is_complete(columns, Detail::manifold));
  columns.normal[1] = nullptr;
  EXPECT_TRUE(is_complete(columns, Detail::overlap));
  EXPECT_FALSE(is_complete(columns, Detail::contact));
}

TEST(Columns, ScratchHasOptionalOnesAsAsked) {
  BlockColumns memory;
  const ResultArrays asked(1, Detail::contact, {ColumnRole::bound});
  const ResultColumns columns = as_asked(memory.columns(), asked.columns());
  EXPECT_NE(columns.separation_bound, nullptr);
  EXPECT_EQ(columns.features, nullptr);
  EXPECT_NE(columns.manifold, nullptr);
}

}  // namespace
}  // namespace carom::test

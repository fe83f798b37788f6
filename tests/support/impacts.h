// Calls time_of_impact() on moving pairs laid out in guarded memory.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "carom/impacts/time_of_impact.h"
#include "carom/reference/reference.h"
#include "tests/support/float_modes.h"
#include "tests/support/isas.h"
#include "tests/support/layouts.h"
#include "tests/support/motions.h"

namespace carom::test {

// One row of ImpactColumns. Fields that are not written hold kNotWritten in every byte.
struct ImpactRow {
  float toi;
  float separation;
  std::array<float, 3> normal;
  std::array<float, 3> point_a;
  std::array<float, 3> point_b;
  uint32_t sub_a;
  uint32_t sub_b;
  uint32_t status;

  bool is_impact() const { return toi <= 1; }
  bool is_invalid() const { return status == static_cast<uint32_t>(Status::invalid); }
};
static_assert(sizeof(ImpactRow) == 14 * sizeof(uint32_t));

inline constexpr int kNotWritten = 0xa5;
inline constexpr float kNever = std::numeric_limits<float>::infinity();

bool same_bits(const ImpactRow& x, const ImpactRow& y);

std::string show(const ImpactRow& row);

// Guarded columns for `count` results; bit c of `missing` leaves column c out.
class ImpactTable {
 public:
  static constexpr int kColumns = 14;
  static constexpr int kStatus = 13;  // one byte an entry; all others are four

  ImpactTable(size_t count, unsigned missing);

  ImpactColumns out();

  ImpactRow row(size_t i) const;

 private:
  template <class T>
  T* at(int column) {
    return missing_ >> column & 1 ? nullptr : columns_[column].as<T>();
  }

  unsigned missing_;
  std::vector<GuardedArray> columns_;
};

// Keeps only the columns of a row that are not in `missing`.
void forget_columns(ImpactRow& row, unsigned missing);

// Sweeps as columns, `stride` bytes apart; a column is absent if all are zero and `stride` is 0.
class LaidOutSweeps {
 public:
  LaidOutSweeps(std::span<const Sweep> sweeps, size_t stride);

  SweepView view() const;

 private:
  class Vectors {
   public:
    Vectors(std::span<const Sweep> sweeps, Eigen::Vector3f Sweep::*member, size_t stride);

    void add_to(const float*& data, size_t& stride) const;

   private:
    static constexpr size_t kSize = 3 * sizeof(float);
    bool is_given_;
    GuardedArray bytes_;
  };

  Vectors displacements_, rotations_;
};

struct ImpactCall {
  Layout layout;
  size_t sweep_stride = 3 * sizeof(float);  // 0: a column is absent if all its sweeps are zero
  WitnessFrame frame = WitnessFrame::body;
  Parallelism parallelism = Parallelism::none;
  unsigned missing = 0;  // columns left out
  FloatMode mode = kDefaultMode;
  bool backwards = false;  // reverses the list of pairs, not the bodies
};

ImpactCall impact_call(PositionType positions);

Result<void> try_impacts(std::span<const MovedPair> pairs, const ImpactCall& call,
                         std::vector<ImpactRow>& rows);

// Runs time_of_impact(); row i is the result of pair i.
std::vector<ImpactRow> run_impacts(std::span<const MovedPair> pairs, const ImpactCall& call);

ImpactRow row_of(const reference::Impact& impact);

// The bits that every way of calling must write: the answers of the reference. The reference has no
// world coordinates; these come from calls with single pairs, which use no full vectors.
std::vector<ImpactRow> expected_impacts(std::span<const MovedPair> pairs, const ImpactCall& call);

// Fails at the first row that differs, with its inputs.
testing::AssertionResult same_impacts(std::span<const ImpactRow> expected,
                                      std::span<const ImpactRow> actual,
                                      std::span<const MovedPair> pairs);

ImpactRow impact_of(const MovedPair& pair, PositionType positions = PositionType::float64);

}  // namespace carom::test

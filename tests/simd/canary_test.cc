// Canaries for the compiler flags that equal bits rest on: every operation is rounded, and rounded
// once.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace carom {
namespace {

// These functions are inlined into callers with values that the compiler does not know: there it
// could contract or vectorise.
template <class T>
T multiply_add(T a, T b, T c) {
  return a * b + c;
}

template <class T>
T multiply_subtract(T a, T b, T c) {
  return c - a * b;
}

// Values that the compiler must treat as variable.
template <class T>
[[gnu::noinline]] std::array<T, 16> opaque(T value) {
  std::array<T, 16> values;
  for (T& v : values) v = value;
  __asm__ volatile("" : : "r"(values.data()) : "memory");
  return values;
}

// (1 + e)^2 - (1 + 2 e) is 0 with two roundings, and e^2 with one. Sum and difference compute their
// own product, since a product that is used twice is not contracted.
template <class T>
void expect_two_roundings(T e) {
  const std::array<T, 16> factors = opaque<T>(1 + e);
  const std::array<T, 16> addends = opaque<T>(-(1 + 2 * e));
  ASSERT_EQ(std::fma(factors[0], factors[0], addends[0]), e * e);
  std::array<T, 16> sums;
  for (size_t i = 0; i < sums.size(); ++i) {
    sums[i] = multiply_add(factors[i], factors[i], addends[i]);
  }
  for (const T sum : sums) EXPECT_EQ(sum, 0);

  const std::array<T, 16> others = opaque<T>(1 + e);
  std::array<T, 16> differences;
  for (size_t i = 0; i < differences.size(); ++i) {
    differences[i] = multiply_subtract(others[i], others[i], -addends[i]);
  }
  for (const T difference : differences) EXPECT_EQ(difference, 0);
}

TEST(Canary, ProductsAreRoundedBeforeTheyAreAdded) {
  expect_two_roundings<float>(0x1p-13f);
  expect_two_roundings<double>(0x1p-30);
}

// Three adjacent members invite SLP vectorisation: g++ 12 then drops the rounding to float.
struct Triple {
  double x, y, z;
};

[[gnu::noinline]] Triple rounded_to_float(const Triple& v) {
  return {static_cast<double>(static_cast<float>(v.x)),
          static_cast<double>(static_cast<float>(v.y)),
          static_cast<double>(static_cast<float>(v.z))};
}

// The remainders of a body's position after rounding to float32.
[[gnu::noinline]] Triple low_parts(const Triple& v) {
  return {v.x - static_cast<float>(v.x), v.y - static_cast<float>(v.y),
          v.z - static_cast<float>(v.z)};
}

TEST(Canary, DoublesAreRoundedToFloatOnTheWayToDouble) {
  const double x = opaque(1 + 0x1p-40)[0];
  const Triple rounded = rounded_to_float({x, 2 * x, 4 * x});
  EXPECT_EQ(rounded.x, 1);
  EXPECT_EQ(rounded.y, 2);
  EXPECT_EQ(rounded.z, 4);
  const Triple low = low_parts({x, 2 * x, 4 * x});
  EXPECT_EQ(low.x, 0x1p-40);
  EXPECT_EQ(low.y, 0x1p-39);
  EXPECT_EQ(low.z, 0x1p-38);

  const std::array<double, 16> values = opaque(x);
  std::array<double, 16> through_float;
  for (size_t i = 0; i < values.size(); ++i) through_float[i] = static_cast<float>(values[i]);
  for (const double value : through_float) EXPECT_EQ(value, 1);
}

// A compiler that reassociates sums turns TwoSum into zero.
TEST(Canary, SumsAreNotReassociated) {
  const float a = opaque(1.0f)[0];
  const float b = opaque(0x1p-30f)[0];
  const float sum = a + b;
  const float rounded_b = sum - a;
  EXPECT_EQ((a - (sum - rounded_b)) + (b - rounded_b), 0x1p-30f);
  EXPECT_EQ((a + b) + -a, 0);
}

TEST(Canary, SubnormalsNanAndSignedZeroAreKept) {
  const float smallest = opaque(std::bit_cast<float>(1u))[0];
  EXPECT_EQ(std::bit_cast<uint32_t>(smallest + smallest), 2u);
  EXPECT_EQ(std::bit_cast<uint32_t>(smallest * 0.5f), 0u);
  const float nan = opaque(std::nanf(""))[0];
  EXPECT_FALSE(nan == nan);
  EXPECT_FALSE(nan <= 1);
  const float zero = opaque(0.0f)[0];
  EXPECT_EQ(std::bit_cast<uint32_t>(-zero), 0x80000000u);
  EXPECT_EQ(std::bit_cast<uint32_t>(0 - zero), 0u);
}

TEST(Canary, DivisionAndSquareRootAreCorrectlyRounded) {
  EXPECT_EQ(opaque(1.0f)[0] / opaque(3.0f)[0], 0x1.555556p-2f);
  EXPECT_EQ(std::sqrt(opaque(2.0f)[0]), 0x1.6a09e6p+0f);
}

}  // namespace
}  // namespace carom

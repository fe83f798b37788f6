// Powers of two and exponents, beside those of the standard library.
#include "base/powers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace carom::test {
namespace {

TEST(Powers, OfTwoAreThoseOfTheStandardLibrary) {
  for (int exponent = -1022; exponent <= 1023; ++exponent) {
    EXPECT_EQ(power_of_two(exponent), std::ldexp(1.0, exponent)) << exponent;
  }
}

TEST(Powers, ExponentsAreThoseOfTheStandardLibrary) {
  for (int exponent = -1022; exponent <= 1023; ++exponent) {
    const double least = std::ldexp(1.0, exponent);
    const double most = least * (2 - 0x1p-52);
    for (const double x : {least, 1.5 * least, -least, most}) {
      EXPECT_EQ(exponent_of(x), std::ilogb(x)) << x;
    }
  }
}

TEST(Powers, ExponentsOfOtherNumbersAreOutOfRange) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_LT(exponent_of(0), -1022);
  EXPECT_LT(exponent_of(std::numeric_limits<double>::denorm_min()), -1022);
  EXPECT_EQ(exponent_of(-kInfinity), 1024);
  EXPECT_EQ(exponent_of(std::nan("")), 1024);
}

}  // namespace
}  // namespace carom::test

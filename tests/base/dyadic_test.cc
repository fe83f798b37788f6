// Exact numbers against rationals.
#include "base/dyadic.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

#include "base/surd.h"
#include "oracle/random.h"

namespace carom::test {

using namespace oracle;

namespace {

using Rational = boost::multiprecision::cpp_rational;

// Doubles of all magnitudes, subnormal ones included, and integers, so that sums cancel.
double draw(Random& random) {
  if (random.chance(0.2)) return static_cast<double>(random.below(9)) - 4;
  const int exponent = static_cast<int>(random.below(2000)) - 1070;
  const double mantissa = random.uniform(-1, 1);
  return std::ldexp(mantissa, random.chance(0.5) ? exponent : static_cast<int>(random.below(80)));
}

int sign(const Rational& x) { return x.sign(); }

TEST(Dyadic, SumsAndProductsAreExact) {
  Random random(1);
  for (int round = 0; round < 20000; ++round) {
    double x[4];
    Rational r[4];
    for (int i = 0; i < 4; ++i) r[i] = Rational(x[i] = draw(random));
    const Dyadic d = Dyadic(x[0]) * Dyadic(x[1]) - Dyadic(x[2]) * Dyadic(x[3]);
    const Rational exact = r[0] * r[1] - r[2] * r[3];
    ASSERT_EQ(d.sign(), sign(exact));
    const Dyadic square = d * d - Dyadic(x[0]) * Dyadic(x[2]) + Dyadic(x[1]);
    ASSERT_EQ(square.sign(), sign(exact * exact - r[0] * r[2] + r[1]));
    ASSERT_EQ((d - d).sign(), 0);
    ASSERT_EQ((d + -d).sign(), 0);
    ASSERT_EQ((-d).sign(), -d.sign());
  }
}

TEST(Dyadic, CarriesAndBorrowsGoAllTheWay) {
  Dyadic power = 1, sum = 0;
  for (int i = 0; i < 40; ++i) {
    sum = sum + power * Dyadic(0x1p32 - 1);
    power = power * Dyadic(0x1p32);
  }
  EXPECT_EQ((power - sum).sign(), 1);
  EXPECT_EQ((power - sum - Dyadic(1)).sign(), 0);
  EXPECT_EQ((sum + Dyadic(1) - power).sign(), 0);
  EXPECT_EQ((sum * sum - (power - Dyadic(1)) * (power - Dyadic(1))).sign(), 0);
}

TEST(Dyadic, IsAboutItsValue) {
  Random random(2);
  for (int round = 0; round < 2000; ++round) {
    const double x = draw(random), y = random.uniform(-2, 2);
    EXPECT_EQ(Dyadic(x).approximate(), x);
    const double product = x * y;
    EXPECT_NEAR((Dyadic(x) * Dyadic(y)).approximate(), product, std::fabs(product) * 0x1p-50);
  }
}

// (a + b sqrt(s))(c + d sqrt(s)) - e: the sign is checked by squaring in rationals.
TEST(Surd, SignsAreExact) {
  Random random(3);
  const auto small = [&] { return static_cast<double>(random.below(15)) - 7; };
  int zeros = 0;
  for (int round = 0; round < 20000; ++round) {
    const double a = small(), b = small(), c = small(), d = small(), e = small();
    const double s = static_cast<double>(random.below(9) + 1);
    const Dyadic radicand = s;
    using Number = Surd<Dyadic>;
    const Number x = Number(a, b, radicand) * Number(c, d, radicand) - Number(Dyadic(e));
    const double p = a * c + b * d * s - e, q = a * d + b * c;
    const double squares = p * p - q * q * s;  // integers: exact
    const int sign_p = (p > 0) - (p < 0), sign_q = (q > 0) - (q < 0);
    const int sign_s = (squares > 0) - (squares < 0);
    const int expected = sign_p == sign_q || sign_q == 0 ? sign_p
                         : sign_p == 0                   ? sign_q
                                                         : sign_p * sign_s;
    ASSERT_EQ(sign_of(x), expected)
        << a << " " << b << " " << c << " " << d << " " << e << " " << s;
    zeros += expected == 0;
  }
  EXPECT_GT(zeros, 50);
}

// sqrt(2) sqrt(3) = sqrt(6); (sqrt(2) + sqrt(3))^2 = 5 + 2 sqrt(6).
TEST(Surd, RootsNest) {
  using One = Surd<Dyadic>;
  using Two = Surd<One>;
  const Dyadic two = 2, three = 3;
  const Two root2 = One(Dyadic(0), Dyadic(1), two);
  const Two root3(One(Dyadic(0)), One(Dyadic(1)), three);
  const Two sum = root2 + root3;
  const Two square = sum * sum - Two(5);
  EXPECT_EQ(sign_of(square * square - Two(24)), 0);
  EXPECT_EQ(sign_of(square - Two(4.8989)), 1);
  EXPECT_EQ(sign_of(square - Two(4.899)), -1);
  EXPECT_EQ(sign_of(root2 - root3), -1);
  EXPECT_NEAR(approximately(sum), std::sqrt(2) + std::sqrt(3), 1e-14);
}

}  // namespace
}  // namespace carom::test

// Exact numbers a + b sqrt(s), with sums, products and signs. Nested (Base is a Surd) for more than
// one root.
#pragma once

#include <cmath>

#include "base/dyadic.h"

namespace carom {

// All numbers of one computation have the same radicand, a positive number that outlives them. A
// number without a root needs no radicand.
template <class Base>
class Surd {
 public:
  Surd() = default;
  Surd(const Base& a) : a_(a) {}  // NOLINT(google-explicit-constructor): as numbers mix
  Surd(double a) : a_(a) {}       // NOLINT(google-explicit-constructor)
  Surd(const Base& a, const Base& b, const Dyadic& radicand) : a_(a), b_(b), radicand_(&radicand) {}

  friend Surd operator-(const Surd& x) { return {-x.a_, -x.b_, x.radicand_}; }
  friend Surd operator+(const Surd& x, const Surd& y) {
    return {x.a_ + y.a_, x.b_ + y.b_, radicand(x, y)};
  }
  friend Surd operator-(const Surd& x, const Surd& y) {
    return {x.a_ - y.a_, x.b_ - y.b_, radicand(x, y)};
  }
  friend Surd operator*(const Surd& x, const Surd& y) {
    const Dyadic* s = radicand(x, y);
    Base a = x.a_ * y.a_;
    if (x.radicand_ && y.radicand_) a = a + x.b_ * y.b_ * Base(*s);
    return {a, x.a_ * y.b_ + x.b_ * y.a_, s};
  }

  friend int sign_of(const Surd& x) {
    const int a = sign_of(x.a_), b = sign_of(x.b_);
    if (b == 0 || a == b) return a;
    if (a == 0) return b;
    return a * sign_of(x.a_ * x.a_ - x.b_ * x.b_ * Base(*x.radicand_));
  }

  friend double approximately(const Surd& x) {
    return approximately(x.a_) + approximately(x.b_) * x.approximate_root();
  }
  // The sum of the two parts' magnitudes, since the parts may cancel.
  friend double magnitude(const Surd& x) {
    return magnitude(x.a_) + magnitude(x.b_) * x.approximate_root();
  }

 private:
  Surd(const Base& a, const Base& b, const Dyadic* radicand) : a_(a), b_(b), radicand_(radicand) {}

  double approximate_root() const { return radicand_ ? std::sqrt(approximately(*radicand_)) : 0; }

  static const Dyadic* radicand(const Surd& x, const Surd& y) {
    return x.radicand_ ? x.radicand_ : y.radicand_;
  }

  Base a_{0.0}, b_{0.0};
  const Dyadic* radicand_ = nullptr;
};

}  // namespace carom

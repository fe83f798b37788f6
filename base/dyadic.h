// Exact arithmetic on integers times powers of two, of any size. Every float and every double is
// such a number, and so are their sums and products.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace carom {

// The value is sign * (limb[0] + limb[1] 2^64 + ...) * 2^(64 low). The first and the last limb are
// never zero; the number zero has no limbs. Up to kInline limbs lie in the object itself, which is
// enough for shapes of usual sizes.
class Dyadic {
 public:
  Dyadic() = default;
  Dyadic(double value);  // NOLINT(google-explicit-constructor): numbers are meant to mix

  int sign() const { return sign_; }
  bool is_zero() const { return sign_ == 0; }

  // The value with a relative error of about 2^-50; infinite or zero beyond the range of double.
  double approximate() const;

  friend Dyadic operator-(Dyadic a) {
    a.sign_ = -a.sign_;
    return a;
  }
  friend Dyadic operator+(const Dyadic& a, const Dyadic& b) { return sum(a, b, b.sign_); }
  friend Dyadic operator-(const Dyadic& a, const Dyadic& b) { return sum(a, b, -b.sign_); }
  friend Dyadic operator*(const Dyadic& a, const Dyadic& b);

 private:
  static constexpr size_t kInline = 12;
  using Limbs = std::span<const uint64_t>;

  Limbs limbs() const { return {more_.empty() ? few_.data() : more_.data(), size_}; }
  uint64_t* make_room(size_t limbs);
  void set(std::span<uint64_t> limbs, int low, int sign);
  int64_t top() const { return int64_t{low_} + static_cast<int64_t>(size_); }
  uint64_t limb_at(int64_t place) const;

  static Dyadic sum(const Dyadic& a, const Dyadic& b, int sign_of_b);
  static int compare_magnitudes(const Dyadic& a, const Dyadic& b);

  int sign_ = 0;
  int32_t low_ = 0;
  size_t size_ = 0;
  std::array<uint64_t, kInline> few_;
  std::vector<uint64_t> more_;  // used instead of few_ if there are more than kInline limbs
};

inline int sign_of(const Dyadic& x) { return x.sign(); }
inline double approximately(const Dyadic& x) { return x.approximate(); }
// The rounding error of approximately() is proportional to this.
inline double magnitude(const Dyadic& x) { return std::fabs(x.approximate()); }

}  // namespace carom

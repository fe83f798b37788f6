// Schoolbook arithmetic on limbs (D. E. Knuth, The Art of Computer Programming 2, 3rd ed., 4.3.1).
#include "base/dyadic.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

__extension__ using Wide = unsigned __int128;

// Zeroed space for the result of one operation.
class Workspace {
 public:
  explicit Workspace(size_t limbs) {
    if (limbs > few_.size()) more_.resize(limbs);
    limbs_ = {more_.empty() ? few_.data() : more_.data(), limbs};
    std::fill(limbs_.begin(), limbs_.end(), uint64_t{0});
  }

  std::span<uint64_t> limbs() { return limbs_; }

 private:
  std::array<uint64_t, 32> few_;
  std::vector<uint64_t> more_;
  std::span<uint64_t> limbs_;
};

}  // namespace

Dyadic::Dyadic(double value) {
  if (value == 0) return;
  int exponent = 0;
  const double fraction = std::frexp(std::fabs(value), &exponent);
  const auto mantissa = static_cast<uint64_t>(std::ldexp(fraction, 53));
  const int shift = exponent - 53;
  const int low = shift >= 0 ? shift / 64 : -((63 - shift) / 64);
  const Wide placed = Wide{mantissa} << (shift - 64 * low);
  std::array<uint64_t, 2> limbs = {static_cast<uint64_t>(placed),
                                   static_cast<uint64_t>(placed >> 64)};
  set(limbs, low, value < 0 ? -1 : 1);
}

uint64_t* Dyadic::make_room(size_t limbs) {
  more_.clear();
  if (limbs > kInline) more_.resize(limbs);
  size_ = limbs;
  return more_.empty() ? few_.data() : more_.data();
}

// Copies the limbs without the zeros at both ends.
void Dyadic::set(std::span<uint64_t> limbs, int low, int sign) {
  while (!limbs.empty() && limbs.back() == 0) limbs = limbs.first(limbs.size() - 1);
  while (!limbs.empty() && limbs.front() == 0) {
    limbs = limbs.subspan(1);
    ++low;
  }
  std::copy(limbs.begin(), limbs.end(), make_room(limbs.size()));
  sign_ = limbs.empty() ? 0 : sign;
  low_ = limbs.empty() ? 0 : low;
}

uint64_t Dyadic::limb_at(int64_t place) const {
  const int64_t i = place - low_;
  return i < 0 || i >= static_cast<int64_t>(size_) ? 0 : limbs()[static_cast<size_t>(i)];
}

int Dyadic::compare_magnitudes(const Dyadic& a, const Dyadic& b) {
  const int64_t low = std::min(a.low_, b.low_);
  for (int64_t place = std::max(a.top(), b.top()) - 1; place >= low; --place) {
    const uint64_t x = a.limb_at(place), y = b.limb_at(place);
    if (x != y) return x < y ? -1 : 1;
  }
  return 0;
}

Dyadic Dyadic::sum(const Dyadic& a, const Dyadic& b, int sign_of_b) {
  if (sign_of_b == 0) return a;
  if (a.sign_ == 0) {
    Dyadic result = b;
    result.sign_ = sign_of_b;
    return result;
  }
  const bool adds = a.sign_ == sign_of_b;
  const bool a_is_greater = adds || compare_magnitudes(a, b) >= 0;
  const Dyadic& greater = a_is_greater ? a : b;
  const Dyadic& lesser = a_is_greater ? b : a;
  const int low = std::min(a.low_, b.low_);
  Workspace space(static_cast<size_t>(std::max(a.top(), b.top()) - low + 1));
  const std::span<uint64_t> limbs = space.limbs();
  uint64_t carry = 0;
  for (size_t i = 0; i < limbs.size(); ++i) {
    const int64_t place = low + static_cast<int64_t>(i);
    const uint64_t x = greater.limb_at(place), y = lesser.limb_at(place);
    const Wide both = adds ? Wide{x} + y + carry : Wide{x} - y - carry;
    limbs[i] = static_cast<uint64_t>(both);
    carry = static_cast<uint64_t>(both >> 64) & 1;
  }
  Dyadic result;
  result.set(limbs, low, a_is_greater ? a.sign_ : sign_of_b);
  return result;
}

Dyadic operator*(const Dyadic& a, const Dyadic& b) {
  if (a.is_zero() || b.is_zero()) return {};
  Workspace space(a.size_ + b.size_);
  const std::span<uint64_t> limbs = space.limbs();
  const Dyadic::Limbs x = a.limbs(), y = b.limbs();
  for (size_t i = 0; i < x.size(); ++i) {
    uint64_t carry = 0;
    for (size_t j = 0; j < y.size(); ++j) {
      const Wide product = Wide{x[i]} * y[j] + limbs[i + j] + carry;
      limbs[i + j] = static_cast<uint64_t>(product);
      carry = static_cast<uint64_t>(product >> 64);
    }
    limbs[i + y.size()] = carry;
  }
  Dyadic result;
  result.set(limbs, a.low_ + b.low_, a.sign_ * b.sign_);
  return result;
}

double Dyadic::approximate() const {
  double value = 0;
  const int64_t last = std::max<int64_t>(low_, top() - 2);
  for (int64_t place = top() - 1; place >= last; --place) {
    const int64_t exponent = std::clamp<int64_t>(64 * place, -100000, 100000);
    value += std::ldexp(static_cast<double>(limb_at(place)), static_cast<int>(exponent));
  }
  return sign_ < 0 ? -value : value;
}

}  // namespace carom

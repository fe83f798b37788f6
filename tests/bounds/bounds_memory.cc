#include "tests/bounds/bounds_memory.h"

namespace carom::test {

BoundsMemory::BoundsMemory(size_t count) {
  for (int i = 0; i < 6; ++i) columns_.emplace_back(count, sizeof(float), sizeof(float));
}

BoundsColumns BoundsMemory::out() {
  const auto at = [&](int i) { return columns_[i].as<float>(); };
  return {{at(0), at(1), at(2)}, {at(3), at(4), at(5)}};
}

reference::Box BoundsMemory::box(size_t i) const {
  reference::Box box;
  for (int axis = 0; axis < 3; ++axis) {
    box.lower[axis] = columns_[axis].get<float>(i);
    box.upper[axis] = columns_[3 + axis].get<float>(i);
  }
  return box;
}

bool same_bits(const reference::Box& x, const reference::Box& y) {
  return std::memcmp(x.lower.data(), y.lower.data(), sizeof x.lower) == 0 &&
         std::memcmp(x.upper.data(), y.upper.data(), sizeof x.upper) == 0;
}

}  // namespace carom::test

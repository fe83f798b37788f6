// Makes random shapes from bytes.
#pragma once

#include <cmath>
#include <cstdint>

#include "fuzz/take.h"
#include "oracle/convex_random.h"

namespace carom::fuzz {

inline float take_length(double size, uint8_t form, Data& data) {
  const bool is_flat = (form & 1) != 0 && take<uint8_t>(data) % 4 == 0;
  return is_flat ? 0 : static_cast<float>(size * std::abs(take_unit(data)));
}

// `form` gives the style, the data the seed; of round shapes the sizes.
inline Shape take_random_shape(ShapeKind kind, uint8_t form, double size, Data& data) {
  const auto length = [&] { return take_length(size, form, data); };
  const auto rounding = [&] { return (form & 8) != 0 ? length() : 0; };
  if (kind == ShapeKind::cylinder) return Cylinder{length(), length(), rounding()};
  if (kind == ShapeKind::cone) return Cone{length(), length(), rounding()};
  if (kind == ShapeKind::ellipsoid) {
    return Ellipsoid{{length(), length(), length()}, rounding()};
  }
  oracle::Random random(take<uint64_t>(data));
  oracle::ConvexRandom shapes({.aspect = std::pow(10.0, form >> 4 & 7),
                               .degenerate = (form & 1) != 0,
                               .lattice = (form & 2) != 0,
                               .aligned = (form & 4) != 0},
                              random);
  return shapes.shape(kind, size);
}

}  // namespace carom::fuzz

// Makes random shapes from bytes.
#pragma once

#include <cmath>
#include <cstdint>

#include "fuzz/take.h"
#include "oracle/convex_random.h"

namespace carom::fuzz {

// `form` gives the style, the data the seed.
inline Shape take_random_shape(ShapeKind kind, uint8_t form, double size, Data& data) {
  oracle::Random random(take<uint64_t>(data));
  oracle::ConvexRandom shapes({.aspect = std::pow(10.0, form >> 4 & 7),
                               .degenerate = (form & 1) != 0,
                               .lattice = (form & 2) != 0,
                               .aligned = (form & 4) != 0},
                              random);
  return shapes.shape(kind, size);
}

}  // namespace carom::fuzz

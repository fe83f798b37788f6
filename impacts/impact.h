// First times of impact, and the parts that meet then.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "carom/results/contact.h"
#include "midphase/placed_part.h"

namespace carom {

struct FirstTime {
  double time;  // infinite: never; NaN: no answer
  Status status = Status::ok;
  std::array<uint64_t, 2> parts{};  // that meet (PlacedPart::order()); zero for simple shapes
};

// Which times of pairs are of use.
struct TimesWanted {
  // One a pair, or nullptr: a time that is greater need not be found; the answer may be a greater
  // one, or never.
  const double* latest = nullptr;
  // Whether there is a time up to `latest` is enough; the answer may be `latest`, without parts.
  bool any = false;
};

// The first times of the pairs of a block. `parts` is set for pairs with composites only.
struct FirstTimes {
  const double* time;
  const std::array<uint64_t, 2>* parts;
  size_t count;
};

// The part of a body with this order.
inline PlacedPart part_at(const PlacedPart& body, uint64_t order) {
  PlacedPart result = body;
  if (result.kind() == ShapeKind::compound)
    result = result.item(static_cast<uint32_t>(order >> 32));
  if (is_surface(result.kind())) result = result.item(static_cast<uint32_t>(order));
  return result;
}

// The number by which results name a part: the child of a compound, or the triangle of a surface.
inline uint32_t sub_shape(ShapeKind kind, uint64_t order) {
  return static_cast<uint32_t>(kind == ShapeKind::compound ? order >> 32 : order);
}

}  // namespace carom

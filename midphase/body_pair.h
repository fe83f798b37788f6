// The two bodies of a pair, placed for the search of their parts.
#pragma once

#include "carom/results/pair.h"
#include "midphase/placed_part.h"
#include "shapes/body_reader.h"

namespace carom {

// Two placed bodies.
struct BodyPair {
  Part part_a, part_b;
  PlacedPart a, b;

  // Positions are in world coordinates. If there is a compound, they are relative to A, since
  // children are placed in double precision.
  BodyPair(const BodyReader& reader_a, const BodyReader& reader_b, Pair pair)
      : part_a(body_part(reader_a, pair.a)),
        part_b(body_part(reader_b, pair.b)),
        a(part_a, position(reader_a, pair.a)),
        b(part_b, position(reader_b, pair.b)) {
    if (part_a.kind != ShapeKind::compound && part_b.kind != ShapeKind::compound) return;
    b.position = minus(b.position, a.position);
    a.position = {};
  }
  BodyPair(const BodyPair&) = delete;
  BodyPair& operator=(const BodyPair&) = delete;

 private:
  static Double3 position(const BodyReader& reader, size_t i) {
    const Position<double> p = reader.position<double>(i);
    return {p.x, p.y, p.z};
  }
};

}  // namespace carom

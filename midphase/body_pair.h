// The two bodies of a pair, placed for the search of their parts.
#pragma once

#include "carom/results/pair.h"
#include "midphase/placed_part.h"
#include "shapes/body_reader.h"

namespace carom {

// Two placed bodies.
struct BodyPair {
  Part part_a, part_b;
  Double3 stored_a, stored_b;  // positions
  PlacedPart a, b;

  // Positions are relative to A, since parts are placed in double precision. Proofs about compounds
  // are about such positions as well.
  BodyPair(const BodyReader& reader_a, const BodyReader& reader_b, Pair pair)
      : part_a(body_part(reader_a, pair.a)),
        part_b(body_part(reader_b, pair.b)),
        stored_a(position(reader_a, pair.a)),
        stored_b(position(reader_b, pair.b)),
        a(part_a, {}),
        b(part_b, minus(stored_b, stored_a)) {
    if (part_a.kind == ShapeKind::compound || part_b.kind == ShapeKind::compound) return;
    a.stored = &stored_a;
    b.stored = &stored_b;
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

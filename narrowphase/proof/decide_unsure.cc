#include "narrowphase/proof/decide_unsure.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "narrowphase/batch/single_pair.h"
#include "narrowphase/proof/exact_overlap.h"
#include "narrowphase/proof/proof.h"
#include "narrowphase/proof/upright_boxes.h"

namespace carom {
namespace {

uint8_t decide(const BodyReader& a, const BodyReader& b, Pair pair, Tier tier) {
  UprightBox box_a, box_b;
  if (read_upright_box(a, pair.a, box_a) && read_upright_box(b, pair.b, box_b)) {
    return do_overlap(box_a, box_b);
  }
  const StatedBody body_a = stated_body(a, pair.a), body_b = stated_body(b, pair.b);
  const uint8_t proven = prove_overlap(body_a, body_b);
  if (proven != kUndecided || tier != Tier::exact) return proven;
  return exact_overlap(body_a, body_b);
}

// The next unsure row, or count. Unsure rows are rare, so the loop skips eight rows at a time.
size_t next_marked(const uint8_t* marks, size_t row, size_t count) {
  while (row < count) {
    uint64_t eight = 0;
    std::memcpy(&eight, marks + row, std::min<size_t>(count - row, sizeof eight));
    if (eight != 0) break;
    row += sizeof eight;
  }
  while (row < count && !marks[row]) ++row;
  return std::min(row, count);
}

}  // namespace

float with_sign_of(uint8_t overlap, float separation) {
  if (overlap == 1 && !(separation <= 0)) return 0;
  if (overlap == 0 && !(separation > 0)) return std::numeric_limits<float>::denorm_min();
  return separation;
}

void decide_unsure(const PairKind& kind, const Batch& batch, Tier tier) {
  const Collidables view_a = view_of(batch.a, batch.layout, kind.a);
  const Collidables view_b = view_of(batch.b, batch.layout, kind.b);
  const BodyReader a{view_a};
  const BodyReader b{view_b};
  for (size_t row = 0;; ++row) {
    row = next_marked(batch.unsure, row, batch.count);
    if (row == batch.count) return;
    const uint8_t overlap = decide(a, b, batch.pairs[row], tier);
    batch.out.overlap[row] = overlap;
    if (!has_contacts(batch.detail)) continue;
    float& separation = batch.out.separation[row];
    separation = with_sign_of(overlap, separation);
  }
}

}  // namespace carom

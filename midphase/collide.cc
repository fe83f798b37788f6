#include "carom/narrowphase/collide.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <string>

#include "base/parallel.h"
#include "midphase/collide_pairs.h"
#include "midphase/mixed_block.h"
#include "narrowphase/blocks/pair_block.h"
#include "narrowphase/pairs/pair_kinds.h"
#include "shapes/body_reader.h"

namespace carom {
namespace {

using KindSet = std::array<bool, 256>;

KindSet kinds_in(const Collidables& bodies) {
  KindSet present{};
  if (!bodies.kind) {
    present[static_cast<uint8_t>(bodies.uniform_kind)] = bodies.count > 0;
  } else {
    for (size_t i = 0; i < bodies.count; ++i) present[static_cast<uint8_t>(bodies.kind[i])] = true;
  }
  return present;
}

Error no_kernel(ShapeKind a, ShapeKind b) {
  return {std::string("no kernel for ") + name(a) + " against " + name(b)};
}

// Whether going through the pairs is cheaper than going through all bodies.
bool is_short(const Collidables& a, const Collidables& b, size_t pairs) {
  return pairs < (a.count + b.count) / 8;
}

bool do_all_kinds_meet(const Collidables& a, const Collidables& b) {
  const KindSet in_a = kinds_in(a);
  const KindSet in_b = kinds_in(b);
  bool all_meet = true;
  for (size_t i = 0; i < in_a.size(); ++i) {
    for (size_t j = 0; j < in_b.size(); ++j) {
      if (!in_a[i] || !in_b[j]) continue;
      all_meet = all_meet && supports(static_cast<ShapeKind>(i), static_cast<ShapeKind>(j));
    }
  }
  return all_meet;
}

// Checks the kinds that occur. If some of them have no kernel, or if there are few pairs, checks
// every pair.
template <class PairAt>
Result<void> check_kinds(const Collidables& a, const Collidables& b, size_t count,
                         const PairAt& pair_at) {
  if (!is_short(a, b, count) && do_all_kinds_meet(a, b)) return {};
  const BodyReader reader_a{a};
  const BodyReader reader_b{b};
  for (size_t i = 0; i < count; ++i) {
    const Pair pair = pair_at(i);
    const ShapeKind kind_a = reader_a.kind(pair.a);
    const ShapeKind kind_b = reader_b.kind(pair.b);
    if (!supports(kind_a, kind_b)) return no_kernel(kind_a, kind_b);
  }
  return {};
}

bool has_composites(const Collidables& bodies) {
  if (!bodies.kind) return is_composite(bodies.uniform_kind);
  bool found = false;  // without a branch, to read many kinds at once
  for (size_t i = 0; i < bodies.count; ++i) found |= is_composite(bodies.kind[i]);
  return found;
}

// `pairs` nullptr: the pairs are (0, 0), (1, 1), ...
bool may_have_composites(const Collidables& a, const Collidables& b, const Pair* pairs,
                         size_t count) {
  if (!pairs || !is_short(a, b, count)) return has_composites(a) || has_composites(b);
  const BodyReader reader_a{a}, reader_b{b};
  return std::any_of(pairs, pairs + count, [&](const Pair& pair) {
    return is_composite(reader_a.kind(pair.a)) || is_composite(reader_b.kind(pair.b));
  });
}

void fill_sub_shapes(const ResultColumns& out, size_t begin, size_t end) {
  for (uint32_t* column : {out.sub_a, out.sub_b}) {
    if (column) std::fill(column + begin, column + end, 0u);
  }
}

void collide_blocks(const Collidables& a, const Collidables& b, const Pair* pairs, size_t count,
                    Detail detail, const ResultColumns& out, WitnessFrame frame, Measured measured,
                    uint32_t* direction, Parallelism parallelism, const Accuracy& accuracy) {
  if (detail == Detail::pairs || count == 0) return;
  const bool composites = may_have_composites(a, b, pairs, count);
  for_each_block(count, kPairsPerBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    if (has_contacts(detail)) fill_sub_shapes(out, begin, end);
    const auto run = composites ? run_mixed_block : run_pair_block;
    run({.a = a,
         .b = b,
         .pairs = pairs ? pairs + begin : nullptr,
         .first = begin,
         .count = end - begin,
         .detail = detail,
         .frame = frame,
         .measured = measured,
         .direction = direction ? direction + begin : nullptr,
         .accuracy = accuracy,
         .out = from_row(out, begin)});
  });
}

}  // namespace

// Composites work with all kinds: their parts have kernels against all shapes with bounds, and
// parts without a kernel are skipped.
bool supports(ShapeKind a, ShapeKind b) {
  const auto is_shape = [](ShapeKind kind) {
    return static_cast<size_t>(kind) < size_t{kShapeKindCount};
  };
  const bool composites = is_composite(a) || is_composite(b);
  return composites ? is_shape(a) && is_shape(b) : find_pair_kind(a, b).exists();
}

Result<void> check_pairs(const Collidables& a, const Collidables& b, std::span<const Pair> pairs) {
  return check_kinds(a, b, pairs.size(), [&](size_t i) { return pairs[i]; });
}

Result<void> collide(const Collidables& a, const Collidables& b, std::span<const Pair> pairs,
                     Detail detail, const ResultColumns& out, WitnessFrame frame,
                     Parallelism parallelism, Measured measured, const Accuracy& accuracy) {
  if (Result<void> checked = check_pairs(a, b, pairs); !checked) return checked;
  collide_blocks(a, b, pairs.data(), pairs.size(), detail, out, frame, measured, nullptr,
                 parallelism, accuracy);
  return {};
}

Result<void> collide_rows(const Collidables& a, const Collidables& b, Detail detail,
                          const ResultColumns& out, WitnessFrame frame, Parallelism parallelism,
                          Measured measured, const Accuracy& accuracy) {
  assert(a.count == b.count);
  const auto pair_at = [](size_t i) -> Pair {
    return {static_cast<uint32_t>(i), static_cast<uint32_t>(i)};
  };
  if (Result<void> checked = check_kinds(a, b, a.count, pair_at); !checked) return checked;
  collide_blocks(a, b, nullptr, a.count, detail, out, frame, measured, nullptr, parallelism,
                 accuracy);
  return {};
}

void collide_pairs(const Collidables& bodies, std::span<const Pair> pairs, Detail detail,
                   const ResultColumns& out, uint32_t* direction, Parallelism parallelism,
                   const Accuracy& accuracy) {
  collide_blocks(bodies, bodies, pairs.data(), pairs.size(), detail, out, WitnessFrame::body,
                 Measured::overlapping, direction, parallelism, accuracy);
}

bool uses_directions(ShapeKind a, ShapeKind b) {
  const PairKindRef kind = find_pair_kind(a, b);
  return kind.exists() && kPairKinds[kind.index].has_direction_pass();
}

}  // namespace carom

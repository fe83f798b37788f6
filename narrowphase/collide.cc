#include "carom/narrowphase/collide.h"

#include <array>
#include <cassert>
#include <string>

#include "kernel/parallel.h"
#include "narrowphase/collide_pairs.h"
#include "narrowphase/pair_block.h"
#include "narrowphase/pair_kinds.h"

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

Result<void> check_kinds(const Collidables& a, const Collidables& b) {
  const KindSet in_a = kinds_in(a);
  const KindSet in_b = kinds_in(b);
  for (size_t i = 0; i < in_a.size(); ++i) {
    for (size_t j = 0; j < in_b.size(); ++j) {
      const auto kind_a = static_cast<ShapeKind>(i);
      const auto kind_b = static_cast<ShapeKind>(j);
      if (in_a[i] && in_b[j] && !supports(kind_a, kind_b)) {
        return Error{std::string("no kernel for ") + name(kind_a) + " against " + name(kind_b)};
      }
    }
  }
  return {};
}

void collide_blocks(const Collidables& a, const Collidables& b, const Pair* pairs, size_t count,
                    Detail detail, const ResultColumns& out, WitnessFrame frame,
                    Parallelism parallelism) {
  if (detail == Detail::pairs) return;
  for_each_block(count, kPairsPerBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    run_pair_block({.a = a,
                    .b = b,
                    .pairs = pairs ? pairs + begin : nullptr,
                    .first = begin,
                    .count = end - begin,
                    .detail = detail,
                    .frame = frame,
                    .out = from_row(out, begin)});
  });
}

}  // namespace

bool supports(ShapeKind a, ShapeKind b) { return find_pair_kind(a, b).exists(); }

Result<void> collide(const Collidables& a, const Collidables& b, std::span<const Pair> pairs,
                     Detail detail, const ResultColumns& out, WitnessFrame frame,
                     Parallelism parallelism) {
  if (Result<void> checked = check_kinds(a, b); !checked) return checked;
  collide_blocks(a, b, pairs.data(), pairs.size(), detail, out, frame, parallelism);
  return {};
}

Result<void> collide_rows(const Collidables& a, const Collidables& b, Detail detail,
                          const ResultColumns& out, WitnessFrame frame, Parallelism parallelism) {
  assert(a.count == b.count);
  if (Result<void> checked = check_kinds(a, b); !checked) return checked;
  collide_blocks(a, b, nullptr, a.count, detail, out, frame, parallelism);
  return {};
}

void collide_pairs(const Collidables& bodies, std::span<const Pair> pairs, Detail detail,
                   const ResultColumns& out, Parallelism parallelism) {
  collide_blocks(bodies, bodies, pairs.data(), pairs.size(), detail, out, WitnessFrame::body,
                 parallelism);
}

}  // namespace carom

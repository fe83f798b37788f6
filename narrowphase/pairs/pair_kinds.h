// The dispatch table of pair kinds.
#pragma once

#include <array>
#include <cstdint>

#include "carom/shapes/shape.h"
#include "narrowphase/batch/batch.h"
#include "shapes/rounding.h"

namespace carom {

struct PairKind {
  ShapeKind a;
  ShapeKind b;
  void (*run)(const Batch& batch);
  MorePasses more;

  constexpr bool has_recall_pass() const { return more == MorePasses::recall_and_clearance; }
  // Whether the distance pass replaces the test: it fills every row (GJK kinds).
  constexpr bool measures_at_once() const {
    return more == MorePasses::clearance || has_recall_pass();
  }
  // Whether the test measures separate rows, if the batch says that they are to be.
  bool measures_in_test() const { return is_rounded(a) || is_rounded(b) || is_general(); }
  // Whether round shapes are tested without a kernel of their own.
  constexpr bool is_general() const {
    return more == MorePasses::distance && (is_round(a) || is_round(b));
  }
  // Where the test takes longer than looking for the direction of the last step.
  bool has_direction_pass() const { return measures_at_once(); }
  bool has_shell_pass() const { return a == ShapeKind::hull && b == ShapeKind::hull; }
  bool has_distance_pass() const { return more == MorePasses::distance || measures_at_once(); }
  bool has_manifold_pass() const { return more != MorePasses::none; }
};

inline constexpr std::array kListedPairKinds = {
#define CAROM_PAIR(name, kind_a, kind_b, passes) \
  PairKind{ShapeKind::kind_a, ShapeKind::kind_b, run_##name, MorePasses::passes},
#include "narrowphase/pairs/pair_list.inc"
#undef CAROM_PAIR
};

// Round shapes with all convex ones: those that are not in the list are tested as cores.
template <ShapeKind kA, ShapeKind kB>
void run_round(const Batch& batch) {
  run_round_pair(batch, kA, kB);
}
template <ShapeKind kA, ShapeKind kB>
inline constexpr PairKind kRoundPairKind = [] {
  constexpr ShapeKind kFirst = comes_after(kA, kB) ? kB : kA;
  constexpr ShapeKind kSecond = comes_after(kA, kB) ? kA : kB;
  return PairKind{kFirst, kSecond, &run_round<kFirst, kSecond>, MorePasses::distance};
}();
template <ShapeKind kRound>
inline constexpr std::array kPairKindsOfRound = {
    kRoundPairKind<ShapeKind::sphere, kRound>,    kRoundPairKind<ShapeKind::capsule, kRound>,
    kRoundPairKind<ShapeKind::aabb, kRound>,      kRoundPairKind<ShapeKind::box, kRound>,
    kRoundPairKind<ShapeKind::dop, kRound>,       kRoundPairKind<ShapeKind::hull, kRound>,
    kRoundPairKind<ShapeKind::halfspace, kRound>, kRoundPairKind<ShapeKind::triangle, kRound>};

// Whether one of the first `count` kinds of a list is for these shapes.
template <class List>
constexpr bool has_pair_kind(const List& list, size_t count, const PairKind& kind) {
  for (size_t i = 0; i < count; ++i) {
    if (list[i].a == kind.a && list[i].b == kind.b) return true;
  }
  return false;
}

// The list, and what else there is of these round shapes, each once; how many there are.
template <ShapeKind... kRounds>
constexpr auto with_round_pairs() {
  constexpr size_t kOfEach = kPairKindsOfRound<ShapeKind::cylinder>.size() + sizeof...(kRounds);
  struct {
    std::array<PairKind, kListedPairKinds.size() + sizeof...(kRounds) * kOfEach> kinds{};
    size_t count = 0;
  } all;
  for (const PairKind& kind : kListedPairKinds) all.kinds[all.count++] = kind;
  const auto add = [&all](const PairKind& kind) {
    if (!has_pair_kind(all.kinds, all.count, kind)) all.kinds[all.count++] = kind;
  };
  const auto add_all = [&]<ShapeKind kRound>() {
    for (const PairKind& kind : kPairKindsOfRound<kRound>) add(kind);
    (add(kRoundPairKind<kRound, kRounds>), ...);
  };
  (add_all.template operator()<kRounds>(), ...);
  return all;
}

// All round shapes, as is_round() says.
inline constexpr auto kManyPairKinds =
    with_round_pairs<ShapeKind::cylinder, ShapeKind::cone, ShapeKind::ellipsoid>();

inline constexpr auto kCorePairKinds = [] {
  std::array<PairKind, kManyPairKinds.count> kinds{};
  for (size_t i = 0; i < kinds.size(); ++i) kinds[i] = kManyPairKinds.kinds[i];
  return kinds;
}();

// Boxes and hulls with a rounding, by the tests of their cores: where those measure at once, or in
// one pass, so do these.
template <ShapeKind kA, ShapeKind kB>
void run_rounded(const Batch& batch) {
  run_rounded_pair(batch, kA, kB);
}

constexpr MorePasses passes_of_rounded(ShapeKind a, ShapeKind b) {
  for (const PairKind& core : kCorePairKinds) {
    if (core.a != core_kind(a) || core.b != core_kind(b)) continue;
    return core.measures_at_once() ? MorePasses::manifold : core.more;
  }
  return MorePasses::none;
}

template <ShapeKind kA, ShapeKind kB>
inline constexpr PairKind kRoundedPairKind = [] {
  constexpr ShapeKind kFirst = comes_after(kA, kB) ? kB : kA;
  constexpr ShapeKind kSecond = comes_after(kA, kB) ? kA : kB;
  return PairKind{kFirst, kSecond, &run_rounded<kFirst, kSecond>,
                  passes_of_rounded(kFirst, kSecond)};
}();
template <ShapeKind kRounded>
inline constexpr std::array kRoundedPairKinds = {
    kRoundedPairKind<ShapeKind::sphere, kRounded>,
    kRoundedPairKind<ShapeKind::capsule, kRounded>,
    kRoundedPairKind<ShapeKind::aabb, kRounded>,
    kRoundedPairKind<ShapeKind::box, kRounded>,
    kRoundedPairKind<ShapeKind::dop, kRounded>,
    kRoundedPairKind<ShapeKind::hull, kRounded>,
    kRoundedPairKind<ShapeKind::halfspace, kRounded>,
    kRoundedPairKind<ShapeKind::triangle, kRounded>,
    kRoundedPairKind<ShapeKind::cylinder, kRounded>,
    kRoundedPairKind<ShapeKind::cone, kRounded>,
    kRoundedPairKind<ShapeKind::ellipsoid, kRounded>,
    kRoundedPairKind<ShapeKind::rounded_box, kRounded>};

inline constexpr auto kPairKinds = [] {
  constexpr auto kBoxes = kRoundedPairKinds<ShapeKind::rounded_box>;
  constexpr auto kHulls = kRoundedPairKinds<ShapeKind::rounded_hull>;
  std::array<PairKind, kCorePairKinds.size() + kBoxes.size() + kHulls.size() + 1> all{};
  auto* next = all.data();
  for (const PairKind& kind : kCorePairKinds) *next++ = kind;
  for (const PairKind& kind : kBoxes) *next++ = kind;
  for (const PairKind& kind : kHulls) *next++ = kind;
  *next = kRoundedPairKind<ShapeKind::rounded_hull, ShapeKind::rounded_hull>;
  return all;
}();

// The kernel that tests a against b. `flipped`: with the sides exchanged, since kernels exist for
// one order only.
struct PairKindRef {
  uint8_t index = 0xff;
  bool flipped = false;

  bool exists() const { return index != 0xff; }
};

// Indexed by the kinds of both sides.
inline constexpr auto kPairKindTable = [] {
  std::array<std::array<PairKindRef, kShapeKindCount>, kShapeKindCount> table{};
  for (size_t i = 0; i < kPairKinds.size(); ++i) {
    const auto a = static_cast<size_t>(kPairKinds[i].a);
    const auto b = static_cast<size_t>(kPairKinds[i].b);
    table[b][a] = {static_cast<uint8_t>(i), true};
    table[a][b] = {static_cast<uint8_t>(i), false};
  }
  return table;
}();

constexpr PairKindRef find_pair_kind(ShapeKind a, ShapeKind b) {
  const auto row = static_cast<size_t>(a);
  const auto column = static_cast<size_t>(b);
  return row < kPairKindTable.size() && column < kPairKindTable.size() ? kPairKindTable[row][column]
                                                                       : PairKindRef{};
}

}  // namespace carom

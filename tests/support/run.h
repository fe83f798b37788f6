// Calls the library on pairs laid out in guarded memory.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "carom/narrowphase/collide.h"
#include "tests/support/float_modes.h"
#include "tests/support/layouts.h"
#include "tests/support/results.h"

namespace carom::test {

struct Call {
  Layout layout_a;
  Layout layout_b;
  Detail detail = Detail::contact;
  WitnessFrame frame = WitnessFrame::world;
  Parallelism parallelism = Parallelism::none;
  unsigned missing = 0;  // columns left out
  FloatMode mode = kDefaultMode;
  Measured measured = Measured::all;
  Accuracy accuracy = {};
  float contact_distance = 0;
};

inline CollideOptions options_of(const Call& call) {
  return {.frame = call.frame,
          .parallelism = call.parallelism,
          .measured = call.measured,
          .accuracy = call.accuracy,
          .contact_distance = call.contact_distance};
}

Call call_with(PositionType positions);

std::vector<PlacedShape> side_a(std::span<const TestPair> pairs);

std::vector<PlacedShape> side_b(std::span<const TestPair> pairs);

// Runs `work` in the float mode of the call.
template <class Work>
void expect_success(const Call& call, const Work& work) {
  const Result<void> result = [&] {
    const ScopedFloatMode mode(call.mode);
    return work();
  }();
  if (!result) ADD_FAILURE() << result.error().message;
}

// Pairs laid out once for several calls: pair i is (a[i], b[i]) of two sets.
class LaidOutRowPairs {
 public:
  // Only the layouts of the call count.
  LaidOutRowPairs(std::span<const TestPair> pairs, const Call& call);

  // Calls collide_rows().
  std::vector<Row> run(const Call& call) const;

 private:
  LaidOut a_, b_;
};

std::vector<Row> run_rows(std::span<const TestPair> pairs, const Call& call);

bool hold_halfspaces(std::span<const PlacedShape> bodies);

// A list whose row i is pair i; `to_first` and `to_second` give the places of its bodies in their
// sets.
template <class First, class Second>
std::vector<Row> run_pairs(const LaidOut& a, const LaidOut& b, size_t count, const Call& call,
                           const First& to_first, const Second& to_second) {
  GuardedArray list(count, sizeof(Pair), sizeof(Pair));
  for (uint32_t i = 0; i < count; ++i) list.set(i, Pair{to_first(i), to_second(i)});
  Columns columns(count, call.missing);
  expect_success(call, [&] {
    return carom::collide(a.view(), b.view(), std::span(list.as<Pair>(), count), call.detail,
                          columns.out(), call.frame, call.parallelism, call.measured,
                          call.accuracy);
  });
  return columns.rows();
}

// Pairs laid out once for several calls, with all bodies in one set, the second bodies before the
// first ones. A set with half-spaces cannot be tested against itself: then there are two sets, one
// of them reversed.
class LaidOutListPairs {
 public:
  // Only the layouts of the call count.
  LaidOutListPairs(std::span<const TestPair> pairs, const Call& call);

  // Calls collide().
  std::vector<Row> run(const Call& call) const;

 private:
  bool are_two_sets_;
  uint32_t count_;
  std::vector<LaidOut> sets_;
};

std::vector<Row> run_list(std::span<const TestPair> pairs, const Call& call);

}  // namespace carom::test

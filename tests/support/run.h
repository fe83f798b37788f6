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
};

inline Call call_with(PositionType positions) {
  Call call;
  call.layout_a.positions = call.layout_b.positions = positions;
  return call;
}

inline std::vector<PlacedShape> side_a(std::span<const TestPair> pairs) {
  std::vector<PlacedShape> bodies;
  for (const TestPair& pair : pairs) bodies.push_back(pair.a);
  return bodies;
}

inline std::vector<PlacedShape> side_b(std::span<const TestPair> pairs) {
  std::vector<PlacedShape> bodies;
  for (const TestPair& pair : pairs) bodies.push_back(pair.b);
  return bodies;
}

// Runs `work` in the float mode of the call.
template <class Work>
void expect_success(const Call& call, const Work& work) {
  const Result<void> result = [&] {
    const ScopedFloatMode mode(call.mode);
    return work();
  }();
  if (!result) ADD_FAILURE() << result.error().message;
}

// Calls collide_rows(): pair i is (a[i], b[i]) of two sets.
inline std::vector<Row> run_rows(std::span<const TestPair> pairs, const Call& call) {
  const LaidOut a(side_a(pairs), call.layout_a);
  const LaidOut b(side_b(pairs), call.layout_b);
  Columns columns(pairs.size(), call.missing);
  expect_success(call, [&] {
    return collide_rows(a.view(), b.view(), call.detail, columns.out(), call.frame,
                        call.parallelism, call.measured, call.accuracy);
  });
  return columns.rows();
}

inline bool hold_halfspaces(std::span<const PlacedShape> bodies) {
  return std::any_of(bodies.begin(), bodies.end(), [](const PlacedShape& body) {
    return kind_of(body.shape) == ShapeKind::halfspace;
  });
}

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

// Calls collide() with all bodies in one set, the second bodies before the first ones. A set with
// half-spaces cannot be tested against itself: then there are two sets, one of them reversed.
inline std::vector<Row> run_list(std::span<const TestPair> pairs, const Call& call) {
  std::vector<PlacedShape> firsts = side_a(pairs);
  std::vector<PlacedShape> seconds = side_b(pairs);
  const auto count = static_cast<uint32_t>(pairs.size());
  const auto same = [](uint32_t i) { return i; };
  if (hold_halfspaces(firsts) || hold_halfspaces(seconds)) {
    std::reverse(seconds.begin(), seconds.end());
    return run_pairs(LaidOut(firsts, call.layout_a), LaidOut(seconds, call.layout_b), count, call,
                     same, [&](uint32_t i) { return count - 1 - i; });
  }
  seconds.insert(seconds.end(), firsts.begin(), firsts.end());
  const LaidOut set(seconds, call.layout_a);
  return run_pairs(
      set, set, count, call, [&](uint32_t i) { return count + i; }, same);
}

}  // namespace carom::test

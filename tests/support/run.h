// Calls the library on pairs laid out in guarded memory.
#pragma once

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

// Runs `work` in the float mode of the call alone.
template <class Work>
void expect_success(const Call& call, const Work& work) {
  const Result<void> result = [&] {
    const ScopedFloatMode mode(call.mode);
    return work();
  }();
  if (!result) ADD_FAILURE() << result.error().message;
}

// Pair i is (a[i], b[i]) of two sets.
inline std::vector<Row> run_rows(std::span<const TestPair> pairs, const Call& call) {
  const LaidOut a(side_a(pairs), call.layout_a);
  const LaidOut b(side_b(pairs), call.layout_b);
  Columns columns(pairs.size(), call.missing);
  expect_success(call, [&] {
    return collide_rows(a.view(), b.view(), call.detail, columns.out(), call.frame,
                        call.parallelism);
  });
  return columns.rows();
}

// All bodies in one set, the second sides before the first ones, and a list of pairs.
inline std::vector<Row> run_list(std::span<const TestPair> pairs, const Call& call) {
  std::vector<PlacedShape> bodies = side_b(pairs);
  const std::vector<PlacedShape> firsts = side_a(pairs);
  bodies.insert(bodies.end(), firsts.begin(), firsts.end());
  const auto count = static_cast<uint32_t>(pairs.size());
  GuardedArray list(pairs.size(), sizeof(Pair), sizeof(Pair));
  for (uint32_t i = 0; i < count; ++i) list.set(i, Pair{count + i, i});
  const LaidOut set(bodies, call.layout_a);
  Columns columns(pairs.size(), call.missing);
  expect_success(call, [&] {
    return carom::collide(set.view(), set.view(), std::span(list.as<Pair>(), pairs.size()),
                          call.detail, columns.out(), call.frame, call.parallelism);
  });
  return columns.rows();
}

}  // namespace carom::test

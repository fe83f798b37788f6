#include "tests/support/run.h"

namespace carom::test {

Call call_with(PositionType positions) {
  Call call;
  call.layout_a.positions = call.layout_b.positions = positions;
  return call;
}

std::vector<PlacedShape> side_a(std::span<const TestPair> pairs) {
  std::vector<PlacedShape> bodies;
  for (const TestPair& pair : pairs) bodies.push_back(pair.a);
  return bodies;
}

std::vector<PlacedShape> side_b(std::span<const TestPair> pairs) {
  std::vector<PlacedShape> bodies;
  for (const TestPair& pair : pairs) bodies.push_back(pair.b);
  return bodies;
}

std::vector<Row> run_rows(std::span<const TestPair> pairs, const Call& call) {
  const LaidOut a(side_a(pairs), call.layout_a);
  const LaidOut b(side_b(pairs), call.layout_b);
  Columns columns(pairs.size(), call.missing);
  expect_success(call, [&] {
    return collide_rows(a.view(), b.view(), call.detail, columns.out(), call.frame,
                        call.parallelism, call.measured, call.accuracy);
  });
  return columns.rows();
}

bool hold_halfspaces(std::span<const PlacedShape> bodies) {
  return std::any_of(bodies.begin(), bodies.end(), [](const PlacedShape& body) {
    return kind_of(body.shape) == ShapeKind::halfspace;
  });
}

std::vector<Row> run_list(std::span<const TestPair> pairs, const Call& call) {
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

#include "tests/support/run.h"

namespace carom::test {

Call call_with(PositionType positions) {
  Call call;
  call.layout_a.positions = call.layout_b.positions = positions;
  return call;
}

std::vector<PlacedShape> side_a(std::span<const TestPair> pairs) {
  std::vector<PlacedShape> bodies;
  bodies.reserve(pairs.size());
  for (const TestPair& pair : pairs) bodies.push_back(pair.a);
  return bodies;
}

std::vector<PlacedShape> side_b(std::span<const TestPair> pairs) {
  std::vector<PlacedShape> bodies;
  bodies.reserve(pairs.size());
  for (const TestPair& pair : pairs) bodies.push_back(pair.b);
  return bodies;
}

LaidOutRowPairs::LaidOutRowPairs(std::span<const TestPair> pairs, const Call& call)
    : a_(side_a(pairs), call.layout_a), b_(side_b(pairs), call.layout_b) {}

std::vector<Row> LaidOutRowPairs::run(const Call& call) const {
  Columns columns(a_.view().count, call.missing);
  expect_success(call, [&] {
    return collide_rows(a_.view(), b_.view(), call.detail, columns.out(), options_of(call));
  });
  return columns.rows();
}

std::vector<Row> run_rows(std::span<const TestPair> pairs, const Call& call) {
  return LaidOutRowPairs(pairs, call).run(call);
}

bool hold_halfspaces(std::span<const PlacedShape> bodies) {
  return std::any_of(bodies.begin(), bodies.end(), [](const PlacedShape& body) {
    return kind_of(body.shape) == ShapeKind::halfspace;
  });
}

LaidOutListPairs::LaidOutListPairs(std::span<const TestPair> pairs, const Call& call)
    : count_(static_cast<uint32_t>(pairs.size())) {
  std::vector<PlacedShape> firsts = side_a(pairs);
  std::vector<PlacedShape> seconds = side_b(pairs);
  are_two_sets_ = hold_halfspaces(firsts) || hold_halfspaces(seconds);
  if (are_two_sets_) {
    std::reverse(seconds.begin(), seconds.end());
    sets_.reserve(2);
    sets_.emplace_back(firsts, call.layout_a);
    sets_.emplace_back(seconds, call.layout_b);
  } else {
    seconds.insert(seconds.end(), firsts.begin(), firsts.end());
    sets_.emplace_back(seconds, call.layout_a);
  }
}

std::vector<Row> LaidOutListPairs::run(const Call& call) const {
  const auto same = [](uint32_t i) { return i; };
  if (are_two_sets_) {
    return run_pairs(sets_[0], sets_[1], count_, call, same,
                     [&](uint32_t i) { return count_ - 1 - i; });
  }
  return run_pairs(
      sets_[0], sets_[0], count_, call, [&](uint32_t i) { return count_ + i; }, same);
}

std::vector<Row> run_list(std::span<const TestPair> pairs, const Call& call) {
  return LaidOutListPairs(pairs, call).run(call);
}

}  // namespace carom::test

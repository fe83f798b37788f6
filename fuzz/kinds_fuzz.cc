// Reads any bytes as two bodies of any two kinds that have a kernel. Every instruction set must
// give the bits of the scalar reference, whatever neighbours the bodies have.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <tuple>
#include <utility>

#include "carom/narrowphase/collide.h"
#include "carom/reference/reference.h"
#include "carom/simd/isa.h"
#include "fuzz/kinds_bodies.h"

namespace {

using namespace carom;
using namespace carom::fuzz;

struct Row {
  uint8_t overlap = 0, status = 0, manifold_count = 0, unused = 0;
  std::array<float, 10> contact{};  // separation, normal, both points
  ManifoldPoints manifold{};
};

Row reference_row(const reference::PairResult& result, Detail detail) {
  Row row;
  row.overlap = result.overlap;
  row.status = static_cast<uint8_t>(result.status);
  if (detail == Detail::overlap) return row;
  const bool has_answer = result.status != Status::invalid;
  row.contact[0] = result.separation;
  for (int axis = 0; axis < 3; ++axis) {
    row.contact[1 + axis] = result.normal[axis];
    row.contact[4 + axis] = has_answer ? result.arm_a[axis] : result.normal[axis];
    row.contact[7 + axis] = has_answer ? result.arm_b[axis] : result.normal[axis];
  }
  if (detail == Detail::contact) return row;
  row.manifold_count = result.manifold_count;
  row.manifold = result.manifold;
  return row;
}

// The result for the first bodies of the two sets.
Row kernel_row(const Collidables& a, const Collidables& b, Detail detail) {
  using Column = std::array<float, View::kBodies>;
  std::array<uint8_t, View::kBodies> overlap{}, status{}, manifold_count{};
  std::array<Column, std::tuple_size_v<decltype(Row::contact)>> contact{};
  std::array<ManifoldPoints, View::kBodies> manifold{};
  ResultColumns out;
  out.overlap = overlap.data();
  out.status = status.data();
  out.separation = contact[0].data();
  for (size_t axis = 0; axis < 3; ++axis) {
    out.normal[axis] = contact[1 + axis].data();
    out.point_a[axis] = contact[4 + axis].data();
    out.point_b[axis] = contact[7 + axis].data();
  }
  out.manifold_count = manifold_count.data();
  out.manifold = manifold.data();
  if (!collide_rows(a, b, detail, out, {.frame = WitnessFrame::body})) std::abort();
  Row row;
  row.overlap = overlap[0];
  row.status = status[0];
  row.manifold_count = manifold_count[0];
  for (size_t i = 0; i < contact.size(); ++i) row.contact[i] = contact[i][0];
  row.manifold = manifold[0];
  return row;
}

bool same_bits(const Row& x, const Row& y) { return std::memcmp(&x, &y, sizeof x) == 0; }

void print(const char* who, const Row& row) {
  std::fprintf(stderr, "%s: overlap %d status %d contact", who, row.overlap, row.status);
  for (const float x : row.contact) std::fprintf(stderr, " %a", x);
  std::fprintf(stderr, " points %d:", row.manifold_count);
  for (size_t i = 0; i < row.manifold.point.size(); ++i) {
    const auto& [x, y, z] = row.manifold.point[i];
    std::fprintf(stderr, " (%a %a %a: %a)", x, y, z, row.manifold.separation[i]);
  }
  std::fputc('\n', stderr);
}

[[noreturn]] void fail(const KindPair& kinds, Isa isa, const Row& row, const Row& wanted) {
  std::fprintf(stderr, "%s against %s\n", name(kinds.a), name(kinds.b));
  print("reference", wanted);
  print(name(isa), row);
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size < 2) return 0;
  Data rest(data, size);
  const TwoBodies two = take_two_bodies(rest);
  const KindPair& kinds = two.kinds;

  const View a(kinds.a, two.a, two.beside_a, two.type), b(kinds.b, two.b, two.beside_b, two.type);
  const reference::PairResult expected = reference::collide(
      shape_of(kinds.a, two.a), pose_of(two.a), shape_of(kinds.b, two.b), pose_of(two.b), two.type);
  for (const Isa isa : usable_isas()) {
    force_isa(isa);
    for (const Detail detail : {Detail::overlap, Detail::contact, Detail::manifold}) {
      const Row row = kernel_row(*a, *b, detail);
      const Row wanted = reference_row(expected, detail);
      if (!same_bits(row, wanted)) fail(kinds, isa, row, wanted);
    }
  }
  return 0;
}

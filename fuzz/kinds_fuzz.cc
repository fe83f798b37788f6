// Any bytes as two bodies of any two kinds that have a kernel: every instruction set says what the
// scalar reference says, bit for bit, whatever is beside them.
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
#include "fuzz/kinds_input.h"

namespace {

using namespace carom;
using namespace carom::fuzz;

Shape shape_of(ShapeKind kind, const Body& body) {
  const auto& rows = body.rows;
  switch (kind) {
    case ShapeKind::sphere:
      return Sphere{rows[0][0]};
    case ShapeKind::aabb:
      return Aabb{{rows[0][0], rows[0][1], rows[0][2]}, {rows[1][0], rows[1][1], rows[1][2]}};
    default:
      return shape_from_rows(kind, rows.data());
  }
}

Pose pose_of(const Body& body) {
  const auto& q = body.orientation;
  const auto& p = body.position;
  return {{p[0], p[1], p[2]}, {q[3], q[0], q[1], q[2]}};
}

// A set of one kind: the body, and another beside it in the same vector. Positions are of the type
// that is asked for.
class View {
 public:
  static constexpr size_t kBodies = 2;

  View(ShapeKind kind, const Body& body, const Body& neighbour, PositionType type)
      : rows_{body.rows, neighbour.rows},
        orientations_{body.orientation, neighbour.orientation},
        positions_{body.position, neighbour.position} {
    for (size_t i = 0; i < kBodies; ++i) {
      for (size_t axis = 0; axis < 3; ++axis) {
        positions32_[i][axis] = static_cast<float>(positions_[i][axis]);
      }
    }
    const bool is_float64 = type == PositionType::float64;
    view_.count = kBodies;
    view_.uniform_kind = kind;
    view_.position = {.data = is_float64 ? static_cast<const void*>(positions_[0].data())
                                         : positions32_[0].data(),
                      .stride = is_float64 ? sizeof positions_[0] : sizeof positions32_[0],
                      .type = type,
                      .radius_layout = RadiusLayout::column,
                      .radius = rows_[0][0].data(),
                      .radius_stride = sizeof rows_[0]};
    for (size_t axis = 0; axis < 3; ++axis) {
      view_.boxes.lower[axis] = &rows_[0][0][axis];
      view_.boxes.upper[axis] = &rows_[0][1][axis];
    }
    view_.boxes.stride = sizeof rows_[0];
    view_.orientation.data = orientations_[0].data();
    view_.rows = {rows_[0][0].data(), kFirstRows.data()};
  }
  View(const View&) = delete;
  View& operator=(const View&) = delete;

  const Collidables& operator*() const { return view_; }

 private:
  static constexpr std::array<uint32_t, kBodies> kFirstRows = {0, kMostRows};

  const std::array<decltype(Body::rows), kBodies> rows_;
  const std::array<decltype(Body::orientation), kBodies> orientations_;
  const std::array<decltype(Body::position), kBodies> positions_;
  std::array<std::array<float, 3>, kBodies> positions32_;
  Collidables view_;
};

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

// Of the first bodies of the two sets.
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
  if (!collide_rows(a, b, detail, out, WitnessFrame::body)) std::abort();
  Row row;
  row.overlap = overlap[0];
  row.status = status[0];
  row.manifold_count = manifold_count[0];
  for (size_t i = 0; i < contact.size(); ++i) row.contact[i] = contact[i][0];
  row.manifold = manifold[0];
  return row;
}

// Rows of bytes are no address of a hull.
Body with_hull(ShapeKind kind, Body body, const Hull& hull) {
  if (kind == ShapeKind::hull) body.rows = shape_rows(hull);
  return body;
}

// Without numbers that no shape has, a flag of 0.3 say.
Body without_excess(ShapeKind kind, Body body) {
  if (row_count(kind) > 0) body.rows = shape_rows(shape_of(kind, body));
  return body;
}

Hull take_hull_of(ShapeKind kind, Data& data) {
  return kind == ShapeKind::hull ? take_hull(data) : Hull{};
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
  KindPair kinds = kPairs[take<uint8_t>(rest) % std::size(kPairs)];
  const auto flags = take<uint8_t>(rest);
  if (flags & kExchanged) std::swap(kinds.a, kinds.b);
  const PositionType type = flags & kFloat64 ? PositionType::float64 : PositionType::float32;
  const auto bodies = take<std::array<Body, 2>>(rest);
  const Hull hull_a = take_hull_of(kinds.a, rest), hull_b = take_hull_of(kinds.b, rest);
  const Body beside_a = with_hull(kinds.a, bodies[0], hull_a);
  const Body beside_b = with_hull(kinds.b, bodies[0], hull_b);
  const Body body_a = without_excess(kinds.a, beside_a);
  const Body body_b = without_excess(kinds.b, with_hull(kinds.b, bodies[1], hull_b));

  const View a(kinds.a, body_a, beside_a, type), b(kinds.b, body_b, beside_b, type);
  const reference::PairResult expected = reference::collide(
      shape_of(kinds.a, body_a), pose_of(body_a), shape_of(kinds.b, body_b), pose_of(body_b), type);
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

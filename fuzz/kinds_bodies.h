// The bodies that kinds_fuzz and motions_fuzz read from their input, as shapes and as views.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>

#include "carom/shapes/body.h"
#include "fuzz/kinds_input.h"

namespace carom::fuzz {

inline Shape shape_of(ShapeKind kind, const Body& body) {
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

inline Pose pose_of(const Body& body) {
  const auto& q = body.orientation;
  const auto& p = body.position;
  return {{p[0], p[1], p[2]}, {q[3], q[0], q[1], q[2]}};
}

// A set of one kind: the body and a neighbour in the same vector, with positions of the given type.
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

// Replaces the rows of a hull, which must be an address and not arbitrary bytes.
inline Body with_hull(ShapeKind kind, Body body, const Hull& hull) {
  if (core_kind(kind) != ShapeKind::hull) return body;
  Hull rounded = hull;
  if (is_rounded(kind)) rounded.rounding = body.rows[0][3];
  body.rows = shape_rows(rounded);
  return body;
}

// Removes numbers that no shape has, such as a flag of 0.3.
inline Body without_excess(ShapeKind kind, Body body) {
  if (row_count(kind) > 0) body.rows = shape_rows(shape_of(kind, body));
  // Without a rounding the shape would have another kind.
  if (is_rounded(kind) && body.rows[0][3] == 0) body.rows[0][3] = 1;
  return body;
}

inline Hull take_hull_of(ShapeKind kind, Data& data) {
  return core_kind(kind) == ShapeKind::hull ? take_hull(data) : Hull{};
}

// Two bodies, and a neighbour of the same kind beside each.
struct TwoBodies {
  KindPair kinds;
  uint8_t flags;
  PositionType type;
  Hull hull_a, hull_b;  // must live as long as the bodies
  Body a, b, beside_a, beside_b;
};

inline TwoBodies take_two_bodies(Data& data) {
  TwoBodies two;
  two.kinds = kPairs[take<uint8_t>(data) % std::size(kPairs)];
  two.flags = take<uint8_t>(data);
  if (two.flags & kExchanged) std::swap(two.kinds.a, two.kinds.b);
  two.type = two.flags & kFloat64 ? PositionType::float64 : PositionType::float32;
  const auto bodies = take<std::array<Body, 2>>(data);
  two.hull_a = take_hull_of(two.kinds.a, data);
  two.hull_b = take_hull_of(two.kinds.b, data);
  two.beside_a = with_hull(two.kinds.a, bodies[0], two.hull_a);
  two.beside_b = with_hull(two.kinds.b, bodies[0], two.hull_b);
  two.a = without_excess(two.kinds.a, two.beside_a);
  two.b = without_excess(two.kinds.b, with_hull(two.kinds.b, bodies[1], two.hull_b));
  return two;
}

}  // namespace carom::fuzz

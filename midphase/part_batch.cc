#include "midphase/part_batch.h"

#include <algorithm>
#include <memory>

#include "narrowphase/pair_block.h"

namespace carom {
void PartColumns::put(size_t i, const PlacedPart& part) {
  const Double3& p = part.position;
  record_[i] = {p[0], p[1], p[2], part.part->radius};
  position_[i] = p;
  arm_[i] = part.arm;
  orientation_[i] = part.orientation;
  kind_[i] = part.kind();
  triangle_[i] = part.triangle;
  order_[i] = part.order();
  const bool is_of_mesh = part.triangle != PlacedPart::kWhole;
  mesh_[i] = is_of_mesh ? &part.mesh() : nullptr;
  if (is_of_mesh) {
    put_rows(i, triangle_rows(*mesh_[i], part.triangle).data(), 3);
  } else if (kind_[i] == ShapeKind::aabb) {
    for (size_t axis = 0; axis < 3; ++axis) {
      lower_[axis][i] = part.part->lower[axis];
      upper_[axis][i] = part.part->upper[axis];
    }
  } else {
    put_rows(i, part.part->rows.data(), row_count(kind_[i]));
  }
}

void PartColumns::put(size_t i, const PartColumns& other, size_t from) {
  record_[i] = other.record_[from];
  position_[i] = other.position_[from];
  arm_[i] = other.arm_[from];
  orientation_[i] = other.orientation_[from];
  kind_[i] = other.kind_[from];
  triangle_[i] = other.triangle_[from];
  order_[i] = other.order_[from];
  mesh_[i] = other.mesh_[from];
  for (size_t axis = 0; axis < 3; ++axis) {
    lower_[axis][i] = other.lower_[axis][from];
    upper_[axis][i] = other.upper_[axis][from];
  }
  put_rows(i, &other.rows_[other.first_row_[from]], row_count(kind_[i]));
}

void PartColumns::put_rows(size_t i, const Row* rows, uint32_t count) {
  first_row_[i] = rows_used_;
  std::copy_n(rows, count, rows_.begin() + rows_used_);
  rows_used_ += count;
}

// Of one kind, if all are: that saves the narrow phase from sorting them.
Collidables PartColumns::view(size_t count) const {
  Collidables view;
  view.count = count;
  view.position = {
      .data = record_.data(), .stride = sizeof record_[0], .type = PositionType::float64};
  view.uniform_kind = kind_[0];
  const bool are_mixed = std::any_of(kind_.begin(), kind_.begin() + static_cast<long>(count),
                                     [&](ShapeKind kind) { return kind != kind_[0]; });
  if (are_mixed) view.kind = kind_.data();
  for (size_t axis = 0; axis < 3; ++axis) {
    view.boxes.lower[axis] = lower_[axis].data();
    view.boxes.upper[axis] = upper_[axis].data();
  }
  view.orientation.data = orientation_[0].data();
  view.rows = {rows_[0].data(), first_row_.data()};
  return view;
}

Part PartColumns::part(size_t i) const {
  Part part;
  part.kind = kind_[i];
  part.radius = static_cast<float>(record_[i].radius);
  for (size_t axis = 0; axis < 3; ++axis) {
    part.lower[axis] = lower_[axis][i];
    part.upper[axis] = upper_[axis][i];
  }
  std::copy_n(&rows_[first_row_[i]], row_count(part.kind), part.rows.begin());
  part.orientation = orientation_[i];
  part.position = position_[i];
  return part;
}

PlacedTriangle PartColumns::triangle(size_t i) const {
  return {*mesh_[i], triangle_[i], position_[i], rotation_of(orientation_[i])};
}

void PartBatch::clear() {
  count_ = 0;
  has_meshes_ = false;
  for (PartColumns& side : sides_) side.clear();
}

void PartBatch::add(size_t owner, const PlacedPart& a, const PlacedPart& b) {
  owner_[count_] = static_cast<uint32_t>(owner);
  sides_[0].put(count_, a);
  sides_[1].put(count_, b);
  const auto is_of_mesh = [](const PlacedPart& part) { return part.triangle != part.kWhole; };
  has_meshes_ = has_meshes_ || is_of_mesh(a) || is_of_mesh(b);
  ++count_;
}

void PartBatch::add_copy(const PartBatch& other, size_t i) {
  for (size_t side = 0; side < 2; ++side) sides_[side].put(count_, other.sides_[side], i);
  owner_[count_++] = static_cast<uint32_t>(i);
}

ResultColumns PartBatch::results() {
  ResultColumns columns = scratch_.columns();
  columns.manifold_count = manifold_count_.data();
  columns.manifold = manifold_.data();
  columns.separation_bound = bound_.data();
  return columns;
}

ResultColumns PartBatch::asked(const PartTests& tests) {
  ResultColumns columns = results();
  if (!tests.bounds) columns.separation_bound = nullptr;
  return columns;
}

void PartBatch::run_plain(const PartTests& tests) {
  if (count_ == 0) return;
  run_pair_block({.a = sides_[0].view(count_),
                  .b = sides_[1].view(count_),
                  .pairs = nullptr,
                  .first = 0,
                  .count = count_,
                  .detail = tests.manifolds ? Detail::manifold : Detail::contact,
                  .frame = WitnessFrame::body,
                  .separate = tests.separate,
                  .accuracy = tests.accuracy,
                  .out = asked(tests)});
}

// The inner edges that the contact of row i may have come over, of both sides.
std::array<uint8_t, 2> PartBatch::edges_to_close(size_t i) {
  const ResultColumns out = results();
  std::array<uint8_t, 2> edges{};
  for (size_t side = 0; side < 2; ++side) {
    if (!sides_[side].is_of_mesh(i)) continue;
    const PlacedTriangle triangle = sides_[side].triangle(i);
    if (triangle.faces_along({out.normal[0][i], out.normal[1][i], out.normal[2][i]})) continue;
    const Part other = sides_[1 - side].part(i);
    if (other.kind == ShapeKind::halfspace) continue;
    edges[side] = triangle.inner_edges_towards(middle_of(other));
  }
  return edges;
}

void PartBatch::run(const PartTests& tests) {
  static thread_local const auto again = std::make_unique<PartBatch>();
  run_plain(tests);
  std::fill_n(over_edge_.begin(), count_, uint8_t{0});
  if (!has_meshes_) return;
  again->clear();
  for (size_t i = 0; i < count_; ++i) {
    if (scratch_.overlap[i] != 1) continue;
    const std::array<uint8_t, 2> edges = edges_to_close(i);
    if (edges[0] == 0 && edges[1] == 0) continue;
    again->add_copy(*this, i);
    for (size_t side = 0; side < 2; ++side) {
      if (edges[side] != 0) again->sides_[side].set_inner_edges(again->count_ - 1, edges[side]);
    }
  }
  again->run_plain(tests);
  take(*again, tests);
}

// Decisions stay as they are.
void PartBatch::take(PartBatch& again, const PartTests& tests) {
  const ResultColumns from = again.results(), to = results();
  for (size_t i = 0; i < again.count_; ++i) {
    const size_t row = again.owner_[i];
    over_edge_[row] = 1;
    if (from.overlap[i] != 1) continue;
    to.status[row] = from.status[i];
    to.separation[row] = from.separation[i];
    for (size_t axis = 0; axis < 3; ++axis) {
      to.normal[axis][row] = from.normal[axis][i];
      to.point_a[axis][row] = from.point_a[axis][i];
      to.point_b[axis][row] = from.point_b[axis][i];
    }
    if (tests.bounds) to.separation_bound[row] = from.separation_bound[i];
    if (!tests.manifolds) continue;
    to.manifold_count[row] = from.manifold_count[i];
    to.manifold[row] = from.manifold[i];
  }
}

}  // namespace carom

#include "midphase/part_batch.h"

#include <algorithm>

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
  } else {
    put_rows(i, part.part->rows.data(), row_count(kind_[i]));
  }
  if (kind_[i] != ShapeKind::aabb) return;
  for (size_t axis = 0; axis < 3; ++axis) {
    lower_[axis][i] = part.part->lower[axis];
    upper_[axis][i] = part.part->upper[axis];
  }
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
  for (size_t axis = 0; part.kind == ShapeKind::aabb && axis < 3; ++axis) {
    part.lower[axis] = lower_[axis][i];
    part.upper[axis] = upper_[axis][i];
  }
  std::copy_n(rows_.data() + first_row_[i], row_count(part.kind), part.rows.begin());
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

void PartBatch::add(size_t owner, const PlacedPart& a, const PlacedPart& b,
                    const std::array<uint8_t, 2>& inner_edges) {
  add(owner, a, b);
  for (size_t side = 0; side < 2; ++side) {
    if (inner_edges[side] != 0) sides_[side].set_inner_edges(count_ - 1, inner_edges[side]);
  }
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
                  .measured = tests.measured,
                  .accuracy = tests.accuracy,
                  .out = asked(tests)});
}

// Half-spaces always push along their own normal.
std::array<uint8_t, 2> PartBatch::find_edges_to_close(size_t i) {
  const ResultColumns out = results();
  const Double3 normal = {out.normal[0][i], out.normal[1][i], out.normal[2][i]};
  std::array<uint8_t, 2> edges{};
  for (size_t side = 0; side < 2; ++side) {
    const PartColumns& other = sides_[1 - side];
    if (!sides_[side].is_of_mesh(i) || other.kind(i) == ShapeKind::halfspace) continue;
    edges[side] = sides_[side].triangle(i).edges_to_close(side == 0 ? normal : minus({}, normal),
                                                          [&] { return middle_of(other.part(i)); });
  }
  return edges;
}

void PartBatch::run(const PartTests& tests) {
  run_plain(tests);
  for (size_t i = 0; i < count_; ++i) {
    const bool may_be_over_edge = has_meshes_ && scratch_.overlap[i] == 1;
    edges_to_close_[i] = may_be_over_edge ? find_edges_to_close(i) : std::array<uint8_t, 2>{};
  }
}

}  // namespace carom

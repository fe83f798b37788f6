#include "midphase/part_batch.h"

#include <algorithm>

#include "geometries/local_origin.h"
#include "narrowphase/blocks/pair_block.h"
#include "narrowphase/proof/decide_unsure.h"

namespace carom {

void PartColumns::clear(Corners corners) {
  corners_ = corners;
  count_ = frames_used_ = rows_used_ = 0;
  are_mixed_ = false;
}

uint32_t PartColumns::put(size_t owner, const PlacedPart& part,
                          const std::array<float, 3>& origin) {
  if (!has_frame(owner, part, origin)) {
    put_frame(owner, part, origin);
  } else if (triangle_[count_ - 1] == part.triangle) {
    return count_ - 1;
  }
  const uint32_t body = count_++;
  const Double3& p = frames_[frames_used_ - 1].position;
  record_[body] = {p[0], p[1], p[2], part.part->radius};
  orientation_[body] = part.orientation;
  kind_[body] = part.kind();
  are_mixed_ = are_mixed_ || kind_[body] != kind_[0];
  frame_[body] = frames_used_ - 1;
  triangle_[body] = part.triangle;
  first_row_[body] = rows_used_;
  if (is_of_surface(body)) {
    write_corners(body);
  } else {
    std::copy_n(part.part->rows.data(), row_count(kind_[body]), rows_.data() + rows_used_);
  }
  rows_used_ += row_count(kind_[body]);
  dops_[body] = part.part->dop;
  for (size_t axis = 0; kind_[body] == ShapeKind::aabb && axis < 3; ++axis) {
    lower_[axis][body] = part.part->lower[axis];
    upper_[axis][body] = part.part->upper[axis];
  }
  return body;
}

// What all triangles share is written column by column.
template <class Triangle>
uint32_t PartColumns::put_triangles(size_t owner, const PlacedPart& surface,
                                    const std::array<float, 3>& origin, bool they_wait,
                                    size_t count, const Triangle& triangle) {
  const uint32_t first = count_, first_row = rows_used_;
  if (!has_frame(owner, surface, origin)) put_frame(owner, surface, origin);
  const Double3& p = frames_[frames_used_ - 1].position;
  std::fill_n(record_.begin() + first, count, Position{p[0], p[1], p[2], 0});
  std::fill_n(orientation_.begin() + first, count, surface.orientation);
  std::fill_n(kind_.begin() + first, count, ShapeKind::triangle);
  std::fill_n(frame_.begin() + first, count, frames_used_ - 1);
  std::fill_n(dops_.begin() + first, count, nullptr);
  are_mixed_ = are_mixed_ || kind_[0] != ShapeKind::triangle;
  constexpr uint32_t kRows = row_count(ShapeKind::triangle);
  for (uint32_t i = 0; i < count; ++i) {
    triangle_[first + i] = triangle(i);
    first_row_[first + i] = first_row + kRows * i;
  }
  if (!they_wait) {
    Row* const rows = rows_.data() + first_row;
    const std::array<float, 3> from = origin_of_rows(origin);
    surface.surface().visit([&](const auto& geometry) {
      for (uint32_t i = 0; i < count; ++i) {
        put_visited_triangle(geometry, triangle(i), rows + kRows * i, from);
      }
    });
    for (size_t i = 0; surface.one_sided && i < count; ++i) {
      rows[kRows * i + 1][3] = *surface.one_sided ? 1.0f : 0.0f;
    }
  }
  count_ += static_cast<uint32_t>(count);
  rows_used_ += kRows * static_cast<uint32_t>(count);
  return first;
}

void PartColumns::write_corners(uint32_t body) {
  if (!is_of_surface(body)) return;
  const Frame& frame = frames_[frame_[body]];
  Row* const rows = rows_.data() + first_row_[body];
  put_triangle_rows(*frame.surface, triangle_[body], rows, origin_of_rows(frame.origin));
  if (frame.one_sided) rows[1][3] = *frame.one_sided ? 1.0f : 0.0f;
}

void PartColumns::put_frame(size_t owner, const PlacedPart& part,
                            const std::array<float, 3>& origin) {
  Frame& frame = frames_[frames_used_++];  // in place: a copy would wait for its own stores
  const bool is_as_stored = corners_ == Corners::as_made && part.stored;
  frame.position = is_as_stored ? *part.stored : part.position;
  frame.arm = part.arm;
  frame.origin = origin;
  frame.turn = part.turn;
  frame.surface.reset();
  frame.child = part.child;
  frame.owner = owner;
  if (!is_surface(part.part->kind)) return;
  frame.surface = part.surface();
  frame.one_sided = part.one_sided;
  frame.position_of_surface = part.position;
  const std::array<float, 3> from = origin_of_rows(origin);
  if (from == kMeshOrigin) return;
  const Double3 way = turned(part.turn, {from[0], from[1], from[2]});
  frame.position = plus(frame.position, way);
  frame.arm = plus(part.arm, way);
}

// Says that all are of one kind if they are, which saves the narrow phase from sorting them.
Collidables PartColumns::view() const {
  Collidables view;
  view.count = count_;
  view.position = {
      .data = record_.data(), .stride = sizeof record_[0], .type = PositionType::float64};
  view.uniform_kind = kind_[0];
  if (are_mixed_) view.kind = kind_.data();
  for (size_t axis = 0; axis < 3; ++axis) {
    view.boxes.lower[axis] = lower_[axis].data();
    view.boxes.upper[axis] = upper_[axis].data();
  }
  view.orientation.data = orientation_[0].data();
  view.rows = {rows_[0].data(), first_row_.data()};
  view.dops = dops_.data();
  return view;
}

Part PartColumns::part(size_t body) const {
  Part part;
  part.kind = kind_[body];
  part.radius = static_cast<float>(record_[body].radius);
  for (size_t axis = 0; part.kind == ShapeKind::aabb && axis < 3; ++axis) {
    part.lower[axis] = lower_[axis][body];
    part.upper[axis] = upper_[axis][body];
  }
  std::copy_n(rows_.data() + first_row_[body], row_count(part.kind), part.rows.begin());
  part.orientation = orientation_[body];
  part.position = frames_[frame_[body]].position;
  return part;
}

Double3 PartColumns::middle(size_t body) const {
  const bool is_at_middle = kind_[body] == ShapeKind::sphere || kind_[body] == ShapeKind::box;
  return is_at_middle ? frames_[frame_[body]].position : middle_of(part(body));
}

PlacedTriangle PartColumns::triangle(size_t body) const {
  const Frame& frame = frames_[frame_[body]];
  return {*frame.surface, triangle_[body], frame.position_of_surface, frame.turn};
}

void PartBatch::begin(const PartTests& tests) {
  tests_ = tests;
  proves_ = has_proofs(tests.tier) && tests.counts_near;
  if (proves_ && !as_made_) as_made_ = std::make_unique_for_overwrite<std::array<PartColumns, 2>>();
  clear();
}

void PartBatch::clear() {
  count_ = tested_ = tested_before_ = waiting_count_ = 0;
  for (PartColumns& side : sides_) side.clear(PartColumns::Corners::near);
  if (!proves_) return;
  for (PartColumns& side : *as_made_) side.clear(PartColumns::Corners::as_made);
}

std::array<float, 3> PartBatch::origin_of(const PlacedPart& part, const PlacedPart& other) const {
  const bool is_moved = tests_.counts_near && is_surface(part.part->kind) &&
                        !is_surface(other.part->kind) &&
                        may_count_near(part.surface().rules(), part.one_sided);
  if (!is_moved) return kMeshOrigin;
  return origin_near(part.turn, part.position, *other.part, other.position);
}

Pair PartBatch::put_parts(size_t owner, const PlacedPart& a, const PlacedPart& b,
                          bool counts_near) {
  const std::array<float, 3> origin_a = counts_near ? origin_of(a, b) : kMeshOrigin;
  const std::array<float, 3> origin_b = counts_near ? origin_of(b, a) : kMeshOrigin;
  const auto put = [&](std::array<PartColumns, 2>& sides) -> Pair {
    return {sides[0].put(owner, a, origin_a), sides[1].put(owner, b, origin_b)};
  };
  if (proves_) put(*as_made_);
  return put(sides_);
}

void PartBatch::add(size_t owner, const PlacedPart& a, const PlacedPart& b, float reach) {
  put_pair(put_parts(owner, a, b, true), owner, reach);
}

void PartBatch::add_waiting(size_t owner, const PlacedPart& a, const PlacedPart& b, float reach,
                            float least_separation) {
  put_waiting(put_parts(owner, a, b, true), owner, reach, least_separation);
}

void PartBatch::add_triangles(size_t owner, const NearParts& parts, float reach) {
  const size_t surface_side = is_surface(parts.a.kind()) ? 0 : 1;
  const PlacedPart& surface = surface_side == 0 ? parts.a : parts.b;
  const PlacedPart& convex = surface_side == 0 ? parts.b : parts.a;
  const std::array<float, 3> origin = origin_of(surface, convex);
  const std::span<const float> least = parts.least_separations;
  uint32_t first, other;
  const auto put = [&](std::array<PartColumns, 2>& sides) {
    first = sides[surface_side].put_triangles(owner, surface, origin, !least.empty(),
                                              parts.triangles.size(),
                                              [&](size_t i) { return parts.triangles[i]; });
    other = sides[1 - surface_side].put(owner, convex, {});
  };
  if (proves_) put(*as_made_);
  put(sides_);
  const auto pair = [&](size_t i) {
    const uint32_t triangle = first + static_cast<uint32_t>(i);
    return surface_side == 0 ? Pair{triangle, other} : Pair{other, triangle};
  };
  for (size_t i = 0; i < least.size(); ++i) put_waiting(pair(i), owner, reach, least[i]);
  if (!least.empty()) return;
  for (size_t i = 0; i < parts.triangles.size(); ++i) put_pair(pair(i), owner, reach);
}

void PartBatch::add_triangle_pairs(size_t owner, const NearParts& parts, float reach) {
  const std::span<const ItemPair> pairs = parts.pairs;
  const size_t count = pairs.size();
  const std::span<const float> least = parts.least_separations;
  uint32_t first_a, first_b;
  const auto put = [&](std::array<PartColumns, 2>& sides) {
    first_a = sides[0].put_triangles(owner, parts.a, {}, !least.empty(), count,
                                     [&](size_t i) { return pairs[i].a; });
    first_b = sides[1].put_triangles(owner, parts.b, {}, !least.empty(), count,
                                     [&](size_t i) { return pairs[i].b; });
  };
  if (proves_) put(*as_made_);
  put(sides_);
  for (uint32_t i = 0; i < least.size(); ++i) {
    put_waiting({first_a + i, first_b + i}, owner, reach, least[i]);
  }
  if (!least.empty()) return;
  std::fill_n(reach_.begin() + count_, count, reach);
  std::fill_n(owner_.begin() + count_, count, static_cast<uint32_t>(owner));
  for (uint32_t i = 0; i < count; ++i) pairs_[count_++] = {first_a + i, first_b + i};
}

void PartBatch::add(size_t owner, const PlacedPart& a, const PlacedPart& b, float reach,
                    const std::array<uint8_t, 2>& inner_edges) {
  const Pair pair = put_parts(owner, a, b, false);
  put_pair(pair, owner, reach);
  const auto set = [&](std::array<PartColumns, 2>& sides) {
    if (inner_edges[0] != 0) sides[0].set_inner_edges(pair.a, inner_edges[0]);
    if (inner_edges[1] != 0) sides[1].set_inner_edges(pair.b, inner_edges[1]);
  };
  if (proves_) set(*as_made_);
  set(sides_);
}

void PartBatch::run() {
  tested_before_ = tested_;
  if (tested_ == count_) return;
  ResultColumns asked = from_row(results_, tested_);
  if (!tests_.bounds) asked.separation_bound = nullptr;
  PartTests tests = tests_;
  if (proves_) tests.tier = Tier::standard;
  run_from(sides_, tests, tests.manifolds ? Detail::manifold : Detail::contact, asked);
  if (proves_) prove(asked);
  tested_ = count_;
}

void PartBatch::run_from(const std::array<PartColumns, 2>& sides, const PartTests& tests,
                         Detail detail, const ResultColumns& out) const {
  run_pair_block({.a = sides[0].view(),
                  .b = sides[1].view(),
                  .pairs = pairs_.data() + tested_,
                  .first = 0,
                  .count = count_ - tested_,
                  .detail = detail,
                  .frame = WitnessFrame::body,
                  .measured = tests.measured,
                  .reach = tests.reach ? reach_.data() + tested_ : nullptr,
                  .accuracy = {.tier = tests.tier},
                  .out = out});
}

// As decide_unsure(), of triangles as they are made.
void PartBatch::prove(const ResultColumns& tested) {
  ResultColumns decided;
  decided.overlap = proven_.data();
  run_from(*as_made_, tests_, Detail::overlap, decided);
  for (size_t row = 0; row < count_ - tested_; ++row) {
    float& separation = tested.separation[row];
    separation = with_sign_of(proven_[row], separation);
    tested.overlap[row] = proven_[row];
    if (!tests_.manifolds || proven_[row] != 1 || tested.manifold_count[row] > 0) continue;
    // Two parts that touch, of which rounding made separate ones.
    tested.manifold_count[row] = 1;
    for (size_t axis = 0; axis < 3; ++axis) {
      tested.manifold[row].point[0][axis] = tested.point_a[axis][row];
    }
    tested.manifold[row].separation[0] = separation;
  }
}

void PartBatch::write_corners(Pair pair) {
  const auto write = [pair](std::array<PartColumns, 2>& sides) {
    sides[0].write_corners(pair.a);
    sides[1].write_corners(pair.b);
  };
  if (proves_) write(*as_made_);
  write(sides_);
}

// Half-spaces are skipped: they always push along their own normal.
std::array<uint8_t, 2> PartBatch::edges_to_close(size_t i) const {
  std::array<uint8_t, 2> edges{};
  const Double3 normal = {results_.normal[0][i], results_.normal[1][i], results_.normal[2][i]};
  const std::array<uint32_t, 2> body = {pairs_[i].a, pairs_[i].b};
  for (size_t side = 0; side < 2; ++side) {
    const PartColumns& own = sides_[side];
    const PartColumns& other = sides_[1 - side];
    const uint32_t facing = body[1 - side];
    if (!own.is_of_surface(body[side]) || other.kind(facing) == ShapeKind::halfspace) continue;
    edges[side] =
        own.triangle(body[side]).edges_to_close(side == 0 ? normal : minus({}, normal), [&] {
          return other.middle(facing);
        });
  }
  return edges;
}

}  // namespace carom

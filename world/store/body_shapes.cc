// The shapes of the bodies of a BodyStore, and the models that stand for them.
#include <algorithm>
#include <utility>

#include "shapes/dop_geometry.h"
#include "world/store/body_store.h"

namespace carom {
namespace {

std::shared_ptr<const void> geometry_of(const Shape& shape) {
  if (const Hull* hull = std::get_if<Hull>(&shape)) return hull->geometry;
  if (const Mesh* mesh = std::get_if<Mesh>(&shape)) return mesh->geometry;
  if (const HeightField* field = std::get_if<HeightField>(&shape)) return field->geometry;
  if (const Compound* compound = std::get_if<Compound>(&shape)) return compound->geometry;
  return {};
}

template <class Geometry>
std::shared_ptr<const Geometry> geometry_as(const std::shared_ptr<const void>& geometry) {
  return std::static_pointer_cast<const Geometry>(geometry);
}

Shape owning_shape(ShapeKind kind, const std::shared_ptr<const void>& geometry, float rounding) {
  switch (kind) {
    case ShapeKind::hull:
      return Hull{geometry_as<HullGeometry>(geometry)};
    case ShapeKind::rounded_hull:
      return Hull{geometry_as<HullGeometry>(geometry), nullptr, rounding};
    case ShapeKind::mesh:
      return Mesh{geometry_as<MeshGeometry>(geometry)};
    case ShapeKind::height_field:
      return HeightField{geometry_as<HeightFieldGeometry>(geometry)};
    default:
      return Compound{geometry_as<CompoundGeometry>(geometry)};
  }
}

}  // namespace

Shape BodyStore::shape(uint32_t index) const {
  if (!model_.empty() && model_[index].original) return *model_[index].original;
  return tested_shape(index);
}

Shape BodyStore::tested_shape(uint32_t index) const {
  const ShapeKind kind = kind_[index];
  if (kind == ShapeKind::sphere) return Sphere{radius(index)};
  if (has_geometry(kind)) {
    return owning_shape(kind, geometry_[index], rows_[first_row_[index]][3]);
  }
  if (kind == ShapeKind::dop) return owning_dop(index);
  if (kind != ShapeKind::aabb) return shape_from_rows(kind, &rows_[first_row_[index]]);
  const BoxRecord& box = boxes_[box_slot_[index]];
  return Aabb{{box.lower[0], box.lower[1], box.lower[2]},
              {box.upper[0], box.upper[1], box.upper[2]}};
}

void BodyStore::set_shape(uint32_t index, const Shape& shape) {
  count_kind(index, -1);
  store_shape(index, shape);
  touch(index, kShapeTouched);
}

void BodyStore::count_kind(uint32_t index, int change) {
  bodies_of_kind_[static_cast<size_t>(kind_[index])] += static_cast<size_t>(change);
}

// Stores what stands for the shape: itself, or a model that the tolerance of the body allows.
void BodyStore::store_shape(uint32_t index, const Shape& shape) {
  const LadderPtr ladder = uses_models_ ? ladder_of(shape) : nullptr;
  if (ladder && model_.empty()) model_.resize(rows());
  if (!model_.empty()) model_[index] = {};
  if (!ladder) return store_model(index, shape);
  const double most = 0.5 * kShareOfRungs * double{tolerance(index).value_or(tolerance_of_world_)};
  const Rung* best = nullptr;
  for (const Rung& rung : ladder->rungs) {
    if (rung.error <= most) best = &rung;
  }
  const auto rung = best ? static_cast<uint32_t>(best - ladder->rungs.data()) + 1 : 0;
  model_[index] = {best ? best->error : 0, rung, std::make_shared<const Shape>(shape)};
  greatest_model_error_ = std::max(greatest_model_error_, model_[index].error);
  store_model(index, best ? best->shape : shape);
}

void BodyStore::count_by_rung(std::span<const Pair> pairs,
                              std::span<size_t, kCountedRungs> counts) const {
  if (model_.empty()) return;
  for (const Pair& pair : pairs) {
    const uint32_t rung = std::max(model_[pair.a].rung, model_[pair.b].rung);
    if (rung > 0) ++counts[std::min<size_t>(rung, kCountedRungs) - 1];
  }
}

void BodyStore::store_model(uint32_t index, const Shape& shape) {
  const ShapeKind kind = kind_of(shape);
  change_kind(index, kind);
  count_kind(index, 1);
  const Sphere* sphere = std::get_if<Sphere>(&shape);
  set_radius(index, sphere ? sphere->radius : 0);
  if (const Aabb* box = std::get_if<Aabb>(&shape)) store_box(index, *box);
  if (row_count(kind) > 0) {
    const auto rows = carom::shape_rows(shape);
    std::copy_n(rows.begin(), row_count(kind), rows_.begin() + first_row_[index]);
  }
  store_geometry(index, shape);
}

// Keeps the geometry of the shape, if it has one, and releases that of the shape before it.
void BodyStore::store_geometry(uint32_t index, const Shape& shape) {
  if (const Dop* dop = std::get_if<Dop>(&shape)) return set_dop_geometry(index, *dop);
  if (!dop_.empty()) dop_[index] = nullptr;
  if (geometry_.empty()) {
    if (!has_geometry(kind_of(shape))) return;
    geometry_.resize(rows());
  }
  geometry_[index] = geometry_of(shape);
}

void BodyStore::set_dop_geometry(uint32_t index, const Dop& dop) {
  const std::shared_ptr<const DopGeometry> geometry = dop_geometries_.find(dop);
  if (geometry_.empty()) geometry_.resize(rows());
  if (dop_.empty()) dop_.resize(rows());
  geometry_[index] = geometry;
  dop_[index] = geometry.get();
}

bool BodyStore::knows_geometry(uint32_t index) const {
  return dop_[index] && dop_[index]->is_of(&rows_[first_row_[index]]);
}

void BodyStore::find_geometries() {
  if (!shares_shape_rows_ || !has_kind(ShapeKind::dop)) return;
  for (uint32_t i = 0; i < rows(); ++i) {
    if (kind_[i] != ShapeKind::dop || knows_geometry(i)) continue;
    set_dop_geometry(i, std::get<Dop>(shape_from_rows(kind_[i], &rows_[first_row_[i]])));
  }
}

Dop BodyStore::owning_dop(uint32_t index) const {
  Dop dop = std::get<Dop>(shape_from_rows(ShapeKind::dop, &rows_[first_row_[index]]));
  if (knows_geometry(index)) dop.geometry = geometry_as<DopGeometry>(geometry_[index]);
  return dop;
}

// Releases what the last kind needed, and takes what this one needs.
void BodyStore::change_kind(uint32_t index, ShapeKind kind) {
  const ShapeKind last = std::exchange(kind_[index], kind);
  if (last == kind) return;
  if (last == ShapeKind::aabb) release_box(index);
  if (kind == ShapeKind::aabb) take_box(index);
  if (row_count(last) != row_count(kind)) change_rows(index, row_count(last), row_count(kind));
  if (last == ShapeKind::halfspace) remove_halfspace(index);
  if (kind == ShapeKind::halfspace) add_halfspace(index);
}

void BodyStore::change_rows(uint32_t index, uint32_t last_count, uint32_t count) {
  if (first_row_.empty()) {
    first_row_.resize(rows(), 0);
    orientation_.resize(rows(), kIdentity);
  }
  const auto is_elsewhere = [&](uint32_t count_of_rows) {
    return count_of_rows > 0 && first_row_[index] != index * size_t{count_of_rows};
  };
  rows_elsewhere_ -= is_elsewhere(last_count);
  if (last_count > 0) row_pool_.release(first_row_[index], last_count);
  first_row_[index] = count > 0 ? row_pool_.take(count) : 0;
  rows_elsewhere_ += is_elsewhere(count);
  if (count == 0) orientation_[index] = kIdentity;
  resize_rows();
}

void BodyStore::resize_rows() {
  const size_t needed = row_pool_.end() > 0 ? row_pool_.end() + kMostRows - 1 : 0;
  if (needed == rows_.size()) return;
  rows_.resize(needed);
  const size_t end = row_pool_.end();
  std::fill(rows_.begin() + static_cast<ptrdiff_t>(end), rows_.end(), Row{});
}

void BodyStore::add_halfspace(uint32_t index) {
  halfspaces_.insert(std::lower_bound(halfspaces_.begin(), halfspaces_.end(), index), index);
}

void BodyStore::remove_halfspace(uint32_t index) {
  halfspaces_.erase(std::lower_bound(halfspaces_.begin(), halfspaces_.end(), index));
}

void BodyStore::store_box(uint32_t index, const Aabb& box) {
  boxes_[box_slot_[index]] = {{box.lower.x(), box.lower.y(), box.lower.z(), 0},
                              {box.upper.x(), box.upper.y(), box.upper.z(), 0}};
}

void BodyStore::take_box(uint32_t index) {
  if (box_slot_.empty()) box_slot_.resize(rows(), 0);
  box_slot_[index] = slots_.take();
  boxes_elsewhere_ += box_slot_[index] != index;
  if (slots_.end() > boxes_.size()) boxes_.push_back({});
}

void BodyStore::release_box(uint32_t index) {
  boxes_elsewhere_ -= box_slot_[index] != index;
  slots_.release(box_slot_[index]);
  box_slot_[index] = 0;  // unused, but vectors may load it, so it must be a valid row
  if (slots_.end() < boxes_.size()) boxes_.resize(slots_.end());
}

}  // namespace carom

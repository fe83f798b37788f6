#include "tests/support/layouts.h"

namespace carom::test {

std::string show(const Layout& layout) {
  return std::string(name(layout.positions)) + ", radius layout " +
         std::to_string(static_cast<int>(layout.radius)) + ", stride " +
         std::to_string(layout.stride) + ", radius stride " + std::to_string(layout.radius_stride) +
         ", box stride " + std::to_string(layout.box_stride) +
         (layout.box_slots ? ", box slots" : "") + ", orientation stride " +
         std::to_string(layout.orientation_stride) + ", row order " +
         std::to_string(static_cast<int>(layout.rows));
}

LaidOutKinds::LaidOutKinds(std::span<const PlacedShape> bodies, bool always)
    : kinds_(bodies.size(), sizeof(ShapeKind), sizeof(ShapeKind)) {
  if (!bodies.empty()) first_ = kind_of(bodies[0].shape);
  for (size_t i = 0; i < bodies.size(); ++i) {
    kinds_.set(i, kind_of(bodies[i].shape));
    are_mixed_ |= kind_of(bodies[i].shape) != first_;
  }
  is_given_ = always || are_mixed_;
}

void LaidOutKinds::add_to(Collidables& view) const {
  view.uniform_kind = first_;
  if (is_given_) view.kind = kinds_.as<ShapeKind>();
}

LaidOutPositions::LaidOutPositions(std::span<const PlacedShape> bodies, const Layout& layout)
    : layout_(layout),
      records_(bodies.size(), layout.record(), layout.stride ? layout.stride : layout.record()),
      radii_(layout.radius == RadiusLayout::column ? bodies.size() : 0, sizeof(float),
             layout.radius_stride) {
  for (size_t i = 0; i < bodies.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) set_component(i, axis, bodies[i].position[axis]);
    const auto* sphere = std::get_if<Sphere>(&bodies[i].shape);
    set_radius(i, sphere ? sphere->radius : 1);
  }
}

void LaidOutPositions::add_to(Collidables& view) const {
  view.position = {.data = records_.as<char>(),
                   .stride = records_.stride(),
                   .type = layout_.positions,
                   .radius_layout = layout_.radius,
                   .radius = radii_.as<float>(),
                   .radius_stride = layout_.radius_stride};
}

void LaidOutPositions::set_component(size_t i, int component, double value) {
  if (layout_.positions == PositionType::float32) {
    records_.set(i, static_cast<float>(value), component * sizeof(float));
  } else {
    records_.set(i, value, component * sizeof(double));
  }
}

void LaidOutPositions::set_radius(size_t i, float radius) {
  if (layout_.radius == RadiusLayout::fourth) set_component(i, 3, radius);
  if (layout_.radius == RadiusLayout::column) radii_.set(i, radius);
}

LaidOutAabbs::LaidOutAabbs(std::span<const PlacedShape> bodies, const Layout& layout)
    : layout_(layout),
      slots_(layout.box_slots ? bodies.size() : 0, sizeof(uint32_t), sizeof(uint32_t)) {
  auto count = static_cast<uint32_t>(std::count_if(bodies.begin(), bodies.end(), is_box));
  const size_t rows = layout.box_slots || count == 0 ? count : bodies.size();
  if (layout.box_stride == 0) columns_.emplace_back(rows, kRecord, kRecord);
  for (int column = 0; layout.box_stride > 0 && column < 6; ++column) {
    columns_.emplace_back(rows, sizeof(float), layout.box_stride);
  }
  // Slots run backwards, so that the order of boxes is never that of bodies.
  for (uint32_t i = 0; i < bodies.size(); ++i) {
    const uint32_t slot = !is_box(bodies[i]) ? 0xffffffffu : layout.box_slots ? --count : i;
    if (layout.box_slots) slots_.set(i, slot);
    if (is_box(bodies[i])) set(slot, std::get<Aabb>(bodies[i].shape));
  }
}

void LaidOutAabbs::add_to(Collidables& view) const {
  if (layout_.box_stride == 0) {
    view.boxes = box_records(columns_[0].as<float>());
  } else {
    for (int axis = 0; axis < 3; ++axis) {
      view.boxes.lower[axis] = columns_[axis].as<float>();
      view.boxes.upper[axis] = columns_[3 + axis].as<float>();
    }
    view.boxes.stride = layout_.box_stride;
  }
  if (layout_.box_slots) view.box_slot = slots_.as<uint32_t>();
}

void LaidOutAabbs::set(size_t row, const Aabb& box) {
  for (int axis = 0; axis < 3; ++axis) {
    if (layout_.box_stride == 0) {
      columns_[0].set(row, box.lower[axis], axis * sizeof(float));
      columns_[0].set(row, box.upper[axis], (4 + axis) * sizeof(float));
    } else {
      columns_[axis].set(row, box.lower[axis]);
      columns_[3 + axis].set(row, box.upper[axis]);
    }
  }
}

LaidOutOrientations::LaidOutOrientations(std::span<const PlacedShape> bodies, size_t stride)
    : is_given_(std::any_of(bodies.begin(), bodies.end(),
                            [&](const PlacedShape& body) {
                              return has_rows(body.shape) && (stride > 0 || is_turned(body));
                            })),
      stride_(stride > 0 ? stride : kSize),
      quaternions_(is_given_ ? bodies.size() : 0, kSize, stride_) {
  for (size_t i = 0; is_given_ && i < bodies.size(); ++i) {
    for (int c = 0; c < 4; ++c) {
      quaternions_.set(i, bodies[i].orientation.coeffs()[c], c * sizeof(float));
    }
  }
}

void LaidOutOrientations::add_to(Collidables& view) const {
  if (is_given_) view.orientation = {quaternions_.as<float>(), stride_};
}

bool LaidOutOrientations::is_turned(const PlacedShape& body) {
  return body.orientation.coeffs() != Eigen::Vector4f(0, 0, 0, 1);
}

LaidOutRows::LaidOutRows(std::span<const PlacedShape> bodies, RowOrder order, bool is_first_given)
    : is_first_given_(is_first_given || order != RowOrder::dense),
      places_(places(bodies, order)),
      rows_(rows_in(bodies, places_), kRowSize, kRowSize),
      first_(is_first_given_ ? bodies.size() : 0, sizeof(uint32_t), sizeof(uint32_t)) {
  for (size_t i = 0; i < bodies.size(); ++i) {
    if (has_geometry(kind_of(bodies[i].shape))) alive_.push_back(bodies[i].shape);
    if (is_first_given_) first_.set(i, places_[i]);
    const auto rows = shape_rows(bodies[i].shape);
    for (uint32_t k = 0; k < row_count(kind_of(bodies[i].shape)); ++k) {
      rows_.set(places_[i] + k, rows[k]);
    }
  }
  find_geometries(bodies, order);
}

void LaidOutRows::find_geometries(std::span<const PlacedShape> bodies, RowOrder order) {
  dops_.resize(bodies.size());
  for (size_t i = 0; i < bodies.size(); ++i) {
    const Dop* dop = std::get_if<Dop>(&bodies[i].shape);
    if (dop && dop->geometry) alive_.emplace_back(*dop);
    if (dop) dops_[i] = dop->geometry.get();
    if (!dop || dop->geometry || order == RowOrder::dense) continue;
    geometries_.push_back(dop_geometry(*dop));
    const size_t count = geometries_.size();
    if (count % 3 == 1) dops_[i] = geometries_.back().get();
    if (count % 3 == 2) dops_[i] = geometries_[count - 2].get();
  }
}

void LaidOutRows::add_to(Collidables& view) const {
  view.rows.data = rows_.as<float>();
  if (is_first_given_) view.rows.first = first_.as<uint32_t>();
  if (!dops_.empty()) view.dops = dops_.data();
}

std::vector<uint32_t> LaidOutRows::places(std::span<const PlacedShape> bodies, RowOrder order) {
  std::vector<uint32_t> places(bodies.size(), 0xffffffffu);
  std::map<std::string, uint32_t> known;
  uint32_t next = 0;
  for (size_t step = 0; step < bodies.size(); ++step) {
    const size_t i = order == RowOrder::dense ? step : bodies.size() - 1 - step;
    const uint32_t count = row_count(kind_of(bodies[i].shape));
    if (count == 0) continue;
    const uint32_t place = order == RowOrder::shared
                               ? known.emplace(bytes_of(bodies[i].shape), next).first->second
                               : next;
    if (place == next) next += count;
    places[i] = place;
  }
  return places;
}

std::string LaidOutRows::bytes_of(const Shape& shape) {
  const auto rows = shape_rows(shape);
  std::string bytes(1, static_cast<char>(kind_of(shape)));
  return bytes.append(reinterpret_cast<const char*>(rows.data()), sizeof rows);
}

size_t LaidOutRows::rows_in(std::span<const PlacedShape> bodies,
                            const std::vector<uint32_t>& places) {
  size_t rows = 0;
  for (size_t i = 0; i < bodies.size(); ++i) {
    const uint32_t count = row_count(kind_of(bodies[i].shape));
    if (count > 0) rows = std::max<size_t>(rows, places[i] + count);
  }
  return rows;
}

LaidOut::LaidOut(std::span<const PlacedShape> bodies, const Layout& layout)
    : kinds_(bodies, layout.always_kinds),
      positions_(bodies, layout),
      boxes_(bodies, layout),
      orientations_(bodies, layout.orientation_stride),
      rows_(bodies, layout.rows, kinds_.are_mixed()) {
  view_.count = bodies.size();
  kinds_.add_to(view_);
  positions_.add_to(view_);
  boxes_.add_to(view_);
  orientations_.add_to(view_);
  rows_.add_to(view_);
}

}  // namespace carom::test

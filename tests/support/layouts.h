// Bodies laid out in a caller's arrays, in every way that views allow, in guarded memory.
#pragma once

#include <algorithm>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "carom/kernel/views.h"
#include "tests/support/guarded.h"
#include "tests/support/pairs.h"

namespace carom::test {

struct Layout {
  PositionType positions = PositionType::float32;
  RadiusLayout radius = RadiusLayout::fourth;
  size_t stride = 0;  // 0: dense
  size_t radius_stride = sizeof(float);
  size_t box_stride = sizeof(float);
  bool box_slots = false;     // boxes in an order of their own
  bool always_kinds = false;  // a kind a body even if all are the same

  size_t component() const { return positions == PositionType::float32 ? 4 : 8; }
  size_t record() const { return (radius == RadiusLayout::fourth ? 4 : 3) * component(); }
};

inline std::string show(const Layout& layout) {
  return std::string(name(layout.positions)) + ", radius layout " +
         std::to_string(static_cast<int>(layout.radius)) + ", stride " +
         std::to_string(layout.stride) + ", radius stride " + std::to_string(layout.radius_stride) +
         ", box stride " + std::to_string(layout.box_stride) +
         (layout.box_slots ? ", box slots" : "");
}

inline ShapeKind kind_of(const Shape& shape) {
  return std::holds_alternative<Sphere>(shape) ? ShapeKind::sphere : ShapeKind::aabb;
}

class LaidOut {
 public:
  LaidOut(std::span<const PlacedShape> bodies, const Layout& layout)
      : layout_(layout),
        slots_(slots(bodies, layout)),
        records_(bodies.size(), layout.record(), layout.stride ? layout.stride : layout.record()),
        radii_(layout.radius == RadiusLayout::column ? bodies.size() : 0, sizeof(float),
               layout.radius_stride),
        kinds_(bodies.size(), sizeof(ShapeKind), sizeof(ShapeKind)),
        slot_column_(layout.box_slots ? bodies.size() : 0, sizeof(uint32_t), sizeof(uint32_t)) {
    for (int column = 0; column < 6; ++column) {
      boxes_.emplace_back(box_rows(bodies), sizeof(float), layout.box_stride);
    }
    for (size_t i = 0; i < bodies.size(); ++i) set(i, bodies[i]);
    make_view(bodies);
  }

  const Collidables& view() const { return view_; }

 private:
  static std::vector<uint32_t> slots(std::span<const PlacedShape> bodies, const Layout& layout) {
    std::vector<uint32_t> slots(bodies.size());
    std::iota(slots.begin(), slots.end(), 0);
    if (!layout.box_slots) return slots;
    uint32_t boxes = 0;
    for (const PlacedShape& body : bodies) boxes += kind_of(body.shape) == ShapeKind::aabb;
    // Backwards, so that no order of bodies is the order of boxes.
    for (size_t i = 0; i < bodies.size(); ++i) {
      slots[i] = kind_of(bodies[i].shape) == ShapeKind::aabb ? --boxes : 0xffffffffu;
    }
    return slots;
  }

  size_t box_rows(std::span<const PlacedShape> bodies) const {
    const auto count = std::count_if(bodies.begin(), bodies.end(), [](const PlacedShape& body) {
      return kind_of(body.shape) == ShapeKind::aabb;
    });
    return layout_.box_slots ? static_cast<size_t>(count) : count ? bodies.size() : 0;
  }

  void set(size_t i, const PlacedShape& body) {
    for (int axis = 0; axis < 3; ++axis) set_component(i, axis, body.position[axis]);
    kinds_.set(i, kind_of(body.shape));
    if (layout_.box_slots) slot_column_.set(i, slots_[i]);
    if (const auto* sphere = std::get_if<Sphere>(&body.shape)) {
      set_radius(i, sphere->radius);
    } else {
      set_radius(i, 1.0f);
      const Aabb& box = std::get<Aabb>(body.shape);
      for (int axis = 0; axis < 3; ++axis) {
        boxes_[axis].set(slots_[i], box.lower[axis]);
        boxes_[3 + axis].set(slots_[i], box.upper[axis]);
      }
    }
  }

  void set_component(size_t i, int component, double value) {
    if (layout_.positions == PositionType::float32) {
      records_.set(i, static_cast<float>(value), component * sizeof(float));
    } else {
      records_.set(i, value, component * sizeof(double));
    }
  }

  void set_radius(size_t i, float radius) {
    if (layout_.radius == RadiusLayout::fourth) set_component(i, 3, radius);
    if (layout_.radius == RadiusLayout::column) radii_.set(i, radius);
  }

  void make_view(std::span<const PlacedShape> bodies) {
    view_.count = bodies.size();
    view_.position = {.data = records_.as<char>(),
                      .stride = records_.stride(),
                      .type = layout_.positions,
                      .radius_layout = layout_.radius,
                      .radius = radii_.as<float>(),
                      .radius_stride = layout_.radius_stride};
    const bool mixed = std::any_of(bodies.begin(), bodies.end(), [&](const PlacedShape& body) {
      return kind_of(body.shape) != kind_of(bodies[0].shape);
    });
    if (mixed || layout_.always_kinds) view_.kind = kinds_.as<ShapeKind>();
    if (!bodies.empty()) view_.uniform_kind = kind_of(bodies[0].shape);
    for (int axis = 0; axis < 3; ++axis) {
      view_.boxes.lower[axis] = boxes_[axis].as<float>();
      view_.boxes.upper[axis] = boxes_[3 + axis].as<float>();
    }
    view_.boxes.stride = layout_.box_stride;
    if (layout_.box_slots) view_.box_slot = slot_column_.as<uint32_t>();
  }

  Layout layout_;
  std::vector<uint32_t> slots_;
  GuardedArray records_;
  GuardedArray radii_;
  GuardedArray kinds_;
  GuardedArray slot_column_;
  std::vector<GuardedArray> boxes_;
  Collidables view_;
};

}  // namespace carom::test

#include "impacts/placed_side.h"

#include <algorithm>

namespace carom {

PlaceInTime place_at(const Double3& pivot, const Double3& arm, const Row& orientation,
                     const MovingReader& side, size_t body, double t) {
  const Position<float> d = side.displacement(body);
  const Double3 moved = plus(pivot, {d.x * t, d.y * t, d.z * t});
  const Eigen::Vector3d rotation = side.rotation_vector(body);
  if (rotation.isZero(0)) return {plus(moved, arm), arm, orientation};
  const scalar::Quaternion<double> turn = scalar::turn_by(rotation, t);
  const Eigen::Vector3d turned_arm =
      scalar::rotate(scalar::rotation_of(turn), Eigen::Vector3d(arm.data()));
  const Double3 arm_then = {turned_arm.x(), turned_arm.y(), turned_arm.z()};
  const Row as_row = {static_cast<float>(turn.v.x()), static_cast<float>(turn.v.y()),
                      static_cast<float>(turn.v.z()), static_cast<float>(turn.w)};
  return {plus(moved, arm_then), arm_then, product(as_row, orientation)};
}

void PlacedSide::start_at_a(const MeetingRows& meeting) {
  std::fill_n(record_.begin(), meeting.count, std::array<double, 4>{});
}

void PlacedSide::start_at_b(const MovingSide& a, const MovingSide& b, const MeetingRows& meeting) {
  BodyColumns(a).with_positions([&](const auto& of_a) {
    BodyColumns(b).with_positions([&](const auto& of_b) {
      for (size_t i = 0; i < meeting.count; ++i) {
        const auto p = of_a[meeting.body_a[i]];
        const auto q = of_b[meeting.body_b[i]];
        // Adds zero so that no zero is negative.
        record_[i] = {apart(p.x, q.x) + 0.0, apart(p.y, q.y) + 0.0, apart(p.z, q.z) + 0.0, 0};
      }
    });
  });
}

void PlacedSide::place(const MovingSide& side, const uint32_t* body, const MeetingRows& meeting) {
  side_ = &side;
  body_ = body;
  count_ = meeting.count;
  const BodyColumns columns(side);
  move(columns, meeting.time.data());
  put_radii(columns);
  put_orientations(side, meeting.time.data());
  put_shapes(columns);
}

void PlacedSide::move(const BodyColumns& side, const double* time) {
  if (!side.sweep.displacement) return;
  const Strided<Position<float>> displacement = side.displacement();
  for (size_t i = 0; i < count_; ++i) {
    const Position<float> d = displacement[body_[i]];
    const double t = time[i];
    record_[i][0] += d.x * t;
    record_[i][1] += d.y * t;
    record_[i][2] += d.z * t;
  }
}

void PlacedSide::put_radii(const BodyColumns& side) {
  if (!side.bodies.kind && side.bodies.uniform_kind != ShapeKind::sphere) return;
  side.with_radii([&](const auto& radii) {
    const BodyReader reader = side.reader();
    for (size_t i = 0; i < count_; ++i) {
      const bool is_sphere = reader.kind(body_[i]) == ShapeKind::sphere;
      record_[i][3] = is_sphere ? static_cast<float>(radii[body_[i]]) : 0.0f;
    }
  });
}

void PlacedSide::put_orientations(const MovingSide& side, const double* time) {
  const MovingReader reader{side};
  const bool may_turn = side.sweep.rotation != nullptr;
  if (!may_turn && !side.bodies.orientation.data) return;
  for (size_t i = 0; i < count_; ++i) {
    const Row start = reader.body().orientation(body_[i]);
    orientation_[i] =
        may_turn ? place_at({}, {}, start, reader, body_[i], time[i]).orientation : start;
  }
}

void PlacedSide::put_shapes(const BodyColumns& side) {
  const Collidables& bodies = side.bodies;
  const BodyReader reader = side.reader();
  if (bodies.kind) {
    for (size_t i = 0; i < count_; ++i) kind_[i] = bodies.kind[body_[i]];
  }
  if (bodies.rows.data) {
    for (size_t i = 0; i < count_; ++i) {
      const bool has_rows = row_count(reader.kind(body_[i])) > 0;
      first_row_[i] = has_rows ? static_cast<uint32_t>(reader.first_row(body_[i])) : 0;
    }
  }
  if (bodies.boxes.lower[0]) {
    for (size_t i = 0; i < count_; ++i) box_slot_[i] = static_cast<uint32_t>(reader.box(body_[i]));
  }
  if (bodies.dops) {
    for (size_t i = 0; i < count_; ++i) dops_[i] = bodies.dops[body_[i]];
  }
}

Collidables PlacedSide::view() const {
  const Collidables& bodies = side_->bodies;
  const bool is_turned = bodies.orientation.data != nullptr || side_->sweep.rotation != nullptr;
  Collidables view;
  view.count = count_;
  view.position = {
      .data = record_.data(), .stride = sizeof record_[0], .type = PositionType::float64};
  view.kind = bodies.kind ? kind_.data() : nullptr;
  view.uniform_kind = bodies.uniform_kind;
  view.boxes = bodies.boxes;
  view.box_slot = box_slot_.data();
  view.orientation.data = is_turned ? orientation_[0].data() : nullptr;
  view.rows = {bodies.rows.data, first_row_.data()};
  view.dops = bodies.dops ? dops_.data() : nullptr;
  return view;
}

}  // namespace carom

#include "narrowphase/batch/single_pair.h"

#include "narrowphase/batch/stated_body.h"
#include "narrowphase/pairs/aabb/aabb_box_scalar.h"
#include "narrowphase/pairs/any_pair.h"
#include "narrowphase/pairs/box/box_box_scalar.h"
#include "narrowphase/scalar/quaternion_as.h"
#include "narrowphase/scalar/scaled.h"
#include "shapes/body_reader.h"

namespace carom {
namespace {

Position<double> difference(const Position<double>& a, const Position<double>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

scalar::SeparationAs<double> exact_separation(const Batch& batch, ShapeKind kind_a,
                                              ShapeKind kind_b, size_t row) {
  const Pair pair = batch.pairs[row];
  const Collidables view_a = view_of(batch.a, batch.layout, kind_a);
  const Collidables view_b = view_of(batch.b, batch.layout, kind_b);
  const BodyReader a{view_a};
  const BodyReader b{view_b};
  const Position<double> d = difference(b.position<double>(pair.b), a.position<double>(pair.a));
  return scalar::separation_of<double>(
      shape_of(a, pair.a), shape_of(b, pair.b),
      {{d.x, d.y, d.z}, orientation_of(a, pair.a), orientation_of(b, pair.b)});
}

std::array<float, 11> numbers_of(const scalar::Separation& s) {
  return {s.separation,
          s.normal.x(),
          s.normal.y(),
          s.normal.z(),
          s.arm_a.x(),
          s.arm_a.y(),
          s.arm_a.z(),
          s.arm_b.x(),
          s.arm_b.y(),
          s.arm_b.z(),
          s.status == Status::degenerate ? 1.0f : 0.0f};
}

template <class A>
scalar::Separation box_test(const A& a, const scalar::BoxShape<double>& b,
                            const scalar::PairPose<double>& pose, bool has_points) {
  double gap = 0;
  const auto test = [&](const auto& x, const auto& y, const auto& p) {
    const auto s = scalar::test_of_boxes(scalar::placed_boxes(x, y, p), has_points);
    gap = s.separation;
    return s;
  };
  const auto separate = [](const auto& x, const auto& y, const auto& p) {
    return scalar::separation_of_boxes(scalar::placed_boxes(x, y, p));
  };
  auto s = scalar::in_scaled_units<double>(a, b, pose, test);
  // A gap that vanishes in metres makes an overlap of a separate pair, which needs everything.
  if (gap > 0 && s.separation == 0) s = scalar::in_scaled_units<double>(a, b, pose, separate);
  return scalar::rounded(s);
}

scalar::BoxShape<double> box_of(const BodyReader& body, size_t index) {
  const Row half = body.row(index, 0);
  return {{half[0], half[1], half[2]}};
}

template <class T>
scalar::PairPose<float> rounded_pose_of(const BodyReader& a, const BodyReader& b, Pair pair) {
  const Position<T> at_a = a.position<T>(pair.a), at_b = b.position<T>(pair.b);
  const Eigen::Matrix<T, 3, 1> position_a(at_a.x, at_a.y, at_a.z);
  const Eigen::Matrix<T, 3, 1> position_b(at_b.x, at_b.y, at_b.z);
  const Row qa = a.orientation(pair.a), qb = b.orientation(pair.b);
  return {scalar::relative_position(position_a, position_b),
          scalar::quaternion_as<float>({qa[0], qa[1], qa[2], qa[3]}),
          scalar::quaternion_as<float>({qb[0], qb[1], qb[2], qb[3]}),
          scalar::relative_position(position_b, position_a)};
}

}  // namespace

scalar::Quaternion<double> orientation_of(const BodyReader& body, size_t index) {
  const Row q = body.orientation(index);
  return scalar::quaternion_as<double>({q[0], q[1], q[2], q[3]});
}

scalar::PairPose<float> rounded_pose(const BodyReader& a, const BodyReader& b, Pair pair) {
  return a.is_float64() ? rounded_pose_of<double>(a, b, pair) : rounded_pose_of<float>(a, b, pair);
}

Collidables view_of(const BatchSide& side, PositionLayout layout, ShapeKind kind) {
  Collidables view;
  view.position.data = side.records;
  view.position.stride = side.record_stride;
  view.position.type =
      layout == PositionLayout::records64 ? PositionType::float64 : PositionType::float32;
  view.uniform_kind = kind;
  view.boxes = side.boxes;
  view.box_slot = side.box_slot;
  view.orientation = side.orientation;
  view.rows = side.rows;
  view.dops = side.dops;
  return view;
}

bool is_valid_pair(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b, size_t row) {
  const Pair pair = batch.pairs[row];
  const Collidables a = view_of(batch.a, batch.layout, kind_a);
  const Collidables b = view_of(batch.b, batch.layout, kind_b);
  return BodyReader{a}.is_valid(pair.a) && BodyReader{b}.is_valid(pair.b);
}

std::array<float, 11> exact_answer(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b,
                                   size_t row) {
  return numbers_of(scalar::rounded(exact_separation(batch, kind_a, kind_b, row)));
}

std::array<float, 11> exact_box_test(const Batch& batch, ShapeKind kind_a, size_t row) {
  const Pair pair = batch.pairs[row];
  const Collidables view_a = view_of(batch.a, batch.layout, kind_a);
  const Collidables view_b = view_of(batch.b, batch.layout, ShapeKind::box);
  const BodyReader a{view_a};
  const BodyReader b{view_b};
  const Position<double> d = difference(b.position<double>(pair.b), a.position<double>(pair.a));
  const scalar::PairPose<double> pose{
      {d.x, d.y, d.z}, orientation_of(a, pair.a), orientation_of(b, pair.b)};
  const bool has_points = has_contacts(batch.detail);
  if (kind_a == ShapeKind::box) {
    return numbers_of(box_test(box_of(a, pair.a), box_of(b, pair.b), pose, has_points));
  }
  const scalar::AabbShape<double> upright{
      {a.lower(0, pair.a), a.lower(1, pair.a), a.lower(2, pair.a)},
      {a.upper(0, pair.a), a.upper(1, pair.a), a.upper(2, pair.a)}};
  return numbers_of(box_test(upright, box_of(b, pair.b), pose, has_points));
}

uint8_t manifold_answer(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b, size_t row,
                        ManifoldPoints& points) {
  const Pair pair = batch.pairs[row];
  const Collidables view_a = view_of(batch.a, batch.layout, kind_a);
  const Collidables view_b = view_of(batch.b, batch.layout, kind_b);
  const BodyReader a{view_a};
  const BodyReader b{view_b};
  const auto vector = [row](const std::array<float*, 3>& columns) -> Eigen::Vector3f {
    return {columns[0][row], columns[1][row], columns[2][row]};
  };
  const ResultColumns& tested = batch.tested;
  scalar::Separation contact;
  contact.separation = tested.separation[row];
  contact.normal = vector(tested.normal);
  contact.arm_a = vector(tested.point_a);
  const scalar::Manifold manifold =
      scalar::manifold_of(shape_of(a, pair.a), shape_of(b, pair.b), rounded_pose(a, b, pair),
                          contact, batch.reach ? batch.reach[row] : 0);
  points = manifold.points;
  return manifold.count;
}

}  // namespace carom

#include "narrowphase/pairs/round/solid_cylinder.h"

#include <array>
#include <limits>
#include <type_traits>
#include <variant>

#include "narrowphase/batch/row_store.h"
#include "narrowphase/batch/single_pair.h"
#include "narrowphase/batch/stated_body.h"
#include "narrowphase/hulls/solid_cylinder.h"
#include "narrowphase/pairs/manifold_batch.h"
#include "narrowphase/pairs/round/solid_cylinder_scalar.h"
#include "narrowphase/scalar/scaled.h"

namespace carom {
namespace {

template <class T>
auto float_shape_at(const BodyReader& body, size_t index) {
  if constexpr (std::is_same_v<T, Hull>) {
    return scalar::HullShape<float>{geometry_at<HullGeometry>(body.row(index, 0)), 1};
  } else {
    return scalar::shape_as<float>(std::get<T>(shape_of(body, index)));
  }
}

template <class SolidShape>
class SolidCylinderRows {
 public:
  SolidCylinderRows(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b)
      : batch_(batch),
        kind_a_(kind_a),
        kind_b_(kind_b),
        view_a_(view_of(batch.a, batch.layout, kind_a)),
        view_b_(view_of(batch.b, batch.layout, kind_b)),
        store_(batch, kind_a, kind_b) {}

  void run(size_t row) const {
    std::array<float, 10> answer;
    if (!is_valid_pair(batch_, kind_a_, kind_b_, row)) {
      answer.fill(std::numeric_limits<float>::quiet_NaN());
      return store_.put(row, Status::invalid, answer);
    }
    const scalar::SolidCylinderTest test = in_floats(row);
    const scalar::Separation& s = test.separation;
    if (batch_.unsure && !test.is_proven) batch_.unsure[row] = 1;
    if (!s.is_unsure && s.separation != 0) {
      return store_.put(row, Status::ok,
                        {s.separation, s.normal.x(), s.normal.y(), s.normal.z(), s.arm_a.x(),
                         s.arm_a.y(), s.arm_a.z(), s.arm_b.x(), s.arm_b.y(), s.arm_b.z()});
    }
    const std::array<float, 11> found = exact_answer(batch_, kind_a_, kind_b_, row);
    std::copy_n(found.begin(), answer.size(), answer.begin());
    store_.put(row, found[10] != 0 ? Status::degenerate : Status::ok, answer);
    if (batch_.unsure) batch_.unsure[row] = 1;
  }

 private:
  scalar::SolidCylinderTest in_floats(size_t row) const {
    const Pair pair = batch_.pairs[row];
    const scalar::PairPose<float> pose = rounded_pose(a_, b_, pair);
    if (kind_a_ == ShapeKind::cylinder) {
      scalar::SolidCylinderTest test =
          separate(float_shape_at<SolidShape>(b_, pair.b), float_shape_at<Cylinder>(a_, pair.a),
                   scalar::flipped(pose));
      test.separation = scalar::flipped(test.separation);
      return test;
    }
    return separate(float_shape_at<SolidShape>(a_, pair.a), float_shape_at<Cylinder>(b_, pair.b),
                    pose);
  }

  template <class S>
  scalar::SolidCylinderTest separate(const S& solid, const scalar::CylinderShape<float>& cylinder,
                                     const scalar::PairPose<float>& pose) const {
    const auto scale = scalar::scale_of_pair(solid, cylinder, pose);
    scalar::SolidCylinderTest test =
        scalar::test_solid_cylinder(solid.scaled(scale.down), cylinder.scaled(scale.down),
                                    scalar::scaled_pose(pose, scale), find_way_);
    scalar::put_in_metres(test.separation, scale);
    return test;
  }

  const Batch& batch_;
  const ShapeKind kind_a_, kind_b_;
  const Collidables view_a_, view_b_;
  const BodyReader a_{view_a_}, b_{view_b_};
  const RowStore store_;
  const FindSolidWay find_way_ = find_solid_way_in_lanes();
};

}  // namespace

template <class SolidShape>
void run_solid_cylinder(const Batch& batch) {
  const ShapeKind kind = kind_of(Shape(SolidShape()));
  const bool is_flipped = kind > ShapeKind::cylinder;
  const ShapeKind kind_a = is_flipped ? ShapeKind::cylinder : kind;
  const ShapeKind kind_b = is_flipped ? kind : ShapeKind::cylinder;
  if (batch.pass == Pass::manifold) return run_manifolds_one_by_one(batch, kind_a, kind_b);
  const SolidCylinderRows<SolidShape> rows(batch, kind_a, kind_b);
  for (size_t row = 0; row < batch.count; ++row) rows.run(row);
}

template void run_solid_cylinder<Aabb>(const Batch& batch);
template void run_solid_cylinder<Box>(const Batch& batch);
template void run_solid_cylinder<Hull>(const Batch& batch);
template void run_solid_cylinder<Triangle>(const Batch& batch);

}  // namespace carom

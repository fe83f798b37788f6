#include "narrowphase/pairs/round/solid_cylinder.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
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

// The shape of a body. One with faces comes without its rounding, which the caller adds.
template <class T>
auto float_shape_at(const BodyReader& body, size_t index) {
  if constexpr (std::is_same_v<T, Hull>) {
    return scalar::HullShape<float>{geometry_at<HullGeometry>(body.row(index, 0)), 1};
  } else {
    auto shape = scalar::shape_as<float>(std::get<T>(shape_of(body, index)));
    if constexpr (std::is_same_v<T, Box>) shape.rounding = 0;
    return shape;
  }
}

template <class SolidShape>
class SolidCylinderRows {
 public:
  SolidCylinderRows(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b)
      : batch_(batch),
        kind_a_(kind_a),
        kind_b_(kind_b),
        is_flipped_(kind_a == ShapeKind::cylinder),
        view_a_(view_of(batch.a, batch.layout, kind_a)),
        view_b_(view_of(batch.b, batch.layout, kind_b)),
        store_(batch, kind_a, kind_b) {}

  void run(size_t first, size_t count) {
    for (size_t i = 0; i < count; ++i) {
      placed_[i].reset();
      if (!is_valid_pair(batch_, kind_a_, kind_b_, first + i)) continue;
      place(first + i, placed_[i].emplace());
      const Placed& pair = *placed_[i];
      if (pair.has_kernel) {
        steps_.begin(pair.solid->view(), pair.cylinder_in_solid, static_cast<uint8_t>(i),
                     ways_.data(), waiting_);
      }
    }
    steps_.finish(ways_.data(), waiting_);
    for (size_t i = 0; i < count; ++i) {
      if (placed_[i]) {
        put(first + i, *placed_[i], ways_[i]);
      } else {
        std::array<float, 10> none;
        none.fill(std::numeric_limits<float>::quiet_NaN());
        store_.put(first + i, Status::invalid, none);
      }
    }
  }

  static constexpr size_t kMost = 32;  // rows at a time

 private:
  using FloatSolid = decltype(float_shape_at<SolidShape>(std::declval<BodyReader>(), 0));

  // A pair in scaled units, seen from the shape with faces.
  struct Placed {
    scalar::ScaleOf<float> scale;
    Vector3f d;
    scalar::Rotation<float> turn;  // of the shape with faces
    scalar::CylinderShape<float> cylinder;
    std::optional<SolidOf<FloatSolid>> solid;
    bool has_kernel;
    scalar::PlacedCylinder cylinder_in_solid;
  };

  void place(size_t row, Placed& placed) const {
    const Pair pair = batch_.pairs[row];
    const scalar::PairPose<float> stated = rounded_pose(a_, b_, pair);
    const scalar::PairPose<float> pose = is_flipped_ ? scalar::flipped(stated) : stated;
    const auto solid = is_flipped_ ? float_shape_at<SolidShape>(b_, pair.b)
                                   : float_shape_at<SolidShape>(a_, pair.a);
    const auto cylinder =
        is_flipped_ ? float_shape_at<Cylinder>(a_, pair.a) : float_shape_at<Cylinder>(b_, pair.b);
    placed.scale = scalar::scale_of_pair(solid, cylinder, pose);
    const scalar::PairPose<float> scaled_pose = scalar::scaled_pose(pose, placed.scale);
    placed.d = scaled_pose.d;
    placed.cylinder = cylinder.scaled(placed.scale.down);
    const auto scaled_solid = solid.scaled(placed.scale.down);
    placed.solid.emplace(scaled_solid);
    placed.has_kernel = scalar::has_kernel(scaled_solid, placed.solid->view());
    placed.turn = scalar::turn_of(placed.solid->view(), scaled_pose);
    placed.cylinder_in_solid = scalar::placed_cylinder(placed.turn, placed.cylinder, scaled_pose);
  }

  void put(size_t row, const Placed& pair, const scalar::SolidWay& way) const {
    if (!pair.has_kernel) return put_exact(row);
    const Solid& solid = pair.solid->view();
    const scalar::SolidContact contact = scalar::contact_along(solid, pair.cylinder_in_solid, way);
    scalar::Separation s = scalar::separation_of(contact, pair.turn, pair.cylinder, pair.d);
    scalar::put_in_metres(s, pair.scale);
    if (s.is_unsure || s.separation == 0) return put_exact(row);
    if (is_flipped_) s = scalar::flipped(s);
    store_.put(row, Status::ok,
               {s.separation, s.normal.x(), s.normal.y(), s.normal.z(), s.arm_a.x(), s.arm_a.y(),
                s.arm_a.z(), s.arm_b.x(), s.arm_b.y(), s.arm_b.z()});
    if (!batch_.unsure || contact.separation > 0) return;
    if (!scalar::has_common_point(solid, pair.cylinder_in_solid, contact)) batch_.unsure[row] = 1;
  }

  void put_exact(size_t row) const {
    const std::array<float, 11> found = exact_answer(batch_, kind_a_, kind_b_, row);
    std::array<float, 10> answer;
    std::copy_n(found.begin(), answer.size(), answer.begin());
    store_.put(row, found[10] != 0 ? Status::degenerate : Status::ok, answer);
    if (batch_.unsure) batch_.unsure[row] = 1;
  }

  const Batch& batch_;
  const ShapeKind kind_a_, kind_b_;
  const bool is_flipped_;
  const Collidables view_a_, view_b_;
  const BodyReader a_{view_a_}, b_{view_b_};
  const RowStore store_;
  const SolidWaySteps& steps_ = solid_way_steps_in_lanes();
  std::array<std::optional<Placed>, kMost> placed_;
  std::array<scalar::SolidWay, kMost> ways_;
  WaitingArcs waiting_;
};

}  // namespace

template <class SolidShape>
void run_solid_cylinder(const Batch& batch) {
  const ShapeKind kind = kind_of(Shape(SolidShape()));
  const bool is_flipped = kind > ShapeKind::cylinder;
  const ShapeKind kind_a = is_flipped ? ShapeKind::cylinder : kind;
  const ShapeKind kind_b = is_flipped ? kind : ShapeKind::cylinder;
  if (batch.pass == Pass::manifold) return run_manifolds_one_by_one(batch, kind_a, kind_b);
  SolidCylinderRows<SolidShape> rows(batch, kind_a, kind_b);
  constexpr size_t kMost = SolidCylinderRows<SolidShape>::kMost;
  for (size_t first = 0; first < batch.count; first += kMost) {
    rows.run(first, std::min(kMost, batch.count - first));
  }
}

template void run_solid_cylinder<Aabb>(const Batch& batch);
template void run_solid_cylinder<Box>(const Batch& batch);
template void run_solid_cylinder<Hull>(const Batch& batch);
template void run_solid_cylinder<Triangle>(const Batch& batch);

}  // namespace carom

// The manifold pass of a batch: takes rows with their contacts, and gives up to four
// points per row.
#if defined(CAROM_NARROWPHASE_MANIFOLDS_MANIFOLD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_MANIFOLDS_MANIFOLD_INL_H_
#undef CAROM_NARROWPHASE_MANIFOLDS_MANIFOLD_INL_H_
#else
#define CAROM_NARROWPHASE_MANIFOLDS_MANIFOLD_INL_H_
#endif

#include <algorithm>
#include <type_traits>

#include "base/fetch_ahead.h"
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/manifolds/contact_points-inl.h"
#include "narrowphase/manifolds/manifold_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// Where the manifolds of one vector of rows go: places behind the last row to memory of no use.
class ManifoldPlaces {
 public:
  HWY_INLINE ManifoldPlaces(const ResultColumns& out, const uint16_t* rows, size_t row_count)
      : count_(out.manifold_count), rows_(rows), row_count_(row_count) {
    for (size_t i = 0; i < kLanes; ++i) {
      points_[i] = i < row_count ? reinterpret_cast<float*>(out.manifold + rows[i]) : unused_;
    }
  }
  ManifoldPlaces(const ManifoldPlaces&) = delete;
  ManifoldPlaces& operator=(const ManifoldPlaces&) = delete;

  HWY_INLINE void put(I count, const F (&columns)[kManifoldColumns]) const {
    uint8_t counts[kLanes];
    store_bytes(count, counts, 0);
    for (size_t i = 0; i < row_count_; ++i) count_[rows_[i]] = counts[i];
    store_rows(columns, points_);
  }

 private:
  uint8_t* const count_;
  const uint16_t* const rows_;
  const size_t row_count_;
  float* points_[kLanes];
  float unused_[kManifoldColumns];
};

template <class A, class B, class Records>
class ManifoldLoop {
 public:
  static void run(const Batch& batch) {
    const Batch local = batch;  // see BatchLoop
    for (size_t row = 0; row < local.count; row += kLanes) run_rows(local, row);
  }

 private:
  static HWY_INLINE void run_rows(const Batch& batch, size_t row) {
    const ResultColumns& tested = batch.tested;
    const size_t row_count = std::min(kLanes, batch.count - row);
    // Rows that touch lie apart, which no processor foresees.
    for (size_t i = 0; i < row_count; ++i) {
      fetch_to_write(batch.out.manifold, batch.manifold_row[row + i]);
    }
    const Listed bodies{batch.pairs + row};
    PositionLanes positions;
    PoseLanes pose;
    A a;
    B b;
    load_pairs<Records>(batch, bodies, positions, pose, a, b);
    pose.d = clamp_to_finite(pose.d);
    const F up = to_units<Units::scaled>(pose, a, b);
    const F down = hn::Div(splat(1), up);
    PlacedPair placed;
    place<A>(pose.a, splat3(0), placed.a);
    // Adding 0 turns -0 into 0, because the sign of zero depends on which body is A.
    place<B>(pose.b, pose.d + splat3(0), placed.b);

    const FloatTag tag;
    const auto column = [&](const float* values) HWY_ATTR { return hn::LoadU(tag, values + row); };
    const ContactLanes contact = {
        hn::Mul(column(tested.separation), down),
        {column(tested.normal[0]), column(tested.normal[1]), column(tested.normal[2])},
        {hn::Mul(column(tested.point_a[0]), down), hn::Mul(column(tested.point_a[1]), down),
         hn::Mul(column(tested.point_a[2]), down)},
        batch.reach ? min(hn::Mul(column(batch.reach), down), splat(kGreatestReach)) : splat(0)};
    PointLanes points;
    if constexpr (std::is_void_v<decltype(contact_points(a, b, placed, contact, points))>) {
      contact_points(a, b, placed, contact, points);
    } else {
      leave_unless(contact_points(a, b, placed, contact, points), batch, row);
    }
    const ManifoldPlaces places(batch.out, batch.manifold_row + row, row_count);
    put_records(points, contact, up, batch.frame, positions, places);
  }

  template <class Shape>
  static HWY_INLINE void place(Quaternion& q, const F3& origin, Placed& placed) {
    placed.origin = origin;
    if constexpr (Shape::kIsOriented) {
      if (HWY_UNLIKELY(!hn::AllTrue(FloatTag(), is_plain(q)))) make_plain(q);
      placed.turn = rotation_of(q);
    } else {
      const F zero = splat(0);
      const F one = splat(1);
      placed.turn = {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}};
    }
  }

  // Marks the rows whose points the scalar form must find.
  static HWY_INLINE void leave_unless(Mask is_known, const Batch& batch, size_t row) {
    if (HWY_LIKELY(hn::AllTrue(FloatTag(), is_known))) return;
    store_bytes(bytes_where(hn::Not(is_known), 1), batch.unsure, row);
  }

  // Converts to metres, in the frame that the caller wants. No point is deeper than the contact,
  // and none is further than the reach. A single point is the witness point.
  static HWY_INLINE void put_records(PointLanes& points, const ContactLanes& contact, F up,
                                     WitnessFrame frame, const PositionLanes& positions,
                                     const ManifoldPlaces& places) {
    const Mask has_more = points.used[1];
    points.point[0] = select(has_more, points.point[0], contact.arm_a);
    points.s[0] = hn::IfThenElse(has_more, points.s[0], contact.separation);
    points.used[0] = hn::Not(no_lanes());
    F count = splat(0);
    F s[4];
    for (size_t k = 0; k < 4; ++k) {
      count = hn::Add(count, hn::IfThenElseZero(points.used[k], splat(1)));
      F3 point = points.point[k] * up;
      if (frame == WitnessFrame::world) point = positions.a + (positions.a_low + point);
      points.point[k] = zero_unless(points.used[k], point);
      s[k] = min(max(points.s[k], contact.separation), contact.reach);
      s[k] = hn::IfThenElseZero(points.used[k], hn::Mul(s[k], up));
    }
    const F3(&p)[4] = points.point;
    places.put(hn::ConvertTo(IntTag(), count),
               {p[0].x, p[0].y, p[0].z, p[1].x, p[1].y, p[1].z, p[2].x, p[2].y, p[2].z, p[3].x,
                p[3].y, p[3].z, s[0], s[1], s[2], s[3]});
  }
};

// Runs Pass::manifold.
template <class A, class B>
void run_manifold(const Batch& batch) {
  constexpr bool kMayLackRecords = A::kKind == ShapeKind::aabb && B::kKind == ShapeKind::aabb;
  using Records = std::conditional_t<kMayLackRecords, AnyRecordsOrNone, AnyRecords>;
  ManifoldLoop<A, B, Records>::run(batch);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_MANIFOLDS_MANIFOLD_INL_H_

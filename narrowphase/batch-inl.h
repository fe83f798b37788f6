// The loop over a batch, written once: loads, validity, the kernel, stores, the tail.
//
// A kernel is a policy:
//   using A, using B      shape lanes of the two sides
//   static HitLanes test(const F3& relative, const A&, const B&)
// branch-free, the same at every detail: what a detail does not store, the compiler drops.
#if defined(CAROM_NARROWPHASE_BATCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_BATCH_INL_H_
#undef CAROM_NARROWPHASE_BATCH_INL_H_
#else
#define CAROM_NARROWPHASE_BATCH_INL_H_
#endif

#include <limits>
#include <type_traits>

#include "narrowphase/lane_validity.h"
#include "narrowphase/load-inl.h"
#include "narrowphase/store-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

template <class Kernel, class Records, Detail kDetail, WitnessFrame kFrame>
struct BatchLoop {
  using A = typename Kernel::A;
  using B = typename Kernel::B;

  // Boxes in dense columns, no list, no slots: no index is ever needed.
  static constexpr bool kMayLoadRows = std::is_same_v<Records, NoRecords> &&
                                       std::is_same_v<A, BoxLanes> && std::is_same_v<B, BoxLanes>;

  static void run(const Batch& batch) {
    const size_t whole = batch.count - batch.count % kLanes;
    if (!(kMayLoadRows && has_dense_rows(batch))) {
      for (size_t row = 0; row < whole; row += kLanes) run_listed(batch, row);
    } else if constexpr (kMayLoadRows) {
      for (size_t row = 0; row < whole; row += kLanes) run_row(batch, row);
    }
    if (whole < batch.count) run_tail(batch, whole);
  }

 private:
  static constexpr int32_t kDegenerate = static_cast<int32_t>(Status::degenerate);
  static constexpr int32_t kInvalid = static_cast<int32_t>(Status::invalid);

  static bool has_dense_rows(const Batch& batch) {
    return !batch.pairs && !batch.a.box_slot && !batch.b.box_slot &&
           batch.a.boxes.stride == sizeof(float) && batch.b.boxes.stride == sizeof(float);
  }

  static HWY_INLINE Pair pair_at(const Batch& batch, size_t row) {
    if (batch.pairs) return batch.pairs[row];
    const auto index = static_cast<uint32_t>(batch.first + row);
    return {index, index};
  }

  static HWY_INLINE void run_row(const Batch& batch, size_t row) {
    run_lanes(batch, row, Records::load(batch, {}),
              BoxLanes::load_rows(batch.a, batch.first + row),
              BoxLanes::load_rows(batch.b, batch.first + row));
  }

  static HWY_INLINE void run_listed(const Batch& batch, size_t row) {
    LaneIndices lanes;
    for (size_t i = 0; i < kLanes; ++i) {
      const Pair pair = pair_at(batch, row + i);
      lanes.a[i] = pair.a;
      lanes.b[i] = pair.b;
    }
    const PositionLanes positions = Records::load(batch, lanes);
    run_lanes(batch, row, positions, A::load(batch.a, lanes.a, positions.radius_a),
              B::load(batch.b, lanes.b, positions.radius_b));
  }

  // A batch of one whole vector, filled up by repeating the last pair.
  static HWY_NOINLINE void run_tail(const Batch& batch, size_t first_row) {
    const size_t count = batch.count - first_row;
    Pair pairs[kLanes];
    for (size_t i = 0; i < kLanes; ++i) {
      pairs[i] = pair_at(batch, first_row + (i < count ? i : count - 1));
    }
    TailColumns results;
    Batch tail = batch;
    tail.pairs = pairs;
    tail.count = kLanes;
    tail.out = results.columns();
    run(tail);
    results.copy_to(batch.out, first_row, count, kDetail);
  }

  static HWY_INLINE void run_lanes(const Batch& batch, size_t row, PositionLanes positions, A a,
                                   B b) {
    const FloatTag tag;
    const bool plain = hn::AllTrue(tag, is_plainly_valid(positions.relative, a, b));
    Mask valid = hn::Not(no_lanes());
    if (HWY_UNLIKELY(!plain)) {
      // A lane is invalid, or so large that a sum overflowed. The others stay as they are.
      valid = valid_lanes(batch, row);
      a.clear_unless(valid);
      b.clear_unless(valid);
      positions = {.relative = zero_unless(valid, clamp_to_finite(positions.relative)),
                   .a = zero_unless(valid, positions.a),
                   .b = zero_unless(valid, positions.b),
                   .a_low = zero_unless(valid, positions.a_low),
                   .b_low = zero_unless(valid, positions.b_low),
                   .radius_a = positions.radius_a,
                   .radius_b = positions.radius_b};
    }
    HitLanes hit = Kernel::test(positions.relative, a, b);
    I status = bytes_where(hit.degenerate, kDegenerate);
    if (HWY_UNLIKELY(!plain)) {
      status = hn::IfThenElse(hn::RebindMask(IntTag(), valid), status,
                              hn::Set(IntTag(), kInvalid));
      hit = answer_only(valid, hit);
    }
    store_bytes(bytes_where(hit.overlap, 1), batch.out.overlap, row);
    store_bytes(status, batch.out.status, row);
    if constexpr (kDetail == Detail::contact) {
      store(hit.separation, batch.out.separation, row);
      store(hit.normal, batch.out.normal, row);
      store(witness(positions.a, positions.a_low, hit.arm_a), batch.out.point_a, row);
      store(witness(positions.b, positions.b_low, hit.arm_b), batch.out.point_b, row);
    }
  }

  static HWY_INLINE Mask is_plainly_valid(const F3& relative, const A& a, const B& b) {
    const F sum = hn::Add(hn::Add(hn::Abs(relative.x), hn::Abs(relative.y)), hn::Abs(relative.z));
    return hn::And(hn::Le(sum, splat(FLT_MAX)),
                   hn::And(a.is_plainly_valid(), b.is_plainly_valid()));
  }

  static HWY_NOINLINE Mask valid_lanes(const Batch& batch, size_t row) {
    HWY_ALIGN float flags[kLanes];
    for (size_t i = 0; i < kLanes; ++i) {
      flags[i] = is_valid_pair(batch, A::kKind, B::kKind, row + i) ? 1.0f : 0.0f;
    }
    return hn::Gt(hn::Load(FloatTag(), flags), hn::Zero(FloatTag()));
  }

  // NaN where there is no answer; in world coordinates, too, since 0 + NaN is that NaN.
  static HWY_INLINE HitLanes answer_only(Mask valid, const HitLanes& hit) {
    const F3 nan = splat3(std::numeric_limits<float>::quiet_NaN());
    return {.overlap = hn::And(hit.overlap, valid),
            .separation = hn::IfThenElse(valid, hit.separation, nan.x),
            .normal = select(valid, hit.normal, nan),
            .arm_a = select(valid, hit.arm_a, nan),
            .arm_b = select(valid, hit.arm_b, nan),
            .degenerate = hn::And(hit.degenerate, valid)};
  }

  static HWY_INLINE F3 witness(const F3& position, const F3& low, const F3& arm) {
    if constexpr (kFrame == WitnessFrame::body) return arm;
    if constexpr (Records::kHasLow) return position + (low + arm);
    return position + arm;
  }
};

template <class Kernel, class Records>
void run_with_records(const Batch& batch) {
  if (batch.detail == Detail::overlap) {
    BatchLoop<Kernel, Records, Detail::overlap, WitnessFrame::body>::run(batch);
  } else if (batch.frame == WitnessFrame::body) {
    BatchLoop<Kernel, Records, Detail::contact, WitnessFrame::body>::run(batch);
  } else {
    BatchLoop<Kernel, Records, Detail::contact, WitnessFrame::world>::run(batch);
  }
}

template <class Kernel>
void run_batch(const Batch& batch) {
  switch (batch.layout) {
    case PositionLayout::none:
      if constexpr (std::is_same_v<typename Kernel::A, BoxLanes>) {
        run_with_records<Kernel, NoRecords>(batch);
      }
      break;
    case PositionLayout::records32:
      run_with_records<Kernel, Records32>(batch);
      break;
    case PositionLayout::records64:
      run_with_records<Kernel, Records64>(batch);
      break;
  }
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_BATCH_INL_H_

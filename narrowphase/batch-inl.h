// The loop over a batch, written once: loads, validity, the kernel, stores, the tail.
//
// A kernel is a policy:
//   using A, using B   shape lanes of the two sides
//   static void test(const F3& relative, const A&, const B&, Report& report)
//   static constexpr bool kIsExactNearTouch
// test() calls
//   report(overlap, near_touch, degenerate, separation, normal, arm_a, arm_b)
// once; names and signs as in Contact. It is branch-free, the same at every detail: what a detail
// does not store, the compiler drops. Lanes in `near_touch` lie within rounding of touching: their
// separation is computed again in double precision, one by one, unless the kernel is exact there.
#if defined(CAROM_NARROWPHASE_BATCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_BATCH_INL_H_
#undef CAROM_NARROWPHASE_BATCH_INL_H_
#else
#define CAROM_NARROWPHASE_BATCH_INL_H_
#endif

#include <limits>
#include <type_traits>

#include "narrowphase/load-inl.h"
#include "narrowphase/single_pair.h"
#include "narrowphase/store-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

template <class Kernel, class Records, Detail kDetail, WitnessFrame kFrame>
struct BatchLoop {
  using A = typename Kernel::A;
  using B = typename Kernel::B;

  static void run(const Batch& batch) {
    const size_t whole = batch.count - batch.count % kLanes;
    // A copy that nothing else can see: stores of bytes might change `batch`, for all the compiler
    // knows, and would make it read every field again.
    const Batch local = batch;
    if (has_dense_rows(batch)) {
      for (size_t row = 0; row < whole; row += kLanes) {
        if (HWY_UNLIKELY(!run_plain(local, batch, row, DenseRows{row}))) run_odd(batch, row);
      }
    } else {
      for (size_t row = 0; row < whole; row += kLanes) {
        const Listed listed{local.pairs + row};
        if (HWY_UNLIKELY(!run_plain(local, batch, row, listed))) run_odd(batch, row);
      }
    }
    if (whole < batch.count) run_tail(batch, whole);
  }

 private:
  static bool has_dense_rows(const Batch& batch) {
    constexpr size_t kStride = Records::kDenseStride;
    const bool dense_records =
        kStride == 0 || (batch.a.record_stride == kStride && batch.b.record_stride == kStride);
    return batch.pairs_are_rows && dense_records && A::is_dense(batch.a) && B::is_dense(batch.b);
  }

  // False, and nothing done, if a lane is not plainly valid. `batch` is a private copy of `source`.
  template <class Bodies>
  static HWY_INLINE bool run_plain(const Batch& batch, const Batch& source, size_t row,
                                   const Bodies& bodies) {
    PositionLanes positions;
    Records::load(batch, bodies, positions);
    const A a = A::template load<Role::a>(batch.a, bodies, positions);
    const B b = B::template load<Role::b>(batch.b, bodies, positions);
    const Mask plain = is_plainly_valid(positions.relative, a, b);
    if (HWY_UNLIKELY(!hn::AllTrue(FloatTag(), plain))) return false;
    PlainReport report{batch.out, source, row, positions};
    Kernel::test(positions.relative, a, b, report);
    return true;
  }

  // A lane is invalid, or so large that a sum overflowed. The others get what they always get.
  static HWY_NOINLINE void run_odd(const Batch& batch, size_t row) {
    const Mask valid = valid_lanes(batch, row);
    const Listed bodies{batch.pairs + row};
    PositionLanes positions;
    Records::load(batch, bodies, positions);
    A a = A::template load<Role::a>(batch.a, bodies, positions);
    B b = B::template load<Role::b>(batch.b, bodies, positions);
    a.clear_unless(valid);
    b.clear_unless(valid);
    positions.relative = zero_unless(valid, clamp_to_finite(positions.relative));
    positions.a = zero_unless(valid, positions.a);
    positions.b = zero_unless(valid, positions.b);
    if constexpr (Records::kHasLow) {
      positions.a_low = zero_unless(valid, positions.a_low);
      positions.b_low = zero_unless(valid, positions.b_low);
    }
    OddReport report{{batch.out, batch, row, positions}, valid};
    Kernel::test(positions.relative, a, b, report);
  }

  // What a kernel says of its lanes goes to the columns.
  struct PlainReport {
    const ResultColumns& out;
    const Batch& batch;
    size_t row;
    const PositionLanes& positions;

    HWY_INLINE void operator()(Mask overlap, Mask near_touch, Mask degenerate, F separation,
                               const F3& normal, const F3& arm_a, const F3& arm_b) const {
      refine(near_touch, separation, overlap);
      store_bytes(bytes_where(degenerate, static_cast<int32_t>(Status::degenerate)), out.status,
                  row);
      store_answer(overlap, separation, normal, arm_a, arm_b);
    }

    HWY_INLINE void refine(Mask near_touch, F& separation, Mask& overlap) const {
      if constexpr (Kernel::kIsExactNearTouch) return;
      if (HWY_LIKELY(hn::AllFalse(FloatTag(), near_touch))) return;
      separation = refined(batch, row, near_touch, separation);
      overlap = hn::Le(separation, splat(0));
    }

    HWY_INLINE void store_answer(Mask overlap, F separation, const F3& normal, const F3& arm_a,
                                 const F3& arm_b) const {
      store_bytes(bytes_where(overlap, 1), out.overlap, row);
      if constexpr (kDetail == Detail::contact) {
        store(separation, out.separation, row);
        store(normal, out.normal, row);
        store(witness(positions.a, positions.a_low, arm_a), out.point_a, row);
        store(witness(positions.b, positions.b_low, arm_b), out.point_b, row);
      }
    }
  };

  // NaN where there is no answer; in world coordinates, too, since 0 + NaN is that NaN.
  struct OddReport {
    PlainReport plain;
    Mask valid;

    HWY_INLINE void operator()(Mask overlap, Mask near_touch, Mask degenerate, F separation,
                               const F3& normal, const F3& arm_a, const F3& arm_b) const {
      plain.refine(hn::And(near_touch, valid), separation, overlap);
      const I status = bytes_where(degenerate, static_cast<int32_t>(Status::degenerate));
      const I invalid = bytes_where(hn::Not(valid), static_cast<int32_t>(Status::invalid));
      store_bytes(hn::IfThenElse(hn::RebindMask(IntTag(), valid), status, invalid),
                  plain.out.status, plain.row);
      const F3 nan = splat3(std::numeric_limits<float>::quiet_NaN());
      plain.store_answer(hn::And(overlap, valid), hn::IfThenElse(valid, separation, nan.x),
                         select(valid, normal, nan), select(valid, arm_a, nan),
                         select(valid, arm_b, nan));
    }
  };

  // A batch of one whole vector, filled up by repeating the last pair.
  static HWY_NOINLINE void run_tail(const Batch& batch, size_t first_row) {
    const size_t count = batch.count - first_row;
    Pair pairs[kLanes];
    for (size_t i = 0; i < kLanes; ++i) {
      pairs[i] = batch.pairs[first_row + (i < count ? i : count - 1)];
    }
    TailColumns results;
    Batch tail = batch;
    tail.pairs = pairs;
    tail.pairs_are_rows = false;
    tail.count = kLanes;
    tail.out = results.columns();
    run(tail);
    results.copy_to(batch.out, first_row, count, kDetail);
  }

  // One comparison for everything that must be finite: NaN and infinity survive the sum.
  static HWY_INLINE Mask is_plainly_valid(const F3& relative, const A& a, const B& b) {
    const F distance =
        hn::Add(hn::Add(hn::Abs(relative.x), hn::Abs(relative.y)), hn::Abs(relative.z));
    const F sum = hn::Add(distance, hn::Add(a.size(), b.size()));
    return hn::And(hn::Le(sum, splat(FLT_MAX)), hn::And(a.is_ordered(), b.is_ordered()));
  }

  static HWY_NOINLINE F refined(const Batch& batch, size_t row, Mask near_touch, F separation) {
    HWY_ALIGN float values[kLanes];
    HWY_ALIGN float flags[kLanes];
    hn::Store(separation, FloatTag(), values);
    hn::Store(hn::IfThenElseZero(near_touch, splat(1)), FloatTag(), flags);
    for (size_t i = 0; i < kLanes; ++i) {
      if (flags[i] != 0) values[i] = near_touch_separation(batch, A::kKind, B::kKind, row + i);
    }
    return hn::Load(FloatTag(), values);
  }

  static HWY_NOINLINE Mask valid_lanes(const Batch& batch, size_t row) {
    HWY_ALIGN float flags[kLanes];
    for (size_t i = 0; i < kLanes; ++i) {
      flags[i] = is_valid_pair(batch, A::kKind, B::kKind, row + i) ? 1.0f : 0.0f;
    }
    return hn::Gt(hn::Load(FloatTag(), flags), hn::Zero(FloatTag()));
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

// The loop over a batch, written once: loads, validity, the kernel, stores, unsure rows, the tail.
//
// A kernel is a policy:
//   using A, using B   shape lanes of the two sides
//   static void test(const PoseLanes& pose, const A&, const B&, Report& report)
//   static constexpr Units kUnits
//   static constexpr Unsure kUnsure
//   static constexpr bool kTestFetches   optional: test() calls report.fetch<0>() to fetch<3>(),
//   and
//                                        the loop does not ask for the bodies of pairs to come
// test() calls
//   report(overlap, unsure, degenerate, separation, normal, arm_a, arm_b)
// once; names, frames and signs as in Contact. test() is branch-free and the same at every detail:
// the compiler drops what a detail does not store. `unsure`: the lanes that float32 cannot decide.
// Where kUnsure says so, test() is a template of lanes of floats or doubles. With
// Unsure::separation there is
//   static D exact_separation(d, a, b, is_proven)   in metres; not rounded to float yet
#if defined(CAROM_NARROWPHASE_BATCH_BATCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_BATCH_BATCH_INL_H_
#undef CAROM_NARROWPHASE_BATCH_BATCH_INL_H_
#else
#define CAROM_NARROWPHASE_BATCH_BATCH_INL_H_
#endif

#include <algorithm>
#include <type_traits>

#include "base/tolerances.h"
#include "narrowphase/batch/column_memory.h"
#include "narrowphase/batch/fetch-inl.h"
#include "narrowphase/batch/kernel_policy.h"
#include "narrowphase/batch/report-inl.h"
#include "narrowphase/batch/shape_lanes-inl.h"
#include "narrowphase/batch/tail-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// Changes the units and returns the metres in a unit.
template <Units kUnits, class A, class B>
HWY_INLINE F to_units(PoseLanes& pose, A& a, B& b) {
  if constexpr (kUnits == Units::metres) return splat(1);
  F up, down;
  power_of_two(max(largest_component(pose.d), max(a.extent(), b.extent())), up, down);
  pose.d = pose.d * down;
  a.scale(down);
  b.scale(down);
  return up;
}

// Sets lanes that are not valid to the identity, and scales the others so that squares neither
// vanish nor overflow.
HWY_INLINE void clear_unless(Mask valid, Quaternion& q) {
  make_plain(q);
  q.v = zero_unless(valid, q.v);
  q.w = hn::IfThenElse(valid, q.w, splat(1));
}

// One comparison tests everything that must be finite: NaN and infinity survive the sum.
template <class A, class B>
HWY_INLINE Mask is_plainly_valid(const PoseLanes& pose, const A& a, const B& b) {
  const F sum = hn::Add(sum_of_sizes(pose.d), hn::Add(a.size(), b.size()));
  Mask valid = hn::And(hn::Le(sum, splat(FLT_MAX)), hn::And(a.is_ordered(), b.is_ordered()));
  if constexpr (A::kIsOriented) valid = hn::And(valid, is_plain(pose.a));
  if constexpr (B::kIsOriented) valid = hn::And(valid, is_plain(pose.b));
  return valid;
}

// Loads positions, shapes and orientations of a vector of pairs, in metres.
template <class Records, class A, class B, class Bodies>
HWY_INLINE void load_pairs(const Batch& batch, const Bodies& bodies, PositionLanes& positions,
                           PoseLanes& pose, A& a, B& b) {
  Records::load(batch, bodies, positions);
  a = A::template load<Role::a>(batch.a, bodies, positions);
  b = B::template load<Role::b>(batch.b, bodies, positions);
  if constexpr (A::kIsOriented) load_orientation<Role::a>(batch.a, bodies, pose.a);
  if constexpr (B::kIsOriented) load_orientation<Role::b>(batch.b, bodies, pose.b);
  pose.d = positions.relative;
}

template <class Kernel, class Records, Columns kColumns>
struct BatchLoop {
  using A = typename Kernel::A;
  using B = typename Kernel::B;
  using Report = LaneReport<Kernel, Records::kHasLow, kColumns>;

  static void run(const Batch& batch) {
    const size_t whole = batch.count - batch.count % kLanes;
    // A copy that nothing else can see: otherwise the compiler must assume that stores of bytes
    // change `batch`, and reads every field again.
    const Batch local = batch;
    if constexpr (Report::kGathersUnsure) {
      UnsureRows unsure;
      // A single vector, as of a tail, has nothing to gather.
      run_vectors(local, batch, whole, whole > kLanes ? &unsure : nullptr);
      if (unsure.count > 0) compute_unsure(batch, unsure);
    } else {
      run_vectors(local, batch, whole, nullptr);
    }
    if (whole < batch.count) run_tail(batch, whole, &run);
  }

 private:
  static bool has_dense_rows(const Batch& batch) {
    constexpr size_t kStride = Records::kDenseStride;
    const bool dense_records =
        kStride == 0 || (batch.a.record_stride == kStride && batch.b.record_stride == kStride);
    return batch.pairs_are_rows && dense_records && A::is_dense(batch.a) && B::is_dense(batch.b);
  }

  // The first `whole` rows. `batch` is a private copy of `source`.
  static HWY_INLINE void run_vectors(const Batch& batch, const Batch& source, size_t whole,
                                     UnsureRows* gathered) {
    bool is_done = false;
    if constexpr (Records::kHasDenseLoop) {
      is_done = has_dense_rows(source);
      for (size_t row = 0; is_done && row < whole; row += kLanes) {
        run_vector(batch, source, row, DenseRows{row}, gathered);
      }
    }
    for (size_t row = 0; !is_done && row < whole; row += kLanes) {
      run_vector(batch, source, row, Listed{batch.pairs + row}, gathered);
    }
  }

  template <class Bodies>
  static HWY_INLINE void run_vector(const Batch& batch, const Batch& source, size_t row,
                                    const Bodies& bodies, UnsureRows* gathered) {
    PositionLanes positions;
    PoseLanes pose;
    A a;
    B b;
    constexpr bool kLoopFetches = std::is_same_v<Bodies, Listed> && !test_fetches<Kernel>();
    if constexpr (kLoopFetches) fetch_part<A, B, 0>(batch, row);
    load_pairs<Records>(batch, bodies, positions, pose, a, b);
    if constexpr (kLoopFetches) fetch_part<A, B, 1>(batch, row);
    const Mask plain = is_plainly_valid(pose, a, b);
    Mask valid = plain;
    // Some lane is invalid, or so large that a sum overflowed. The results of the other lanes do
    // not change.
    const bool is_odd = !hn::AllTrue(FloatTag(), plain);
    if (HWY_UNLIKELY(is_odd)) {
      valid = valid_lanes(source, row);
      clear_unless(valid, positions, pose, a, b);
    }
    const F up = to_units<Kernel::kUnits>(pose, a, b);
    Report report{batch, source, row, positions, up, plain, valid, is_odd, gathered};
    if constexpr (kLoopFetches) fetch_part<A, B, 2>(batch, row);
    Kernel::test(pose, a, b, report);
    if constexpr (kLoopFetches) fetch_part<A, B, 3>(batch, row);
  }

  // Computes rows in double precision, a vector of them at a time. Their bodies are valid.
  static HWY_NOINLINE void compute_unsure(const Batch& batch, const UnsureRows& rows) {
    for (size_t first = 0; first < rows.count; first += kLanes) {
      const uint32_t* const row = rows.row.data() + first;
      const size_t count = std::min(kLanes, rows.count - first);
      Pair pairs[kLanes];
      for (size_t i = 0; i < kLanes; ++i) pairs[i] = batch.pairs[row[std::min(i, count - 1)]];
      ColumnMemory<kLanes, ColumnRole::test> results;
      uint8_t unsure[kLanes] = {};
      Batch part = batch;
      part.pairs = pairs;
      part.pairs_are_rows = false;
      part.unsure = batch.unsure ? unsure : nullptr;
      part.out = results.columns();
      PositionLanes positions;
      Records::load(part, Listed{pairs}, positions);
      const Mask all = hn::Not(no_lanes());
      const Report report{part, part, 0, positions, splat(1), all, all, false, nullptr};
      report.compute_in_doubles(count);
      copy_rows(part.out, batch.out, Report::kHasContact ? batch.detail : Detail::overlap, count,
                [row](size_t i) { return row[i]; });
      for (size_t i = 0; batch.unsure && i < count; ++i) batch.unsure[row[i]] = unsure[i];
    }
  }

  static HWY_INLINE void clear_unless(Mask valid, PositionLanes& positions, PoseLanes& pose, A& a,
                                      B& b) {
    a.clear_unless(valid);
    b.clear_unless(valid);
    if constexpr (A::kIsOriented) HWY_NAMESPACE::clear_unless(valid, pose.a);
    if constexpr (B::kIsOriented) HWY_NAMESPACE::clear_unless(valid, pose.b);
    pose.d = zero_unless(valid, clamp_to_finite(pose.d));
    positions.a = zero_unless(valid, positions.a);
    positions.b = zero_unless(valid, positions.b);
    if constexpr (Records::kHasLow) {
      positions.a_low = zero_unless(valid, positions.a_low);
      positions.b_low = zero_unless(valid, positions.b_low);
    }
  }

  static HWY_NOINLINE Mask valid_lanes(const Batch& batch, size_t row) {
    HWY_ALIGN float flags[kLanes];
    for (size_t i = 0; i < kLanes; ++i) {
      flags[i] = is_valid_pair(batch, A::kKind, B::kKind, row + i) ? 1.0f : 0.0f;
    }
    return hn::Gt(hn::Load(FloatTag(), flags), hn::Zero(FloatTag()));
  }
};

template <class Kernel>
constexpr Columns columns_of() {
  if constexpr (requires { Kernel::kColumns; }) {
    return Kernel::kColumns;
  } else {
    return Columns::per_detail;
  }
}

template <class Kernel, class Records>
void run_with_records(const Batch& batch) {
  constexpr Columns kColumns = columns_of<Kernel>();
  if constexpr (kColumns != Columns::per_detail) {
    BatchLoop<Kernel, Records, kColumns>::run(batch);
  } else if (batch.detail == Detail::overlap) {
    BatchLoop<Kernel, Records, Columns::decision>::run(batch);
  } else {
    BatchLoop<Kernel, Records, Columns::contact>::run(batch);
  }
}

// Short kernels are compiled for every layout. In the others a branch on the layout in the loop
// costs nothing that counts, and compiling every layout takes long.
template <class Kernel>
void run_batch(const Batch& batch) {
  if constexpr (Kernel::kUnits == Units::scaled) {
    run_with_records<Kernel, AnyRecords>(batch);
  } else {
    switch (batch.layout) {
      case PositionLayout::none:
        if constexpr (Kernel::A::kKind == ShapeKind::aabb && Kernel::B::kKind == ShapeKind::aabb) {
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
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_BATCH_BATCH_INL_H_
